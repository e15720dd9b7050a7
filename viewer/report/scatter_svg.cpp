// SPDX-License-Identifier: MIT
#include "viewer/report/scatter_svg.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "viewer/report/label_places.h"
#include "viewer/report/log_axis.h"

namespace sidelight {
namespace {

constexpr double kLeftRoom = 64, kRightRoom = 14, kTopRoom = 14, kLegendRoom = 30, kBottomRoom = 50;
constexpr double kRoomForLabels = 0.18;               // above the greatest error, as a part of the axis
constexpr double kFloorRoom = 34;                     // below the break of the axis
constexpr double kMarkRadius = 5;                     // of a mark
constexpr double kReach = 11;                         // of what takes the mouse for it
constexpr double kLetterWidth = 7, kLineHeight = 14;  // of a label
constexpr double kKeyLetterWidth = 7.2;               // of the legend, whose letters are larger

// Where things stand in the drawing.
struct Layout {
  LogAxis x, y;
  double left = kLeftRoom, right = 0, top = 0, bottom = 0;  // of the logarithmic axes
  bool floor = false;
  double floor_y = 0;

  double at_x(double value) const { return left + log_place(x, value) * (right - left); }
  double at_y(double value) const {
    return value == 0 ? floor_y : bottom - log_place(y, value) * (bottom - top);
  }
  glm::dvec2 at(const Mark& mark) const { return {at_x(mark.x), at_y(mark.y)}; }
  double lowest() const { return floor ? floor_y + 12 : bottom; }
};

bool has_place(const Mark& mark) {
  return mark.x_low > 0 && mark.x_low <= mark.x && mark.x <= mark.x_high && std::isfinite(mark.x_high) &&
         mark.y >= 0 && std::isfinite(mark.y);
}

Layout lay_out(const Scatter& plot, const std::vector<Mark>& marks) {
  Layout out;
  std::vector<double> xs = plot.x_values, ys = plot.y_values;
  for (const Mark& mark : marks) {
    xs.insert(xs.end(), {mark.x_low, mark.x_high});
    ys.push_back(mark.y);
  }
  out.floor = std::find(ys.begin(), ys.end(), 0.0) != ys.end();
  out.x = log_axis(xs);
  out.y = log_axis(ys, kRoomForLabels);
  out.right = plot.width - kRightRoom;
  out.top = kTopRoom + (plot.legend ? kLegendRoom : 0);
  out.bottom = plot.height - kBottomRoom - (out.floor ? kFloorRoom : 0);
  out.floor_y = out.bottom + kFloorRoom - 12;
  return out;
}

Html text(double x, double y, std::string_view words, std::string_view anchor, std::string_view style = "") {
  return html("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n", x, y, anchor,
              style, escaped(words));
}
Html path(std::string_view style, const Html& data) {
  return html("<path class=\"{}\" d=\"{}\"/>\n", style, data);
}

// A mark's outline around the origin, one a series.
Html shape(std::size_t series) {
  constexpr std::array<const char*, kMostSeries> kShapes{
      R"(<circle class="shape" r="5"/>)",
      R"(<path class="shape" d="M-4.6,-4.6 H4.6 V4.6 H-4.6 Z"/>)",
      R"(<path class="shape" d="M0,-6 L5.8,4.4 H-5.8 Z"/>)",
      R"(<path class="shape" d="M0,-6.6 L6.6,0 L0,6.6 L-6.6,0 Z"/>)",
      R"(<path class="shape" d="M0,6 L5.8,-4.4 H-5.8 Z"/>)",
      R"(<path class="shape" d="M-2,-5.6 H2 V-2 H5.6 V2 H2 V5.6 H-2 V2 H-5.6 V-2 H-2 Z"/>)"};
  return {kShapes[series]};
}
constexpr std::array<const char*, 3> kStateStyles{"good", "beaten", "failed"};  // by MarkState

Html grid(const Scatter& plot, const Layout& at) {
  Html out;
  for (const double tick : at.x.ticks) {
    const double x = at.at_x(tick);
    out += path("grid", html("M{:.1f},{:.1f} V{:.1f}", x, at.top, at.lowest()));
    out += text(x, at.lowest() + 18, tick_words(at.x, tick), "middle");
  }
  for (const double tick : at.y.ticks) {
    const double y = at.at_y(tick);
    out += path("grid", html("M{:.1f},{:.1f} H{:.1f}", at.left, y, at.right));
    out += text(at.left - 8, y + kHalfLetter, tick_words(at.y, tick), "end");
  }
  out += path("frame", html("M{0:.1f},{1:.1f} V{2:.1f} M{0:.1f},{3:.1f} H{4:.1f}", at.left, at.top, at.bottom,
                            at.lowest(), at.right));
  if (at.floor) {  // two strokes break the axis
    for (const double y : {at.bottom + 2, at.bottom + 6})
      out += path("frame", html("M{:.1f},{:.1f} l10,-4", at.left - 5, y + 2));
    out += path("floor", html("M{:.1f},{:.1f} H{:.1f}", at.left, at.floor_y, at.right));
    out += text(at.left - 8, at.floor_y + kHalfLetter, "0", "end");
  }
  out += text((at.left + at.right) / 2, plot.height - 8, plot.x_label, "middle", "quiet");
  out += html("<g transform=\"translate(14 {:.1f}) rotate(-90)\">{}</g>\n", (at.top + at.bottom) / 2,
              text(0, 0, plot.y_label, "middle", "quiet"));
  return out;
}

// The corners of the front: from the top down to the fastest good mark, then level until the next that is better, to the
// right edge. Empty without a good mark.
std::vector<glm::dvec2> staircase(const std::vector<Mark>& marks, const Layout& at) {
  std::vector<const Mark*> good;
  for (const Mark& mark : marks)
    if (mark.state == MarkState::good) good.push_back(&mark);
  std::stable_sort(good.begin(), good.end(), [](const Mark* a, const Mark* b) { return a->x < b->x; });
  std::vector<glm::dvec2> corners;
  double least = 0;
  for (const Mark* mark : good) {
    if (!corners.empty() && mark->y >= least) continue;
    const glm::dvec2 p = at.at(*mark);
    corners.emplace_back(p.x, corners.empty() ? at.top : corners.back().y);
    corners.push_back(p);
    least = mark->y;
  }
  if (!corners.empty()) corners.emplace_back(at.right, corners.back().y);
  return corners;
}

Html polyline(std::string_view style, const std::vector<glm::dvec2>& corners) {
  Html data;
  for (const glm::dvec2& p : corners) data += html("{}{:.1f},{:.1f}", data.empty() ? "M" : " L", p.x, p.y);
  return data.empty() ? data : path(style, data);
}

Html threads(const Scatter& plot, const Layout& at) {
  Html out;
  for (const std::vector<std::size_t>& thread : plot.threads) {
    std::vector<glm::dvec2> points;
    for (const std::size_t i : thread)
      if (has_place(plot.marks[i])) points.push_back(at.at(plot.marks[i]));
    out += polyline("thread", points);
  }
  return out;
}

Html mark_html(const Mark& mark, const Layout& at) {
  const glm::dvec2 p = at.at(mark);
  const double low = at.at_x(mark.x_low) - p.x, high = at.at_x(mark.x_high) - p.x;
  return html(R"mark(<g class="mark s{} {}" transform="translate({:.1f} {:.1f})"{}><title>{}</title>
<path class="whisker" d="M{:.1f},-3 v6 m0,-3 H{:.1f} m0,-3 v6"/><circle class="reach" r="{}"/>{}</g>
)mark",
              mark.series, kStateStyles[static_cast<std::size_t>(mark.state)], p.x, p.y, mark.attributes,
              escaped(mark.words, 600), low, high, kReach, shape(mark.series));
}

using LabelLines = std::vector<std::string>;

// The name and why it fails, else the name alone.
std::vector<LabelLines> label_forms(const Mark& mark) {
  std::vector<LabelLines> out;
  if (mark.name.empty()) return out;
  if (!mark.reason.empty()) {
    LabelLines& lines = out.emplace_back(in_two_lines(mark.reason));
    lines.insert(lines.begin(), shortened(mark.name));
  }
  out.push_back({shortened(mark.name)});
  return out;
}

glm::dvec2 size_of(const LabelLines& lines) {
  double width = 0;
  for (const std::string& line : lines) width = std::max(width, text_width(line, kLetterWidth));
  return {width + 4, kLineHeight * static_cast<double>(lines.size())};
}

Html label_html(const Mark& mark, const LabelLines& lines, const LabelPlace& place, const Layout& at) {
  Html out;
  const glm::dvec2 p = at.at(mark);
  if (place.leader)
    out += path("leader", html("M{:.1f},{:.1f} L{:.1f},{:.1f}", p.x, p.y, place.leader->x, place.leader->y));
  // Flush with the side that looks to the mark.
  const bool left_of_it = place.box.x1 <= p.x, right_of_it = place.box.x0 >= p.x;
  const double x = left_of_it ? place.box.x1 : right_of_it ? place.box.x0 : (place.box.x0 + place.box.x1) / 2;
  for (std::size_t k = 0; k < lines.size(); ++k)
    out += text(x, place.box.y0 + kLineHeight * (static_cast<double>(k) + 0.78), lines[k],
                left_of_it    ? "end"
                : right_of_it ? "start"
                              : "middle",
                k > 0                             ? "label reason"
                : mark.state == MarkState::beaten ? "label quiet"
                                                  : "label");
  return out;
}

// Those on the front choose their places first, those beaten last.
Html labels(const std::vector<Mark>& marks, const std::vector<glm::dvec2>& corners, const Layout& at) {
  std::vector<std::size_t> order(marks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    constexpr std::array<int, 3> kRanks{0, 2, 1};  // by MarkState
    return kRanks[static_cast<std::size_t>(marks[a].state)] <
           kRanks[static_cast<std::size_t>(marks[b].state)];
  });
  std::vector<Rectangle> taken;
  for (const Mark& mark : marks) {
    const glm::dvec2 p = at.at(mark);
    taken.push_back(
        {p.x - kMarkRadius - 1, p.y - kMarkRadius - 1, p.x + kMarkRadius + 1, p.y + kMarkRadius + 1});
    taken.push_back({at.at_x(mark.x_low), p.y - 1, at.at_x(mark.x_high), p.y + 1});
  }
  std::vector<Rectangle> steps;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const glm::dvec2 low = glm::min(corners[k - 1], corners[k]), high = glm::max(corners[k - 1], corners[k]);
    steps.push_back({low.x - 1, low.y - 1, high.x + 1, high.y + 1});
  }
  std::vector<LabelRequest> requests;
  std::vector<std::vector<LabelLines>> forms;  // in the order of each request's sizes
  for (const std::size_t i : order) {
    LabelRequest& request = requests.emplace_back();
    request.mark = at.at(marks[i]);
    forms.push_back(label_forms(marks[i]));
    for (const LabelLines& lines : forms.back()) request.sizes.push_back(size_of(lines));
  }
  const Rectangle frame{at.left + 2, at.top, at.right, at.lowest()};
  const std::vector<std::optional<LabelPlace>> places = place_labels(requests, taken, steps, frame);
  Html out;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (places[k]) out += label_html(marks[order[k]], forms[k][places[k]->form], *places[k], at);
  return out;
}

