// SPDX-License-Identifier: MIT
// Drawing without a screen, by OSMesa: pictures of the comparison for `compare` and for `view --screenshot`.
//
// Each call makes its OpenGL context on a thread of its own and is done with it on return: Mesa keeps one
// dispatch table per thread, and after OSMesa has been current on one, a window's calls there would go to
// OSMesa's buffer. May be called from any thread, but not from within Canvas::draw. Equal arguments give
// equal bytes.
//
// Where the program was built without OSMesa (Mesa 25.1 dropped it), each function throws UsageError saying so; where
// OSMesa cannot be loaded or has no OpenGL 3.3, OutputError.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "common/picture/image_io.h"
#include "viewer/window/panels.h"
#include "viewer/window/state.h"

namespace sidelight {

class Canvas;

inline constexpr int kLongestOffscreen = 16384;  // side that OSMesa can draw

// Runs `draw` with a fresh canvas and returns what it drew by Canvas::draw, which it must call with this
// size. What it throws passes through. Throws UsageError if a side is not from 1 to kLongestOffscreen.
Image8 draw_offscreen(int width, int height, const std::function<void(Canvas&)>& draw);

// Both pictures at zoom 1, their own bytes, with title and captions; the size follows from the pictures.
// Throws std::invalid_argument unless the pictures have one size.
Image8 side_by_side(const Image8& left, const Image8& right, const Labels& labels);

// The size of that, for pictures of size `picture`.
glm::ivec2 side_by_side_size(glm::ivec2 picture, const Labels& labels);

// What a window of this size shows of the state, with everything drawn to the end: the window's own pixels.
Image8 screenshot(const WindowState& state, const Pictures& pictures, int width, int height);

// Which of the panels that are open, inspector and lesson, have no room in that window, a line for each: its name and the
// size from which on it is shown. Needs no OSMesa.
std::vector<std::string> left_out(const WindowState& state, int width, int height);

}  // namespace sidelight
