// SPDX-License-Identifier: MIT
#include "viewer/window/panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <stdexcept>
#include <string_view>

#include "common/error.h"
#include "viewer/window/canvas.h"

namespace sidelight {
namespace {

constexpr ImU32 kPage = IM_COL32(22, 24, 29, 255);
constexpr ImU32 kFrame = IM_COL32(84, 90, 102, 255);
constexpr ImU32 kText = IM_COL32(240, 242, 245, 255);
constexpr ImU32 kQuiet = IM_COL32(166, 174, 188, 255);
// Okabe and Ito's orange and sky blue: told apart with any colour vision. They follow their picture when
// flipped.
constexpr ImU32 kLeftAccent = IM_COL32(230, 159, 0, 255);
constexpr ImU32 kRightAccent = IM_COL32(86, 180, 233, 255);

ImVec2 point(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }
ImVec2 point(glm::dvec2 p) { return point(p.x, p.y); }

// The longest beginning of `text` that fits into `width`, with an ellipsis if it is not all of it.
std::string ellipsised(const ImFont& font, const std::string& text, float width) {
  const char* end = text.data() + text.size();
  const auto width_of = [&](std::string_view part) {
    return font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, part.data(), part.data() + part.size()).x;
  };
  if (width_of(text) <= width) return text;
  const std::string_view dots = font.FindGlyphNoFallback(0x2026) != nullptr ? "\u2026" : "...";
  const char* cut = text.data();
  font.CalcTextSizeA(font.FontSize, std::max(0.0f, width - width_of(dots)), 0, text.data(), end, &cut);
  if (cut == text.data()) return {};
  return std::string(text.data(), cut).append(dots);
}

// One line of text, in the middle of the height of its box, clipped to it.
void draw_line(ImDrawList& list, const ImFont& font, const Rect& box, ImU32 color, const std::string& text) {
  if (box.width() <= 0 || box.height() <= 0) return;
  const std::string line = ellipsised(font, printable(text), static_cast<float>(box.width()));
  const double y = box.y0 + std::floor((box.height() - static_cast<double>(font.FontSize)) / 2);
  list.PushClipRect(point(box.x0, box.y0), point(box.x1, box.y1), true);
  list.AddText(&font, font.FontSize, point(box.x0, y), color, line.data(), line.data() + line.size());
  list.PopClipRect();
}

std::string milliseconds(double ms) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f ms", ms < 10 ? 2 : ms < 100 ? 1 : 0, ms);
  return text;
}

void draw_caption(const Canvas& canvas, ImDrawList& list, const Caption& caption, ImU32 accent,
                  const Rect& name_box, const Rect& times_box) {
  // A bar in the renderer's colour, then the text, indented by one letter.
  const int bar = static_cast<int>(std::lround(5 * canvas.scale()));
  const int indent = static_cast<int>(std::lround(14 * canvas.scale()));
  const int inset = static_cast<int>(std::lround(4 * canvas.scale()));
  const Rect both{name_box.x0, name_box.y0, name_box.x1, std::max(name_box.y1, times_box.y1)};
  list.AddRectFilled(point(both.x0, both.y0 + inset),
                     point(std::min(both.x0 + bar, both.x1), both.y1 - inset * 2), accent);
  const auto indented = [&](Rect box) { return Rect{box.x0 + indent, box.y0, box.x1, box.y1}; };
  draw_line(list, *canvas.fonts().caption, indented(name_box), kText, caption.name);
  if (caption.times)
    draw_line(list, *canvas.fonts().small, indented(times_box), kQuiet,
              "build " + milliseconds(caption.times->build_ms) + ", frame " +
                  milliseconds(caption.times->frame_ms));
}

// The pixels of the picture that reach into the panel, as one textured rectangle over a slightly larger one
// that shows as its frame. Its corners are picture pixels' corners: at large zooms a rectangle for the whole
// picture would run far off the screen, and its texture coordinates out of float's digits.
void draw_picture(ImDrawList& list, ImTextureID texture, glm::ivec2 size, const View& view,
                  const Rect& panel) {
  if (panel.width() <= 0 || panel.height() <= 0) return;
  const glm::dvec2 low(panel.x0, panel.y0), high(panel.x1, panel.y1), whole(size);
  const glm::dvec2 origin = picture_origin(view, panel);
  const glm::dvec2 first = glm::clamp(glm::floor((low - origin) / view.zoom), glm::dvec2(0), whole);
  const glm::dvec2 last = glm::clamp(glm::ceil((high - origin) / view.zoom), glm::dvec2(0), whole);
  const glm::dvec2 from = origin + first * view.zoom, to = origin + last * view.zoom;

  list.AddRectFilled(point(glm::max(from, low) - 1.0), point(glm::min(glm::ceil(to), high) + 1.0), kFrame);
  list.PushClipRect(point(low), point(high), true);
  list.AddImage(texture, point(from), point(to), point(first / whole), point(last / whole));
  list.PopClipRect();
}

std::string zoom_text(double zoom) {
  char text[40];
  if (zoom >= 1)
    std::snprintf(text, sizeof text, "zoom %.0f\u00D7", zoom);
  else
    std::snprintf(text, sizeof text, "zoom %.0f %%", 100 * zoom);
  return text;
}

}  // namespace

void check_pictures(const Image8& left, const Image8& right) {
  const auto bytes = [](const Image8& image) {
    return 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  };
  const auto name = [](const Image8& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height) + " (" +
           std::to_string(image.rgb.size()) + " bytes)";
  };
  const bool same = left.width == right.width && left.height == right.height;
  if (!same || left.width < 1 || left.height < 1 || left.rgb.size() != bytes(left) ||
      right.rgb.size() != bytes(right))
    throw std::invalid_argument("pictures that cannot stand side by side: " + name(left) + " and " +
                                name(right));
}

LayoutOptions layout_options(const Labels& labels, bool footer, double scale) {
  return {scale, !labels.title.empty(), labels.left.times || labels.right.times, footer};
}

void draw_comparison(const Canvas& canvas, const ShownPictures& pictures, const Labels& labels,
                     const Layout& layout, const View& view) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({0, 0}, ImGui::GetIO().DisplaySize, kPage);
  draw_line(list, *canvas.fonts().title, layout.title, kText, labels.title);

  const auto draw_side = [&](bool is_left, const Rect& caption, const Rect& times, const Rect& panel) {
    draw_caption(canvas, list, is_left ? labels.left : labels.right, is_left ? kLeftAccent : kRightAccent,
                 caption, times);
    draw_picture(list, is_left ? pictures.left : pictures.right, pictures.size, view, panel);
  };
  const glm::dvec2 inset = picture_origin(view, layout.left) - glm::dvec2(layout.left.x0, layout.left.y0);
  const Layout at = with_captions_at(layout, glm::ivec2(glm::max(inset, glm::dvec2(0))), canvas.scale());
  draw_side(!view.flipped, at.left_caption, at.left_times, at.left);
  draw_side(view.flipped, at.right_caption, at.right_times, at.right);

  draw_line(list, *canvas.fonts().small, layout.footer, kQuiet,
            zoom_text(view.zoom) +
                "     wheel: zoom     drag: move     0: whole picture     space: swap     q: close");
}

}  // namespace sidelight
