// SPDX-License-Identifier: MIT
// The panels of words: buttons along the bottom, the lesson, the keys.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "common/error.h"
#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"
#include "viewer/window/window_panels.h"

namespace sidelight {
namespace {

// A line each; nothing in them can steer what is drawn.
std::vector<std::string> paragraphs_of(const std::string& words) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at <= words.size();) {
    const std::size_t end = std::min(words.find('\n', at), words.size());
    out.push_back(printable(words.substr(at, end - at), 4000));
    at = end + 1;
  }
  return out;
}

// Wrapped to the window, in whole rows, so many as fit into `height`, but one at least. Where there are more, they can be
// scrolled to, and an ellipsis behind the last row in sight says so, in a margin of its own.
void paragraphs(const WindowState& state, const std::string& words, float height) {
  const float row = ImGui::GetTextLineHeight(), room = row * std::max(1.0f, std::floor(height / row));
  const std::vector<std::string> all = paragraphs_of(words);
  const auto height_at = [&](float width) {
    float sum = 0;
    for (const std::string& each : all) sum += ImGui::CalcTextSize(each.c_str(), nullptr, false, width).y;
    return sum;
  };
  ImGui::BeginChild("##words", ImVec2(0, room), false, ImGuiWindowFlags_NoScrollbar);
  follow_keys(state, KeyTarget::lesson, ImGui::GetStyle().WindowPadding.x / 2);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  const char* const dots = ellipsis(*ImGui::GetFont());
  const float whole = ImGui::GetContentRegionAvail().x;
  const float width = height_at(whole) > room ? std::max(1.0f, whole - ImGui::CalcTextSize(dots).x) : whole;
  ImGui::PushTextWrapPos(width);
  for (const std::string& each : all) text(each);
  ImGui::PopTextWrapPos();
  // Half a row may be lost to rounding.
  if (width < whole && ImGui::GetScrollY() + room < height_at(width) - row / 2) {
    const ImVec2 corner = ImGui::GetWindowPos();
    ImGui::GetWindowDrawList()->AddText({corner.x + width, corner.y + room - row}, kText, dots);
  }
  ImGui::PopStyleVar();
  ImGui::EndChild();
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

// Each presses the key that its label begins with.
struct Button {
  const char* label;
  bool (*is_on)(const WindowState& state);
};
constexpr auto kButtons = std::to_array<Button>({
    {"1 both", [](const WindowState& s) { return s.mode == Mode::side_by_side; }},
    {"2 swipe", [](const WindowState& s) { return s.mode == Mode::swipe; }},
    {"3 flip", [](const WindowState& s) { return s.mode == Mode::flip; }},
    {"4 difference", [](const WindowState& s) { return s.mode == Mode::difference; }},
    {"5 causes", [](const WindowState& s) { return s.mode == Mode::causes; }},
    {"6 ledger", [](const WindowState& s) { return s.mode == Mode::ledger; }},
    {"7 layer", [](const WindowState& s) { return layer_of(s.mode).has_value(); }},
    {"9 one", [](const WindowState& s) { return s.mode == Mode::raster || s.mode == Mode::raytrace; }},
    {"o slow", [](const WindowState& s) { return s.slow; }},
    {"c controls", [](const WindowState& s) { return s.controls; }},
    {"n lesson", [](const WindowState&) { return false; }},
    {"h help", [](const WindowState&) { return false; }},
});

bool is_there(const WindowState& state, const Button& button) {
  return button.label[0] != 'n' || !state.opened.scene.steps.empty();
}

// The keys as people read them: those of a kind together, under a title.
struct KeyHelp {
  std::string_view keys, text;
};
struct KeyGroup {
  std::string_view title;
  std::span<const KeyHelp> lines;
};
constexpr auto kLooking = std::to_array<KeyHelp>({
    {"1", "side by side"},
    {"2", "swipe (drag, < >)"},
    {"3", "flip in place"},
    {"4", "signed difference"},
    {"5", "causes"},
    {"6", "ledger"},
    {"7 8", "a layer alone"},
    {"9", "one picture alone"},
    {"Space", "swap the two; next term of the ledger"},
    {"wheel + -", "zoom about the cursor"},
    {"right drag", "move the pictures"},
    {"0, Home", "the whole picture"},
});
constexpr auto kMoving = std::to_array<KeyHelp>({
    {"drag, arrows", "orbit"},
    {"with Shift", "slide"},
    {"Ctrl wheel . ,", "nearer, farther"},
    {"d D", "longer, shorter paths"},
    {"f g r", "shadows, reflection, refraction"},
    {"a A", "more, fewer samples"},
    {"c", "controls"},
    {"Tab", "arrows, Space to the next open panel"},
    {"z", "reset"},
    {"s", "save as a new scene"},
});
constexpr auto kTeaching = std::to_array<KeyHelp>({
    {"n p", "next, previous step (PageDown, PageUp)"},
    {"l", "lesson text"},
    {"] [", "next, previous scene"},
    {"click, i", "inspect a pixel"},
    {"y", "copy as command"},
    {"o", "slow motion"},
    {"k j", "  more, fewer"},
    {"t", "text size"},
    {"h ? F1", "help"},
    {"Esc", "back, then close"},
    {"q", "close"},
});
constexpr std::array<KeyGroup, 3> kGroups{
    {{"Look", kLooking}, {"Move and change", kMoving}, {"Teach", kTeaching}}};

// What the lesson's panel says: the step, or else what the scene is about.
std::string lesson_text(const WindowState& state) {
  const Scene& scene = state.opened.scene;
  if (state.step >= 0 && state.step < static_cast<int>(scene.steps.size()))
    return scene.steps[static_cast<std::size_t>(state.step)].text;
  return scene.lesson.empty() ? "This scene has no lesson." : scene.lesson;
}

// The label, or the key alone that it begins with.
std::string label_of(const Button& button, bool brief) {
  return std::string(button.label).substr(0, brief ? 1 : std::string::npos);
}

}  // namespace

