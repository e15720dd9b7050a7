// SPDX-License-Identifier: MIT
#include "viewer/report/plot_svg.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "viewer/report/label_places.h"

namespace sidelight {
namespace {

constexpr int kColors = 6;  // .c0 to .c5 of the style
constexpr std::array<const char*, kMostCurves / kColors> kDashes{"none", "7 5"};
constexpr std::size_t kLongestLabel = 40;

// Where a plot's parts stand in its drawing, y down.
constexpr double kWidth = 760, kLeft = 58, kRight = 590, kTop = 14, kBottom = 318, kHeight = 372;
constexpr double kLegend = kRight + 22, kLegendLine = 25;

double place(const PlotAxis& axis, double value, double at_low, double at_high) {
  return at_low + (value - axis.low) / (axis.high - axis.low) * (at_high - at_low);
}

// "M x,y L x,y ...", starting anew behind what is not finite.
Html path(const std::vector<glm::dvec2>& points) {
  Html out;
  bool drawing = false;
  for (const glm::dvec2& p : points) {
    const bool finite = std::isfinite(p.x) && std::isfinite(p.y);
    if (finite) out += html("{}{:.2f},{:.2f}", drawing ? " L" : " M", p.x, p.y);
    drawing = finite;
  }
  return out;
}

// Text within a drawing; `more`: further attributes.
Html label(double x, double y, std::string_view text, const Html& more) {
  return html("<text x=\"{:.2f}\" y=\"{:.2f}\" {}>{}</text>\n", x, y, more, escaped(text, kLongestLabel));
}

Html line(std::string_view style, const Html& path_data) {
  return html("<path class=\"{}\" d=\"{}\"/>\n", style, path_data);
}

Html grid(const Plot& plot) {
  const Html centred{R"(text-anchor="middle")"}, before{R"(text-anchor="end")"};
  const Html name{R"(text-anchor="middle" class="quiet")"};
  Html out;
  for (const double tick : plot.x.ticks) {
    const double x = place(plot.x, tick, kLeft, kRight);
    out += line("grid", html("M{:.2f},{} V{}", x, kTop, kBottom));
    out += label(x, kBottom + 20, fmt::format("{:g}", tick), centred);
  }
  for (const double tick : plot.y.ticks) {
    const double y = place(plot.y, tick, kBottom, kTop);
    out += line("grid", html("M{},{:.2f} H{}", kLeft, y, kRight));
    out += label(kLeft - 8, y + kHalfLetter, fmt::format("{:g}", tick), before);
  }
  out += line("frame", html("M{},{} V{} H{}", kLeft, kTop, kBottom, kRight));
  out += label((kLeft + kRight) / 2, kBottom + 44, plot.x.label, name);
  out += html("<g transform=\"translate(16 {}) rotate(-90)\">{}</g>\n", (kTop + kBottom) / 2,
              label(0, 0, plot.y.label, name));
  return out;
}

Html curve_and_legend(const Plot& plot, std::size_t number) {
  const Curve& curve = plot.curves[number];
  std::vector<glm::dvec2> points;
  for (const glm::dvec2& p : curve.points)
    points.emplace_back(place(plot.x, p.x, kLeft, kRight), place(plot.y, p.y, kBottom, kTop));
  const double y = kTop + 10 + kLegendLine * static_cast<double>(number);
  const std::string style = fmt::format("curve c{}", number % kColors);
  return html("<g stroke-dasharray=\"{}\">{}{}</g>{}", kDashes[number / kColors], line(style, path(points)),
              line(style, html("M{},{} h34", kLegend, y)),
              label(kLegend + 44, y + kHalfLetter, curve.label, {}));
}

// A lobe's drawing: the point at the origin, the mirrored direction up, 1 is kRadius.
constexpr double kRadius = 100;

glm::dvec2 polar(double angle, double distance) {
  return kRadius * distance * glm::dvec2(std::sin(angle), -std::cos(angle));
}

}  // namespace

Html plot_svg(const Plot& plot) {
  assert(plot.curves.size() <= kMostCurves);
  Html curves;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) curves += curve_and_legend(plot, i);
  return html(R"(<svg viewBox="0 0 {} {}" width="{}" role="img" aria-label="{}">
{}{}</svg>
)",
              kWidth, kHeight, kWidth, plot.title, grid(plot), curves);
}

double lobe(double angle, double shininess) {
  const double cosine = std::cos(angle);
  return cosine > 0 ? std::pow(cosine, shininess) : 0;
}

// cos a = level^(1/s), as 1 - cos a = 2 sin²(a/2), which keeps its digits where cos a is next to 1.
double lobe_angle(double level, double shininess) {
  return 2 * std::asin(std::sqrt(-std::expm1(std::log(level) / shininess) / 2));
}

Html lobe_svg(const std::string& title, double shininess) {
  constexpr int kPoints = 48;  // on each side
  // Below a hundredth the lobe cannot be told from the point; narrow ones get their points where they are.
  const double widest = lobe_angle(0.01, shininess);
  std::vector<glm::dvec2> outline{{0, 0}};
  for (int i = -kPoints; i <= kPoints; ++i) {
    const double angle = widest * i / kPoints;
    outline.push_back(polar(angle, lobe(angle, shininess)));
  }
  outline.push_back({0, 0});

  Html rays;
  for (const int degrees : {-60, -30, 0, 30, 60}) {
    const glm::dvec2 end = polar(degrees * std::numbers::pi / 180, 1), text = 1.1 * end;
    rays += line("grid", html("M0,0 L{:.2f},{:.2f}", end.x, end.y));
    rays += label(text.x, text.y + kHalfLetter, fmt::format("{}°", std::abs(degrees)),
                  {R"(text-anchor="middle" class="quiet")"});
  }
  return html(R"(<svg viewBox="-120 -122 240 132" width="300" role="img" aria-label="{}">
{}{}{}{}</svg>
)",
              title, rays, line("grid", html("M-{0},0 A{0},{0} 0 0 1 {0},0", kRadius)),
              line("frame", html("M-{0},0 H{0}", kRadius)), line("lobe", html("{} Z", path(outline))));
}

}  // namespace sidelight
