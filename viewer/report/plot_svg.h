// SPDX-License-Identifier: MIT
// Plots as SVG within a page: curves over linear axes, and the lobe of a highlight as a lecture draws it. Colours come
// from the page's style (page_style.cpp), so that plots follow it into the dark; curves differ by dashes too.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "viewer/report/html.h"

namespace sidelight {

struct PlotAxis {
  std::string label;
  double low = 0, high = 1;
  std::vector<double> ticks;
};

struct Curve {
  std::string label;
  std::vector<glm::dvec2> points;  // in the axes' units; points that are not finite are left out
};

// How many curves can be told apart.
inline constexpr std::size_t kMostCurves = 12;

struct Plot {
  std::string title;  // what is to be seen, for those who cannot
  PlotAxis x, y;
  std::vector<Curve> curves;  // at most kMostCurves, in the order of the legend
};
Html plot_svg(const Plot& plot);

// cos^s of the angle to the mirrored direction, s >= 0.
double lobe(double angle, double shininess);
// The angle, in radians, at which it has fallen to `level` in (0, 1), or π/2 if it does not.
double lobe_angle(double level, double shininess);
// Polar: in each direction, the distance from the point is cos^s of its angle to the mirrored direction, which is up.
Html lobe_svg(const std::string& title, double shininess);

}  // namespace sidelight
