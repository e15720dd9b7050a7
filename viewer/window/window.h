// SPDX-License-Identifier: MIT
// The window of `sidelight view`: both pictures side by side, with linked zoom and pan. It shows two finished
// pictures and is drawn by draw_comparison (panels.h); here are only GLFW, the keys and the mouse.
//
//     wheel        zoom about the cursor        0, Home     the whole picture again
//     drag         move                         space       swap the two pictures in place
//                                               Esc, q      close
#pragma once

#include <stdexcept>

#include "viewer/window/panels.h"

namespace sidelight {

// There is no window to be had: no display, no OpenGL 3.3 on it, or a build without GLFW. what() gives the
// reason and what to do instead, in one line. Exit code 6.
class NoDisplay : public std::runtime_error {
 public:
  explicit NoDisplay(const std::string& reason);
};

// Throws NoDisplay where run_window would for want of a display: to be asked before long work.
void require_display();

// Shows the window and returns 0 when the user has closed it. Must be called on the main thread, one at a
// time. Sleeps while nothing happens. Throws NoDisplay, std::invalid_argument (pictures of unequal size) or
// UsageError (pictures too large for OpenGL).
int run_window(const PicturePair& comparison);

}  // namespace sidelight
