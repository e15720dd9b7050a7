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
  if (const auto layer = layer_of(state.mode)) return !both_make(*layer);
  return state.mode != Mode::side_by_side && state.mode != Mode::ledger;
}

Rect left_of(const Rect& panel, int x) {
  return {panel.x0, panel.y0, std::clamp(x, panel.x0, panel.x1), panel.y1};
}
Rect right_of(const Rect& panel, int x) {
  return {std::clamp(x, panel.x0, panel.x1), panel.y0, panel.x1, panel.y1};
}

// Where the divider of a swipe stands, perhaps beside the panel.
int swipe_divider(const WindowState& state, const Rect& panel) {
  const double width = picture_size(state).x * state.view.zoom;
  return static_cast<int>(std::lround(picture_origin(state.view, panel).x + state.swipe * width));
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
  const int divider = swipe_divider(state, panel);
  const auto [before, after] = swipe_halves(state, panel);
  const std::size_t first = state.view.flipped ? 1 : 0;
  draw_clipped(list, contents.textures[first], size, state.view, panel, before);
  draw_clipped(list, contents.textures[1 - first], size, state.view, panel, after);
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

// Of all of the lesson's text, at scale 1.
double lesson_height(const WindowState& state, int width, double scale) {
  const int rows = lesson_rows(state, width, scale);
  return state.step >= 0 ? 1.2 * kTitleText * rows + 56 : 1.2 * kCaptionText * rows + 28;
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
  const int margin = pixels(24), line = pixels(kButtonLine), width = room.x - 2 * margin;
  int footer = buttons_height(state, width, scale);
  const int whole_lesson = state.lesson ? pixels(lesson_height(state, room.x - margin, scale)) : 0;
  int lesson = whole_lesson, inspector = state.inspected ? std::max(pixels(120), size.y * 2 / 5) : 0;
  int slow = state.slow ? pixels(2.6 * kSmallText) : 0;
  int legend = legend_height(state, width, scale);

  // Words give way to the pictures, in this order: the histogram; the times; the title; of inspector and lesson, which can
  // be scrolled, all but a row; the buttons' words, not their keys; all but a row of the legend; the inspector; the lesson;
  // the legend. Where there is no room for them beside the captions, at last the buttons.
  LayoutOptions options{scale, true, state.opened.times, true};
  const auto head = [&] { return layout_size({0, 0}, options).y - line; };
  const auto missing = [&] {
    return head() + size.y * 3 / 10 + legend + slow + inspector + lesson + footer - size.y;
  };
  const auto shrink = [&](int& part, int least, double share) {
    if (missing() > 0) part = std::max(std::min(part, least), static_cast<int>(part - share * missing()));
  };
  // With the padding and the spacing of canvas.cpp.
  const int row_of_lesson = pixels(state.step >= 0 ? kTitleText + kSmallText + 27 : kCaptionText + 23);
  const int row_of_inspector = pixels(kCaptionText + kSmallText + 26);
  if (missing() > 0) legend = legend_height(state, width, scale, true);
  if (missing() > 0) options.times = false;
  if (missing() > 0 && !state.faults.any()) options.title = false;  // faults are always said
  shrink(inspector, row_of_inspector, static_cast<double>(inspector) / std::max(1, inspector + lesson));
  shrink(lesson, row_of_lesson, 1);
  shrink(inspector, row_of_inspector, 1);
  if (missing() > 0) footer = buttons_height(state, width, scale, true);
  if (missing() > 0 && legend > 0) {
    const double rows = std::floor((legend - missing() - pixels(kLegendFoot)) / (kLegendLine * scale));
    legend = std::min(legend, pixels(kLegendLine * std::max(1.0, rows) + kLegendFoot));
  }
  if (missing() > 0) inspector = 0;
  if (missing() < 0) lesson = std::min(whole_lesson, lesson - missing());
  if (missing() > 0) lesson = 0;
  if (missing() > 0) legend = 0;
  if (head() + slow + footer > size.y) slow = 0;
  if (head() + footer > size.y) footer = 0;

  int bottom = size.y - footer;
  const auto take = [&](int height) {
    const int top = std::max(0, bottom - height);
    const Rect box{0, top, room.x, bottom};
    bottom = top;
    return box;
  };
  out.lesson = take(lesson);
  out.inspector = take(inspector);
  out.slow = take(slow);
  out.legend = take(legend);
  out.legend.x0 += margin;
  out.legend.x1 -= margin;
  const int gap = bottom + footer < size.y ? pixels(8) : 0;  // above what stands there
  room.y = bottom - gap + line;
  out.panels = make_layout(room, options);
  out.panels.footer = {margin, size.y - footer, room.x - margin, size.y};
  if (one_panel(state)) out.panels = joined(out.panels);
  if (state.help) out.help = {size.x / 24, size.y / 24, size.x - size.x / 24, size.y - size.y / 24};
  return out;
}

std::pair<Rect, Rect> swipe_halves(const WindowState& state, const Rect& panel) {
  const int divider = swipe_divider(state, panel);
  return {left_of(panel, divider), right_of(panel, divider)};
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
  draw_line(list, *canvas.fonts().title, layout.panels.title, kText, window_title(contents.state));
  if (!contents.shown.panels.empty()) {
    draw_panels(canvas, list, contents, layout.panels);
    draw_marks(canvas, contents, layout);
  }
  draw_notice(canvas, list, contents, layout.panels);
  if (!empty(layout.panels.footer)) draw_buttons(canvas, contents, layout.panels.footer, out);
  if (!empty(layout.legend)) draw_legend(canvas, contents, layout.legend);
  if (!empty(layout.slow)) draw_slow_motion(canvas, contents, layout.slow, out);
  if (!empty(layout.inspector)) draw_inspector(canvas, contents, layout.inspector, out);
  if (!empty(layout.lesson)) draw_lesson(canvas, contents, layout.lesson);
  if (!empty(layout.controls)) draw_controls(canvas, contents, layout.controls, out);
  if (!empty(layout.help)) draw_help(canvas, layout.help);
  const bool busy = ImGui::IsAnyItemActive() || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
  if (key_target(contents.state) == KeyTarget::pictures && !busy) ImGui::SetWindowFocus(nullptr);
  return out;
}

void follow_keys(const WindowState& state, KeyTarget target, float around) {
  if (key_target(state) != target) return;
  const bool focused = ImGui::IsWindowFocused(ImGuiFocusedFlags_ChildWindows);
  if (!focused && !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) ImGui::SetWindowFocus();
  const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRect({low.x - around, low.y - around}, {low.x + size.x + around, low.y + size.y + around}, kText, 4,
               0, 3);
}

void key_button(const char* label, std::vector<Command>& out) {
  if (ImGui::Button(label))
    out.push_back([key = std::string(label, 1)](Session& session) { session.press(key); });
}

DockWindow::DockWindow(const char* name, const Rect& box, bool scrollbar) {
  ImGui::SetNextWindowPos(point(box.x0, box.y0));
  ImGui::SetNextWindowSize(point(box.width(), box.height()));
  const int decoration = ImGuiWindowFlags_NoDecoration & ~(scrollbar ? ImGuiWindowFlags_NoScrollbar : 0);
  ImGui::Begin(name, nullptr, decoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
}
DockWindow::~DockWindow() { ImGui::End(); }

}  // namespace sidelight
