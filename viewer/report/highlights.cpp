// SPDX-License-Identifier: MIT
#include "viewer/report/compare_report.h"

#include <algorithm>
#include <numbers>
#include <set>

#include "viewer/report/plot_svg.h"

namespace sidelight {
namespace {

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

Html lobe_figure(const Material& material) {
  const double half = degrees(lobe_angle(0.5, material.shininess));
  return html(
      R"(<figure>{}<figcaption dir="auto"><b>{}</b><br>s = {:g}, half as bright at {:.3g}°</figcaption></figure>
)",
      lobe_svg(fmt::format("Lobe of the cosine to the power of {:g}", material.shininess),
               material.shininess),
      escaped(material.name, 60), material.shininess, half);
}

Curve lobe_curve(double shininess) {
  constexpr int kPoints = 120;
  Curve curve{fmt::format("s = {:g}", shininess), {}};
  const double widest = lobe_angle(1e-4, shininess);  // below that the curve lies on the axis
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = widest * i / kPoints;
    curve.points.emplace_back(degrees(angle), lobe(angle, shininess));
  }
  curve.points.emplace_back(90, 0);
  return curve;
}

}  // namespace

Html highlights_html(const std::vector<Material>& materials) {
  std::vector<Material> shiny;
  std::copy_if(materials.begin(), materials.end(), std::back_inserter(shiny),
               [](const Material& material) { return material.specular != glm::dvec3(0); });
  if (shiny.empty()) return {};
  const std::size_t left_out = shiny.size() - std::min(shiny.size(), kMostCurves);
  shiny.resize(shiny.size() - left_out);

  Html lobes;
  std::set<double> exponents;
  for (const Material& material : shiny) {
    lobes += lobe_figure(material);
    exponents.insert(material.shininess);
  }
  Plot plot{"The cosine of the angle to the mirrored direction, to the power of s, for each s of the scene",
            {"angle between Rl and V, in degrees", 0, 90, {0, 15, 30, 45, 60, 75, 90}},
            {"(Rl·V)ˢ", 0, 1, {0, 0.25, 0.5, 0.75, 1}},
            {}};
  for (const double s : exponents) plot.curves.push_back(lobe_curve(s));
  Html rest;
  if (left_out > 0)
    rest = html("<p class=\"quiet\">{} more materials with a highlight are not shown.</p>\n", left_out);
  return html(R"(<section>
<h2>The highlights of its materials</h2>
<p>Specular light is k<sub>s</sub> · max(0, Rl·V)<sup>s</sup>, a power of the cosine between the mirrored light Rl and the
direction V to the eye. A greater s makes the highlight narrower, not brighter: every lobe has length 1 along Rl.</p>
<div class="lobes">
{}</div>
{}<h3>The same, over the angle</h3>
{}</section>
)",
              lobes, rest, plot_svg(plot));
}

}  // namespace sidelight