// The series by their shapes, then what filled, grey and hollow mean.
Html legend(const Scatter& plot, const std::vector<Mark>& marks, const Layout& at) {
  Html out;
  double x = at.left + 8;
  const auto add = [&](std::size_t series, const char* state, const std::string& name) {
    out += html("<g class=\"key s{} {}\" transform=\"translate({:.1f} {})\">{}</g>\n", series, state, x,
                kTopRoom, shape(series));
    out += text(x + 11, kTopRoom + kHalfLetter, shortened(name), "start");
    x += 28 + text_width(shortened(name), kKeyLetterWidth);
  };
  for (std::size_t s = 0; s < plot.series.size(); ++s) add(s, "good", plot.series[s]);
  if (plot.staircase) {
    out += path("staircase", html("M{:.1f},{} h12 v8 h12", x - 4, kTopRoom - 4));
    out += text(x + 25, kTopRoom + kHalfLetter, "Pareto front", "start");
    x += 42 + text_width("Pareto front", kKeyLetterWidth);
  }
  const auto any = [&](MarkState state) {
    return std::any_of(marks.begin(), marks.end(), [&](const Mark& mark) { return mark.state == state; });
  };
  if (any(MarkState::beaten)) add(0, "beaten", "dominated");
  if (any(MarkState::failed)) add(0, "failed", "fails a gate");
  return out;
}

