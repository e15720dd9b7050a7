// SPDX-License-Identifier: MIT
// What a window does frame after frame: takes what the worker has drawn since, makes it into panels and textures, draws,
// and lets the session do what was pressed. The same for a window on a screen, whose events window.cpp adds, and for one
// that is drawn off screen; and how long each part took.
#pragma once

#include <optional>
#include <vector>

#include "viewer/window/window_panels.h"

namespace sidelight {

// What is to be seen of a session: the newest pictures as panels, and the records of the inspected pixel. No drawing.
class FrameContents {
 public:
  // Takes what there is now. True if something new is to be seen.
  bool update(const Session& session);

  const Pictures& latest() const { return latest_; }
  const Pictures& finished() const { return finished_; }
  const Shown& shown() const { return shown_; }
  const Inspection* inspection() const { return inspection_ ? &*inspection_ : nullptr; }

 private:
  bool show_pictures(const WindowState& state);
  bool inspect(const WindowState& state);

  Pictures latest_, finished_;
  std::optional<ShownKey> key_;  // of what is in shown_
  Shown shown_;
  std::optional<Inspection> inspection_;
};

// One frame's time by its parts, in ms.
struct FrameTime {
  double at = 0;       // its beginning, on the clock of wall_ms
  double prepare = 0;  // pictures to bytes, records of the inspected pixel
  double upload = 0;   // bytes to textures
  double draw = 0;     // widgets and OpenGL calls
  double swap = 0;     // until the window has it; the window's own to measure
  double total() const { return prepare + upload + draw + swap; }
};

class Frames {
 public:
  // Both must outlive it. `canvas` draws only these frames.
  Frames(Canvas& canvas, Session& session) : canvas_(canvas), session_(session) {}

  // Takes what the worker has drawn since. True if a frame drawn now would show something new.
  bool take_pictures();
  // Draws a frame of `size` device pixels. True if another one is due: something was pressed in it, or keys wait.
  bool draw(glm::ivec2 size, double content_scale);

  // A key goes to the panel that Tab chose, if its widgets know it, else to the session.
  void press(const std::string& key, const Rect& panel);
  // What the mouse did since the last frame, as Canvas wants it.
  void set_pointer(glm::dvec2 position, bool left_down, double wheel);

  const FrameContents& contents() const { return contents_; }
  const WindowLayout& layout() const { return layout_; }
  // Of the frame that was drawn last, with all that was taken since the one before.
  const FrameTime& time() const { return last_; }

 private:
  enum class Uploaded { nothing, as_they_are, with_smaller_copies };
  void upload();

  Canvas& canvas_;
  Session& session_;
  FrameContents contents_;
  Uploaded uploaded_ = Uploaded::nothing;
  std::vector<void*> textures_;
  WindowLayout layout_;
  FrameTime next_, last_;
};

}  // namespace sidelight
