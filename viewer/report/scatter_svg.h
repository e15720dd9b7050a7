// SPDX-License-Identifier: MIT
// A scatter plot as SVG, on logarithmic axes: time against error. What stands on the front is filled, what is beaten is
// grey, what fails a test hollow; a series is told by its shape as well as its hue. Errors of exactly 0, which have no
// place on a logarithmic axis, stand on a floor below a break of it.
#pragma once

#include <string>
#include <vector>

#include "viewer/report/html.h"

namespace sidelight {

enum class MarkState { good, beaten, failed };

struct Mark {
  double x_low = 0, x = 0, x_high = 0;  // 0 < x_low <= x <= x_high: the whisker's ends
  double y = 0;                         // >= 0
  std::size_t series = 0;
  MarkState state = MarkState::good;
  std::string name, reason;  // beside it, where there is room for both or for the name; may be empty
  std::string words;         // all about it, shown under the mouse
  Html attributes;           // further ones of its element, for the page's script
};

struct Scatter {
  std::string title;  // what is to be seen
  std::string x_label, y_label;
  double width = 680, height = 500;
  bool legend = true;
  std::vector<std::string> series;                // their names; at most kMostSeries
  std::vector<Mark> marks;                        // those without a place on the axes are left out
  bool staircase = false;                         // the least y of the good marks so far, over x
  std::vector<std::vector<std::size_t>> threads;  // marks joined by a thin line
  std::vector<double> x_values, y_values;  // that the axes also span, to give several plots the same ones
};

inline constexpr std::size_t kMostSeries = 6;

Html scatter_svg(const Scatter& plot);

// The same as a file of its own, with its style.
std::string svg_file(const Scatter& plot);

}  // namespace sidelight
