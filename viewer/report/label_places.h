// SPDX-License-Identifier: MIT
// Labels of a plot, in a type whose letters have no known width: how they are cut and broken into lines, and where they go
// beside their marks, so that none covers another, a mark, or leaves the plot.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sidelight {

inline constexpr std::size_t kLongestLine = 34;  // of a label, in letters
inline constexpr double kHalfLetter = 4.5;       // of a plot's text: from the middle of a line to its foot

// Its first kLongestLine letters, with an ellipsis where there are more.
std::string shortened(const std::string& text);

// Broken at a blank into two lines where it is longer than one, so that a number at its end can be read; each shortened.
std::vector<std::string> in_two_lines(const std::string& text);

// At most, nearly always, where no letter is wider than `letter`.
double text_width(const std::string& line, double letter);

struct Rectangle {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // y down
};
bool overlap(const Rectangle& a, const Rectangle& b);

struct LabelRequest {
  glm::dvec2 mark{0};             // the middle of what it names
  std::vector<glm::dvec2> sizes;  // of the label's forms, the best one first
};
struct LabelPlace {
  Rectangle box;
  std::size_t form = 0;              // index into the sizes
  std::optional<glm::dvec2> leader;  // the end at the label of a line from the mark, where it stands off
};

// One a request, in their order: earlier ones choose first, next to the mark and then further away. Empty where no place
// is free for any of its forms. Nothing overlaps `taken`; all stay within `frame`; `avoided` is overlapped only where
// nothing else is free.
std::vector<std::optional<LabelPlace>> place_labels(const std::vector<LabelRequest>& requests,
                                                    std::vector<Rectangle> taken,
                                                    const std::vector<Rectangle>& avoided,
                                                    const Rectangle& frame);

}  // namespace sidelight
