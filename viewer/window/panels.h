// SPDX-License-Identifier: MIT
// Two finished pictures side by side, with title, captions and times, as `compare` draws them. The window is drawn from
// the same parts (paint.h) by window_panels.h.
//
// Pictures are shown pixel for pixel: at whole zooms every device pixel is a copy of the picture's own bytes.
#pragma once

#include <optional>
#include <string>

#include "common/picture/image_io.h"
#include "common/scene/scene.h"
#include "viewer/window/layout.h"
#include "viewer/window/view.h"

namespace sidelight {

class Canvas;

struct Times {
  double build_ms = 0, frame_ms = 0;
  std::string rate = {};  // "3.1 M rays/s"; empty: not said
};

// Text over one picture. Any text may be given: control characters and broken UTF-8 are shown as \xNN, and
// what is longer than its line ends in an ellipsis.
struct Caption {
  std::string name;
  std::optional<Times> times;  // absent: no line of times (--no-times)
};

// What the tracer's picture holds that a z-buffer's does not: "ray tracer: shadows, mirrors, glass", of these what is on.
std::string traced_name(const TraceSettings& trace);

struct Labels {
  std::string title;  // of the scene; empty: no title line
  Caption left{"z-buffer: local light only", {}};
  Caption right{traced_name({}), {}};
};

// Throws std::invalid_argument, naming both sizes, unless the pictures have one size, of at least 1x1, and as
// many bytes as that needs.
void check_pictures(const Image8& left, const Image8& right);

// The lines that these labels need; the footer (buttons) belongs to the window.
LayoutOptions layout_options(const Labels& labels, bool footer, double scale = 1);

// The comparison as uploaded to a canvas: handles of its textures, as Canvas::add_picture gave them.
struct ShownPictures {
  void* left = nullptr;
  void* right = nullptr;
  glm::ivec2 size{0};
};

// Draws into the whole of the canvas; called within Canvas::draw, with the layout made for the canvas's size.
void draw_comparison(const Canvas& canvas, const ShownPictures& pictures, const Labels& labels,
                     const Layout& layout, const View& view);

}  // namespace sidelight
