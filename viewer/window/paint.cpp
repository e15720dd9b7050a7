// SPDX-License-Identifier: MIT
#include "viewer/window/paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <glm/common.hpp>

#include "common/error.h"
#include "viewer/window/canvas.h"

namespace sidelight {
namespace {

// The longest beginning of `text` that fits into `width`, with an ellipsis if it is not all of it.
std::string ellipsised(const ImFont& font, const std::string& text, float width) {
  const char* end = text.data() + text.size();
  const auto width_of = [&](std::string_view part) {
    return font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, part.data(), part.data() + part.size()).x;
  };
  if (width_of(text) <= width) return text;
  const std::string_view dots = ellipsis(font);
  const char* cut = text.data();
  font.CalcTextSizeA(font.FontSize, std::max(0.0f, width - width_of(dots)), 0, text.data(), end, &cut);
  if (cut == text.data()) return {};
  return std::string(text.data(), cut).append(dots);
}

std::string milliseconds(double ms) { return fmt::format("{:.{}f} ms", ms, ms < 10 ? 2 : ms < 100 ? 1 : 0); }

}  // namespace

void text(std::string_view words, ImU32 color) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(words.data(), words.data() + words.size());
  ImGui::PopStyleColor();
}

const char* ellipsis(const ImFont& font) {
  return font.FindGlyphNoFallback(0x2026) != nullptr ? "\u2026" : "...";
}

void draw_line(ImDrawList& list, const ImFont& font, const Rect& box, ImU32 color, const std::string& text) {
  if (box.width() <= 0 || box.height() <= 0) return;
  const std::string line = ellipsised(font, printable(text), static_cast<float>(box.width()));
  const double y = box.y0 + std::floor((box.height() - static_cast<double>(font.FontSize)) / 2);
  list.PushClipRect(point(box.x0, box.y0), point(box.x1, box.y1), true);
  list.AddText(&font, font.FontSize, point(box.x0, y), color, line.data(), line.data() + line.size());
  list.PopClipRect();
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
  // Where there is no room for all, the name alone, and the frame's time alone.
  const auto draw = [&](const ImFont& font, Rect box, ImU32 color, const std::string& all,
                        const std::string& less) {
    box.x0 += indent;
    const bool fits = font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, printable(all).c_str()).x <=
                      static_cast<float>(box.width());
    draw_line(list, font, box, color, fits ? all : less);
  };
  draw(*canvas.fonts().caption, name_box, kText, caption.name,
       caption.name.substr(0, caption.name.find(':')));
  if (!caption.times) return;
  const std::string frame = "frame " + milliseconds(caption.times->frame_ms);
  const std::string& rate = caption.times->rate;
  draw(*canvas.fonts().small, times_box, kQuiet,
       "build " + milliseconds(caption.times->build_ms) + ", " + frame + (rate.empty() ? "" : ", " + rate),
       frame);
}

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
  return zoom >= 1 ? fmt::format("zoom {:.0f}\u00D7", zoom) : fmt::format("zoom {:.0f} %", 100 * zoom);
}

}  // namespace sidelight
