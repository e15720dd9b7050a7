// SPDX-License-Identifier: MIT
#include "viewer/window/window_panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"

namespace sidelight {
namespace {

bool empty(const Rect& box) { return box.width() <= 0 || box.height() <= 0; }

bool one_panel(const WindowState& state) {
  switch (state.mode) {
    case Mode::raster:
    case Mode::raytrace:
    case Mode::swipe:
    case Mode::flip:
    case Mode::difference:
    case Mode::causes:
      return true;
    default:
      break;
  }
  const auto layer = layer_of(state.mode);
  return layer && !both_make(*layer);
}

// A swipe's halves: the picture left of the divider is the first panel's.
Rect left_of(const Rect& panel, int x) {
  return {panel.x0, panel.y0, std::clamp(x, panel.x0, panel.x1), panel.y1};
}
Rect right_of(const Rect& panel, int x) {
  return {std::clamp(x, panel.x0, panel.x1), panel.y0, panel.x1, panel.y1};
}

// draw_picture places by its panel, so the halves are cut out by clipping.
void draw_clipped(ImDrawList& list, ImTextureID texture, glm::ivec2 size, const View& view, const Rect& panel,
                  const Rect& part) {
  if (empty(part)) return;
  list.PushClipRect(point(part.x0, part.y0), point(part.x1, part.y1));
  draw_picture(list, texture, size, view, panel);
  list.PopClipRect();
}

void draw_swipe(const Canvas& canvas, ImDrawList& list, const WindowContents& contents,
                const Layout& layout) {
  const WindowState& state = contents.state;
  const Rect& panel = layout.left;
  const glm::ivec2 size = picture_size(state);
  const double from = picture_origin(state.view, panel).x;
  const int divider = static_cast<int>(std::lround(from + state.swipe * size.x * state.view.zoom));
  const std::size_t first = state.view.flipped ? 1 : 0;
  draw_clipped(list, contents.textures[first], size, state.view, panel, left_of(panel, divider));
  draw_clipped(list, contents.textures[1 - first], size, state.view, panel, right_of(panel, divider));
  if (divider < panel.x0 || divider > panel.x1) return;
  const double half = 2 * canvas.scale(), grip = 9 * canvas.scale(), y = (panel.y0 + panel.y1) / 2.0;
  const double top = picture_origin(state.view, panel).y, bottom = top + size.y * state.view.zoom;
  list.AddRectFilled(point(divider - half, std::max<double>(top, panel.y0)),
                     point(divider + half, std::min<double>(bottom, panel.y1)), kText);
  list.AddCircleFilled(point(divider, y), static_cast<float>(grip), kText);
}

ImU32 accent(const ShownPanel& panel) { return panel.of_left ? kLeftAccent : kRightAccent; }

void draw_panels(const Canvas& canvas, ImDrawList& list, const WindowContents& contents,
                 const Layout& layout) {
  const WindowState& state = contents.state;
  const auto& panels = contents.shown.panels;
  const Layout at = [&] {
    const glm::dvec2 inset =
        picture_origin(state.view, layout.left) - glm::dvec2(layout.left.x0, layout.left.y0);
    return with_captions_at(layout, glm::ivec2(glm::max(inset, glm::dvec2(0))), canvas.scale());
  }();
  if (contents.shown.swipe) {
    // Both captions over the one panel, each on its side.
    const double middle =
        picture_origin(state.view, layout.left).x + picture_size(state).x * state.view.zoom / 2;
    const auto half = [x = static_cast<int>(middle)](const Rect& box, bool left) {
      return left ? left_of(box, x) : right_of(box, x);
    };
    for (const bool left : {true, false}) {
      const ShownPanel& panel = panels[left != state.view.flipped ? 0 : 1];
      draw_caption(canvas, list, panel.caption, accent(panel), half(at.left_caption, left),
                   half(at.left_times, left));
    }
    return draw_swipe(canvas, list, contents, layout);
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t shown = panels.size() == 2 && state.view.flipped ? 1 - i : i;
    const bool left = i == 0;
    draw_caption(canvas, list, panels[shown].caption, accent(panels[shown]),
                 left ? at.left_caption : at.right_caption, left ? at.left_times : at.right_times);
    draw_picture(list, contents.textures[shown], picture_size(state), state.view,
                 left ? layout.left : layout.right);
  }
}

// One line over the panels: a mistake, or what was done.
void draw_notice(const Canvas& canvas, ImDrawList& list, const WindowContents& contents,
                 const Layout& layout) {
  const Notice& notice = contents.state.notice;
  const bool failed = !contents.latest.error.empty();
  if (notice.text.empty() && !failed) return;
  const double s = canvas.scale();
  const int height = static_cast<int>(std::lround(2 * kCaptionText * s));
  const Rect box{layout.left.x0, layout.left.y0, std::max(layout.left.x1, layout.right.x1),
                 layout.left.y0 + height};
  const ImU32 color = failed || notice.error ? kWarning : kRightAccent;
  list.AddRectFilled(point(box.x0, box.y0), point(box.x1, box.y1), IM_COL32(40, 24, 20, 245));
  list.AddRectFilled(point(box.x0, box.y0), point(box.x0 + 6 * s, box.y1), color);
  const int inset = static_cast<int>(std::lround(18 * s));
  draw_line(list, *canvas.fonts().caption, {box.x0 + inset, box.y0, box.x1 - inset, box.y1}, kText,
            failed ? contents.latest.error : notice.text);
}

}  // namespace

WindowLayout window_layout(const WindowState& state, glm::ivec2 size, double scale) {
  const auto pixels = [&](double length) { return static_cast<int>(std::lround(length * scale)); };
  WindowLayout out;
  glm::ivec2 room = size;
  if (state.controls) {
    const int width = std::min(pixels(390), size.x / 2);
    out.controls = {size.x - width, 0, size.x, size.y};
    room.x -= width;
  }
  const int footer = pixels(2.4 * kSmallText);
  int bottom = size.y - footer;
  const auto take = [&](int height) {
    const int top = std::max(0, bottom - height);
    const Rect box{0, top, room.x, bottom};
    bottom = top;
    return box;
  };
  // A step is a line or two, a lesson a paragraph.
  if (state.lesson) out.lesson = take(std::min(pixels(state.step >= 0 ? 104 : 190), size.y * 2 / 5));
  if (state.inspected) out.inspector = take(std::max(pixels(120), size.y * 2 / 5));
  if (state.slow) out.slow = take(pixels(2.6 * kSmallText));

  const LayoutOptions options{scale, true, state.opened.times, true};
  room.y = bottom + footer;
  out.panels = make_layout(room, options);
  out.panels.footer = {out.panels.title.x0, size.y - footer, out.panels.title.x1, size.y};
  if (one_panel(state)) out.panels = joined(out.panels);
  if (state.help) out.help = {size.x / 12, size.y / 12, size.x - size.x / 12, size.y - size.y / 12};
  return out;
}

int panel_at(const WindowLayout& layout, glm::dvec2 point) {
  const auto in = [&](const Rect& box) {
    return point.x >= box.x0 && point.x < box.x1 && point.y >= box.y0 && point.y < box.y1;
  };
  return in(layout.panels.left) ? 0 : in(layout.panels.right) ? 1 : -1;
}

std::vector<Command> draw_window(const Canvas& canvas, const WindowContents& contents,
                                 const WindowLayout& layout) {
  std::vector<Command> out;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({0, 0}, ImGui::GetIO().DisplaySize, kPage);
  draw_line(list, *canvas.fonts().title, layout.panels.title, kText, window_title(contents.state));
  if (!contents.shown.panels.empty()) {
    draw_panels(canvas, list, contents, layout.panels);
    draw_marks(canvas, contents, layout);
  }
  draw_notice(canvas, list, contents, layout.panels);
  if (!empty(layout.panels.footer)) draw_buttons(canvas, contents, layout.panels.footer, out);
  if (!empty(layout.slow)) draw_slow_motion(canvas, contents, layout.slow, out);
  if (!empty(layout.inspector)) draw_inspector(canvas, contents, layout.inspector, out);
  if (!empty(layout.lesson)) draw_lesson(canvas, contents, layout.lesson);
  if (!empty(layout.controls)) draw_controls(canvas, contents, layout.controls, out);
  if (!empty(layout.help)) draw_help(canvas, layout.help);
  return out;
}

DockWindow::DockWindow(const char* name, const Rect& box) {
  ImGui::SetNextWindowPos(point(box.x0, box.y0));
  ImGui::SetNextWindowSize(point(box.width(), box.height()));
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
}
DockWindow::~DockWindow() { ImGui::End(); }

}  // namespace sidelight
