// SPDX-License-Identifier: MIT
// Where the title, the captions, the two panels and the footer stand: pure arithmetic on whole device pixels,
// no drawing. One definition for the window and for pictures drawn off screen; tests read from it where to
// look.
//
//     +---------------------------------------------+
//     |  title                                      |
//     |  left caption            right caption      |
//     |  (its times)             (its times)        |
//     |  +------------------+    +----------------+ |
//     |  |      left        |    |     right      | |
//     |  +------------------+    +----------------+ |
//     |  footer                                     |
//     +---------------------------------------------+
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "common/picture/frame.h"

namespace sidelight {

// Font heights in device pixels at scale 1.
inline constexpr double kTitleText = 28, kCaptionText = 21, kSmallText = 17;
// The rows of legend and buttons, and what is left free under a legend.
inline constexpr double kLegendLine = 1.4 * kCaptionText, kLegendFoot = 8, kButtonLine = 2.4 * kSmallText;

// Which lines there are room for, and how large a pixel of text is (2 on a high-DPI screen).
struct LayoutOptions {
  double scale = 1;  // > 0
  bool title = true, times = true, footer = true;
};

// Half-open, device pixels, y down; a line that is not wanted is empty. The panels have equal size, 0x0 if
// there is no room; everything is inside the area where that has room for the lines at all.
struct Layout {
  Rect title, footer;
  Rect left_caption, right_caption;
  Rect left_times, right_times;
  Rect left, right;
};

// The layout of an area of `size` pixels; the panels take what the lines leave.
Layout make_layout(glm::ivec2 size, const LayoutOptions& options);

// The area whose panels have exactly the size `panel`.
glm::ivec2 layout_size(glm::ivec2 panel, const LayoutOptions& options);

// The same layout with the captions moved to the corner of a picture that does not fill its panel: right and down by
// `inset` >= 0, but never so far right that they would be cut.
Layout with_captions_at(const Layout& layout, glm::ivec2 inset, double scale);

// The same layout with one wide panel: left, with its caption and times, as wide as both were. Right is empty.
Layout joined(const Layout& layout);

// The panel size for pictures of `picture` pixels at zoom 1: the picture, widened if it is too narrow for
// captions.
glm::ivec2 panel_for(glm::ivec2 picture, const LayoutOptions& options);

// No narrower than so many characters of our font, which is that many device pixels high.
double text_width_bound(std::size_t characters, double height);

// The rows that items of these widths take, side by side with gaps while they fit into `width`: at least 1. Narrower
// items never take more rows.
int flow_rows(const std::vector<double>& widths, double gap, double width);

}  // namespace sidelight
