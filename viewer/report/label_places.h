// SPDX-License-Identifier: MIT
// Where labels go beside the marks of a plot, so that none covers another, a mark, or leaves the plot.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace sidelight {

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
