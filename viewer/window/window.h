// SPDX-License-Identifier: MIT
// The window of `sidelight view` on a screen: here are only GLFW, its events and its frames. What they do is the
// session's (session.h), what is drawn is window_panels.h's, what the keys do is in session_keys.cpp.
#pragma once

#include <stdexcept>

#include "viewer/window/frame_log.h"

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
// time. Sleeps while nothing happens. `log`, if given, receives every frame's times. Throws NoDisplay or UsageError
// (pictures too large for OpenGL).
int run_window(WindowState state, const SceneOpener& open, FrameLog* log = nullptr);

}  // namespace sidelight
