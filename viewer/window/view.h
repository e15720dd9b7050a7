// SPDX-License-Identifier: MIT
// Which part of the pictures is shown, and how large: plain data and pure functions, no drawing. Both
// pictures share one View, so zoom and pan are linked by construction.
//
// Lengths on screen are device pixels (framebuffer pixels, not window coordinates), y down. A panel is the
// rectangle in which one picture shows; a picture point is in pixels of the picture, (0, 0) its top left
// corner. From zoom 1 up the zoom is a whole number and pictures lie on whole device pixels: what shows is
// exact.
#pragma once

#include <glm/vec2.hpp>

#include "common/picture/frame.h"

namespace sidelight {

inline constexpr double kMaxZoom = 64;

struct View {
  double zoom = 1;       // device pixels per picture pixel; > 0
  glm::dvec2 center{0};  // the picture point in the middle of the panel
  bool fitted = true;    // shows the whole picture, and goes on doing so when the panel changes
  bool flipped = false;  // the two pictures have changed places
};

// The whole picture, centred: the largest whole zoom that fits, up to kMaxZoom, or the fraction that fits if
// the panel is smaller than the picture. Keeps `flipped`. An empty panel counts as one of 1x1.
View fit(const View& view, glm::ivec2 picture, const Rect& panel);

// The view after the panel changed: fitted again if it was, else moved as little as needed for the picture to
// fill the panel; centred along an axis where it cannot. Idempotent.
View clamp(const View& view, glm::ivec2 picture, const Rect& panel);

// `steps` up (or down, if negative) the ladder ... 1/3 1/2 1 2 3 4 6 8 12 ... 64, not below the zoom that
// shows the whole picture (or 1, if that is less). The picture point under `cursor` stays under it as far as
// clamp allows.
View zoom_about(const View& view, glm::ivec2 picture, const Rect& panel, glm::dvec2 cursor, int steps);

// Moves the pictures by `by` device pixels, as far as clamp allows.
View pan(const View& view, glm::ivec2 picture, const Rect& panel, glm::dvec2 by);

// The middle of a panel, where `center` shows; an empty panel counts as one of 1x1.
glm::dvec2 middle(const Rect& panel);

// The whole device pixel on which the picture's top left corner lies; it may be outside the panel.
glm::dvec2 picture_origin(const View& view, const Rect& panel);

}  // namespace sidelight