Html drawing(const Scatter& plot) {
  assert(plot.series.size() <= kMostSeries);
  std::vector<Mark> marks;
  std::copy_if(plot.marks.begin(), plot.marks.end(), std::back_inserter(marks), has_place);
  const Layout at = lay_out(plot, marks);
  Html out = grid(plot, at);
  const std::vector<glm::dvec2> corners = plot.staircase ? staircase(marks, at) : std::vector<glm::dvec2>();
  out += polyline("staircase", corners);
  out += threads(plot, at);
  // What is beaten lies below what is not.
  for (const MarkState state : {MarkState::beaten, MarkState::failed, MarkState::good})
    for (const Mark& mark : marks)
      if (mark.state == state) out += mark_html(mark, at);
  out += labels(marks, corners, at);
  if (plot.legend) out += legend(plot, marks, at);
  return out;
}

}  // namespace

Html scatter_svg(const Scatter& plot) {
  return html(R"(<svg class="scatter" viewBox="0 0 {0} {1}" width="{0}" role="group" aria-label="{2}">
{3}</svg>
)",
              plot.width, plot.height, escaped(plot.title, 600), drawing(plot));
}

std::string svg_file(const Scatter& plot) {
  return html(
             R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" role="img">
<title>{2}</title>
<style>{3}</style>
<rect class="paper" width="100%" height="100%"/>
{4}</svg>
)",
             plot.width, plot.height, escaped(plot.title, 600), Html{plot_file_style()}, drawing(plot))
      .markup;
}

}  // namespace sidelight
