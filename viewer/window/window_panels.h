// SPDX-License-Identifier: MIT
// All that the window shows, drawn from its state: panels, marks on them, buttons, inspector, lesson, controls, help.
// On screen and off screen alike. Buttons and sliders change nothing themselves: they hand back commands, which the
// window carries out when the frame is done, and which a picture off screen forgets.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "viewer/window/inspection.h"
#include "viewer/window/layout.h"
#include "viewer/window/session.h"
#include "viewer/window/shown.h"

namespace sidelight {

class Canvas;
using Command = std::function<void(Session&)>;

// Where things stand in a window of `size` device pixels. What is closed is empty.
struct WindowLayout {
  Layout panels;  // joined where there is one panel
  Rect legend, slow, inspector, lesson, controls, help;
};
WindowLayout window_layout(const WindowState& state, glm::ivec2 size, double scale);

// The parts of the one panel of a swipe that show the left picture and the right one; where the divider stands beside the
// panel, one of them is empty.
std::pair<Rect, Rect> swipe_halves(const WindowState& state, const Rect& panel);

struct WindowContents {
  const WindowState& state;
  const Pictures& latest;
  const Pictures& finished;
  const Shown& shown;
  const std::vector<void*>& textures;      // of shown.panels, as Canvas::add_picture gave them
  const Inspection* inspection = nullptr;  // of state.inspected
};

// Draws into the whole of the canvas, within Canvas::draw.
std::vector<Command> draw_window(const Canvas& canvas, const WindowContents& contents,
                                 const WindowLayout& layout);

// The panel under a point of the window: 0, 1, or -1.
int panel_at(const WindowLayout& layout, glm::dvec2 point);

// What the parts take that flow: the buttons and the legend in device pixels, 0 where there is none, the lesson's text in
// rows. `brief`: the buttons' keys without their words; the legend's words without the histogram.
int buttons_height(const WindowState& state, int width, double scale, bool brief = false);
int legend_height(const WindowState& state, int width, double scale, bool brief = false);
int lesson_rows(const WindowState& state, int width, double scale);

// Parts of draw_window, in files of their own. Each is called where its rectangle is not empty.
void draw_marks(const Canvas& canvas, const WindowContents& contents, const WindowLayout& layout);
void draw_legend(const Canvas& canvas, const WindowContents& contents, const Rect& box);
void draw_inspector(const Canvas& canvas, const WindowContents& contents, const Rect& box,
                    std::vector<Command>& out);
void draw_controls(const Canvas& canvas, const WindowContents& contents, const Rect& box,
                   std::vector<Command>& out);
void draw_lesson(const Canvas& canvas, const WindowContents& contents, const Rect& box);
void draw_slow_motion(const Canvas& canvas, const WindowContents& contents, const Rect& box,
                      std::vector<Command>& out);
void draw_help(const Canvas& canvas, const Rect& box);
void draw_buttons(const Canvas& canvas, const WindowContents& contents, const Rect& box,
                  std::vector<Command>& out);

// The rays have the colours of their causes.
std::uint32_t segment_color(SegmentKind kind);

// Within a widget window: it has the keyboard, and says so by a frame, so far around it, if keys go to `target`.
void follow_keys(const WindowState& state, KeyTarget target, float around = 0);

// A button that presses the key its label begins with.
void key_button(const char* label, std::vector<Command>& out);

// A widget window without decoration, but a scrollbar if wanted, exactly in `box`, while it lives.
class DockWindow {
 public:
  DockWindow(const char* name, const Rect& box, bool scrollbar = false);
  ~DockWindow();
  DockWindow(const DockWindow&) = delete;
  DockWindow& operator=(const DockWindow&) = delete;
};

}  // namespace sidelight