int buttons_height(const WindowState& state, int width, double scale, bool brief) {
  constexpr double kAround = 2 * 9;  // FramePadding of canvas.cpp
  std::vector<double> widths;
  for (const Button& each : kButtons)
    if (is_there(state, each))
      widths.push_back(kAround * scale + text_width_bound(label_of(each, brief).size(), kSmallText * scale));
  const auto pixels = [&](double length) { return static_cast<int>(std::lround(length * scale)); };
  return pixels(kButtonLine) + pixels(1.8 * kSmallText) * (flow_rows(widths, 8 * scale, width) - 1);
}

void draw_buttons(const Canvas& canvas, const WindowContents& contents, const Rect& box,
                  std::vector<Command>& out) {
  const bool brief = box.height() < buttons_height(contents.state, box.width(), canvas.scale());
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0, 0, 0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, point(0, 6 * canvas.scale()));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  {
    const DockWindow window("##buttons", box);
    const auto width = static_cast<float>(box.width());
    const float padding = 2 * ImGui::GetStyle().FramePadding.x;
    for (const Button& each : kButtons) {
      if (!is_there(contents.state, each)) continue;
      const std::string label = label_of(each, brief);
      if (ImGui::GetCursorPosX() + ImGui::CalcTextSize(label.c_str()).x + padding > width) ImGui::NewLine();
      const bool on = each.is_on(contents.state);
      if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.26f, 0.47f, 0.72f, 1));
      key_button(label.c_str(), out);
      if (on) ImGui::PopStyleColor();
      ImGui::SameLine();
    }
    const std::string where = cursor_text(contents);
    const float right = width - ImGui::CalcTextSize(where.c_str()).x;
    if (right > ImGui::GetCursorPosX()) {
      ImGui::SetCursorPosX(right);
      ImGui::AlignTextToFramePadding();
      text(where);
    }
  }
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

int lesson_rows(const WindowState& state, int width, double scale) {
  const double height = (state.step >= 0 ? kTitleText : kCaptionText) * scale;
  const std::string words = lesson_text(state);
  int rows = 0;
  for (std::size_t at = 0; at <= words.size();) {
    const std::size_t end = std::min(words.find('\n', at), words.size());
    // Running text is 0.46 of its height a character, and loses a little at the end of a row.
    rows += 1 + static_cast<int>(0.5 * height * static_cast<double>(end - at) / std::max(1, width));
    at = end + 1;
  }
  return rows;
}

void draw_lesson(const Canvas& canvas, const WindowContents& contents, const Rect& box) {
  const WindowState& state = contents.state;
  const DockWindow window("##lesson", box);
  const float under = state.step >= 0 ? ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y : 0;
  const float height = ImGui::GetContentRegionAvail().y - under;
  ImGui::PushFont(state.step >= 0 ? canvas.fonts().title : canvas.fonts().caption);
  paragraphs(state, lesson_text(state), height);
  ImGui::PopFont();
  if (state.step < 0) return;
  text(fmt::format("step {} of {}{}", state.step + 1, state.opened.scene.steps.size(),
                   state.revealed ? "" : "   predict, then press n to see"),
       kQuiet);
}

void draw_help(const Canvas& canvas, const Rect& box) {
  ImGui::SetNextWindowFocus();
  const DockWindow window("##help", box);
  // All keys at once, if need be in smaller letters: so much room they take at scale 1.
  constexpr double kWidth = 1290, kHeight = 590;
  const double fitting =
      std::min({1.0, box.width() / (kWidth * canvas.scale()), box.height() / (kHeight * canvas.scale())});
  const double scale = canvas.scale() * fitting;
  ImGui::SetWindowFontScale(static_cast<float>(fitting));
  ImGui::PushFont(canvas.fonts().title);
  text("Keys");
  ImGui::PopFont();
  const float column = static_cast<float>(box.width()) / static_cast<float>(kGroups.size());
  const float top = ImGui::GetCursorPosY() + static_cast<float>(8 * scale);
  for (std::size_t i = 0; i < kGroups.size(); ++i) {
    const float left = static_cast<float>(i) * column + static_cast<float>(16 * scale);
    ImGui::SetCursorPos({left, top});
    ImGui::BeginGroup();
    ImGui::PushFont(canvas.fonts().caption);
    text(kGroups[i].title, kLeftAccent);
    for (const KeyHelp& line : kGroups[i].lines) {
      text(line.keys, kRightAccent);
      ImGui::SameLine(column * 0.42f);
      ImGui::PushTextWrapPos(left + column - static_cast<float>(16 * scale));
      text(line.text);
      ImGui::PopTextWrapPos();
    }
    ImGui::PopFont();
    ImGui::EndGroup();
  }
}

}  // namespace sidelight
