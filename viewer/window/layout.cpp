// SPDX-License-Identifier: MIT
#include "viewer/window/layout.h"

#include <algorithm>
#include <cmath>

namespace sidelight {
namespace {

// The lengths from which both functions below are made, so that one is the inverse of the other.
struct Measures {
  int margin, gap, title, caption, times, footer;

  int above() const { return margin + title + caption + times; }
  int below() const { return std::max(footer, margin); }
  int beside() const { return 2 * margin + gap; }
};

Measures measure(const LayoutOptions& options) {
  const auto pixels = [&](double length) { return static_cast<int>(std::lround(length * options.scale)); };
  const auto line = [&](bool wanted, double height) { return wanted ? pixels(height) : 0; };
  return {pixels(24),
          pixels(24),
          line(options.title, 1.6 * kTitleText),
          pixels(1.5 * kCaptionText),
          line(options.times, 1.5 * kSmallText),
          line(options.footer, kButtonLine)};
}

// Room for a caption as long as ours are.
int caption_width(double scale) { return static_cast<int>(std::ceil(19 * kCaptionText * scale)); }

}  // namespace

Layout make_layout(glm::ivec2 size, const LayoutOptions& options) {
  const Measures m = measure(options);
  const int width = std::max(0, (size.x - m.beside()) / 2);
  const int bottom = std::max(m.above(), size.y - m.below());
  const int left = m.margin, right = std::max(m.margin, size.x - m.margin - width);
  const int top = width > 0 && bottom > m.above() ? m.above() : bottom;

  Layout layout;
  int y = m.margin;
  const auto take_line = [&](int height) {
    y += height;
    return Rect{0, y - height, 0, y};
  };
  const auto between = [](Rect line, int x0, int x1) { return Rect{x0, line.y0, x1, line.y1}; };
  layout.title = between(take_line(m.title), left, std::max(left, size.x - m.margin));
  const Rect caption = take_line(m.caption), times = take_line(m.times);
  layout.left_caption = between(caption, left, left + width);
  layout.right_caption = between(caption, right, right + width);
  layout.left_times = between(times, left, left + width);
  layout.right_times = between(times, right, right + width);
  layout.left = {left, top, left + width, bottom};
  layout.right = {right, top, right + width, bottom};
  layout.footer = {left, bottom, layout.title.x1, bottom + m.footer};
  return layout;
}

glm::ivec2 layout_size(glm::ivec2 panel, const LayoutOptions& options) {
  const Measures m = measure(options);
  return {2 * panel.x + m.beside(), panel.y + m.above() + m.below()};
}

Layout with_captions_at(const Layout& layout, glm::ivec2 inset, double scale) {
  const int right = std::clamp(layout.left.width() - caption_width(scale), 0, inset.x);
  Layout moved = layout;
  for (Rect* box : {&moved.left_caption, &moved.left_times, &moved.right_caption, &moved.right_times}) {
    box->x0 += right;
    box->y0 += inset.y;
    box->y1 += inset.y;
  }
  return moved;
}

Layout joined(const Layout& layout) {
  Layout one = layout;
  one.left.x1 = layout.right.x1;
  one.left_caption.x1 = layout.right_caption.x1;
  one.left_times.x1 = layout.right_times.x1;
  for (Rect* empty : {&one.right, &one.right_caption, &one.right_times}) empty->x0 = empty->x1;
  return one;
}

glm::ivec2 panel_for(glm::ivec2 picture, const LayoutOptions& options) {
  return {std::max(picture.x, caption_width(options.scale)), picture.y};
}

// DejaVu Sans has 0.46 of its height a character of running text, and 0.53 in short words with digits.
double text_width_bound(std::size_t characters, double height) {
  return 0.56 * height * static_cast<double>(characters);
}

int flow_rows(const std::vector<double>& widths, double gap, double width) {
  int rows = 1;
  double x = 0;
  for (const double each : widths) {
    if (x > 0 && x + each > width) {
      ++rows;
      x = 0;
    }
    x += each + gap;
  }
  return rows;
}

}  // namespace sidelight
