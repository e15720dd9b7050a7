// SPDX-License-Identifier: MIT
// All that the window is about to show, as plain data: the scene with what the user did to it, how it is looked at,
// and which panels are open. Nothing here draws; session.h changes it, panels.h shows it.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/scene.h"
#include "viewer/window/modes.h"
#include "viewer/window/progressive.h"
#include "viewer/window/view.h"

namespace sidelight {

// A scene as its file and the command line say it, before anything was touched.
struct OpenedScene {
  Scene scene;                     // without the faults
  std::vector<std::string> files;  // it was read from: its own, then those of its meshes
  Faults faults;
  int n = 1;              // samples per pixel edge
  int most_n = 8;         // so many keys and controls go to, or as many as memory holds
  RenderOptions options;  // threads, isa, crop
  bool times = true;      // show how long the pictures took
};

// One line over the pictures: what went wrong, or what was done.
struct Notice {
  std::string text;
  bool error = false;
};

// Who gets the arrows, Space and Enter.
enum class KeyTarget { pictures, controls, fragments, rays, lesson };

struct WindowState {
  std::string file;
  OpenedScene opened;
  // With the lesson's step and all changes; replaced, never changed, since the worker reads it.
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Scene> untouched;  // with the step, without the changes
  std::shared_ptr<const Scene> drawn;      // the same, tessellated if that fault is on
  CameraSettings camera;                   // moves on its own, so that moving it builds nothing
  Faults faults;
  int n = 1;

  Mode mode = Mode::side_by_side;
  View view;                            // zoom, pan and whether the two are swapped: for both pictures
  double swipe = 0.5;                   // how much of the width is the z-buffer's
  int ledger_term = 0;                  // terms taken so far, 0 to 3
  std::optional<glm::ivec2> inspected;  // pixel of the picture
  std::optional<glm::dvec2> cursor;     // picture point under the mouse

  // Slow motion: so many objects rasterized, so many rows traced.
  bool slow = false;
  int objects = 0, rows = 0;

  int step = -1;          // of the lesson; -1 before the first
  bool revealed = false;  // else its question stands there, and nothing has happened yet
  bool lesson = false, controls = false, help = false;
  KeyTarget keys = KeyTarget::pictures;  // as Tab chose; see key_target
  double text_scale = 1;
  int material = 0;  // that the controls show
  Notice notice;
  std::string clipboard;  // what the user asked to copy; the window hands it on
};

// What the worker is to draw for it.
PictureTask picture_task(const WindowState& state);

// The part of the whole picture that is drawn; the view's picture is this part.
Rect shown_part(const WindowState& state);
inline glm::ivec2 picture_size(const WindowState& state) {
  const Rect part = shown_part(state);
  return {part.width(), part.height()};
}

// "scene, with FAULTS ON PURPOSE": what every picture of it must say.
std::string window_title(const WindowState& state);

// Whether a panel that keys can go to is there, and to which they go: to the pictures once the chosen one is closed.
bool is_open(const WindowState& state, KeyTarget target);
KeyTarget key_target(const WindowState& state);

}  // namespace sidelight
