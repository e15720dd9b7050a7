// SPDX-License-Identifier: MIT
// The panels of words: buttons along the bottom, the lesson, the keys.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.h"
#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"
#include "viewer/window/window_panels.h"

namespace sidelight {
namespace {

void text(const std::string& words) { ImGui::TextUnformatted(words.data(), words.data() + words.size()); }

// A paragraph a line, wrapped to the window; nothing in it can steer what is drawn.
void paragraphs(const std::string& words) {
  ImGui::PushTextWrapPos(0);
  for (std::size_t at = 0; at <= words.size();) {
    const std::size_t end = std::min(words.find('\n', at), words.size());
    text(printable(words.substr(at, end - at), 4000));
    at = end + 1;
  }
  ImGui::PopTextWrapPos();
}

// What is under the cursor, in the words of the footer.
std::string cursor_text(const WindowContents& contents) {
  const WindowState& state = contents.state;
  std::string out = zoom_text(state.view.zoom);
  if (!state.cursor) return out;
  const Rect part = shown_part(state);
  const glm::ivec2 pixel = glm::ivec2(glm::floor(*state.cursor)) + glm::ivec2(part.x0, part.y0);
  return out + fmt::format("   pixel {},{}", pixel.x, pixel.y);
}

struct ModeButton {
  const char* label;
  Action action;
};
constexpr std::array<ModeButton, 8> kButtons{{{"1 both", Action::side_by_side},
                                              {"2 swipe", Action::swipe},
                                              {"3 flip", Action::flip},
                                              {"4 difference", Action::difference},
                                              {"5 causes", Action::causes},
                                              {"6 ledger", Action::ledger},
                                              {"7 layer", Action::next_layer},
                                              {"9 one", Action::next_alone}}};

bool is_on(const WindowState& state, Action action) {
  switch (action) {
    case Action::side_by_side:
      return state.mode == Mode::side_by_side;
    case Action::swipe:
      return state.mode == Mode::swipe;
    case Action::flip:
      return state.mode == Mode::flip;
    case Action::difference:
      return state.mode == Mode::difference;
    case Action::causes:
      return state.mode == Mode::causes;
    case Action::ledger:
      return state.mode == Mode::ledger;
    case Action::next_layer:
      return layer_of(state.mode).has_value();
    case Action::next_alone:
      return state.mode == Mode::raster || state.mode == Mode::raytrace;
    case Action::controls:
      return state.controls;
    case Action::lesson:
      return state.lesson;
    case Action::slow_motion:
      return state.slow;
    default:
      return false;
  }
}

void button(const WindowState& state, const char* label, Action action, std::vector<Command>& out) {
  const bool on = is_on(state, action);
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.26f, 0.47f, 0.72f, 1));
  if (ImGui::Button(label)) out.push_back([action](Session& session) { session.act(action, {}); });
  if (on) ImGui::PopStyleColor();
  ImGui::SameLine();
}

}  // namespace

void draw_buttons(const Canvas& canvas, const WindowContents& contents, const Rect& box,
                  std::vector<Command>& out) {
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0, 0, 0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, point(0, 6 * canvas.scale()));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  {
    const DockWindow window("##buttons", box);
    for (const ModeButton& each : kButtons) button(contents.state, each.label, each.action, out);
    button(contents.state, "o slow", Action::slow_motion, out);
    button(contents.state, "c controls", Action::controls, out);
    if (!contents.state.opened.scene.steps.empty())
      button(contents.state, "n lesson", Action::next_step, out);
    button(contents.state, "h help", Action::help, out);
    const std::string where = cursor_text(contents);
    const float right = static_cast<float>(box.width()) - ImGui::CalcTextSize(where.c_str()).x;
    if (right > ImGui::GetCursorPosX()) {
      ImGui::SetCursorPosX(right);
      ImGui::AlignTextToFramePadding();
      text(where);
    }
  }
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

void draw_lesson(const Canvas& canvas, const WindowContents& contents, const Rect& box) {
  const WindowState& state = contents.state;
  const std::vector<Step>& steps = state.opened.scene.steps;
  const DockWindow window("##lesson", box);
  if (state.step >= 0 && state.step < static_cast<int>(steps.size())) {
    ImGui::PushFont(canvas.fonts().title);
    ImGui::PushStyleColor(ImGuiCol_Text, kText);
    paragraphs(steps[static_cast<std::size_t>(state.step)].text);
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::PushStyleColor(ImGuiCol_Text, kQuiet);
    text(fmt::format("step {} of {}{}", state.step + 1, steps.size(),
                     state.revealed ? "" : "   predict, then press n to see"));
    ImGui::PopStyleColor();
  } else {
    ImGui::PushFont(canvas.fonts().caption);
    const std::string& lesson = state.opened.scene.lesson;
    paragraphs(lesson.empty() ? "This scene has no lesson." : lesson);
    ImGui::PopFont();
  }
}

void draw_help(const Canvas& canvas, const Rect& box) {
  ImGui::SetNextWindowFocus();
  const DockWindow window("##help", box);
  ImGui::PushFont(canvas.fonts().title);
  text("Keys");
  ImGui::PopFont();
  const auto groups = key_help();
  const float column = static_cast<float>(box.width()) / static_cast<float>(groups.size());
  const float top = ImGui::GetCursorPosY() + static_cast<float>(8 * canvas.scale());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const float left = static_cast<float>(i) * column + static_cast<float>(16 * canvas.scale());
    ImGui::SetCursorPos({left, top});
    ImGui::BeginGroup();
    ImGui::PushStyleColor(ImGuiCol_Text, kLeftAccent);
    ImGui::PushFont(canvas.fonts().caption);
    text(std::string(groups[i].title));
    ImGui::PopFont();
    ImGui::PopStyleColor();
    for (const KeyHelp& line : groups[i].lines) {
      ImGui::PushStyleColor(ImGuiCol_Text, kRightAccent);
      text(std::string(line.keys));
      ImGui::PopStyleColor();
      ImGui::SameLine(column * 0.42f);
      ImGui::PushTextWrapPos(left + column - static_cast<float>(16 * canvas.scale()));
      text(std::string(line.text));
      ImGui::PopTextWrapPos();
    }
    ImGui::EndGroup();
  }
}

}  // namespace sidelight
