// SPDX-License-Identifier: MIT
// What panels are painted with: the colours, a line of text, a picture with its caption. All of it into a draw list of
// Dear ImGui, in device pixels, within Canvas::draw.
#pragma once

#include <imgui.h>

#include <glm/vec2.hpp>
#include <string>
#include <string_view>

#include "viewer/window/panels.h"
#include "viewer/window/view.h"

namespace sidelight {

class Canvas;

inline constexpr ImU32 kPage = IM_COL32(22, 24, 29, 255);
inline constexpr ImU32 kFrame = IM_COL32(84, 90, 102, 255);
inline constexpr ImU32 kText = IM_COL32(240, 242, 245, 255);
inline constexpr ImU32 kQuiet = IM_COL32(166, 174, 188, 255);
// Okabe and Ito's orange and sky blue: told apart with any colour vision. They follow their picture when
// flipped.
inline constexpr ImU32 kLeftAccent = IM_COL32(230, 159, 0, 255);
inline constexpr ImU32 kRightAccent = IM_COL32(86, 180, 233, 255);
inline constexpr ImU32 kWarning = IM_COL32(255, 140, 105, 255);

inline ImVec2 point(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }
inline ImVec2 point(glm::dvec2 p) { return point(p.x, p.y); }

// Of the widget window that is being drawn.
void text(std::string_view words, ImU32 color = kText);

// What stands where text was left out: U+2026, or three dots where the font has none.
const char* ellipsis(const ImFont& font);

// One line of text, in the middle of the height of its box, clipped to it; what is too long ends in an ellipsis.
void draw_line(ImDrawList& list, const ImFont& font, const Rect& box, ImU32 color, const std::string& text);

// A bar in the renderer's colour, its name, and the line of times.
void draw_caption(const Canvas& canvas, ImDrawList& list, const Caption& caption, ImU32 accent,
                  const Rect& name_box, const Rect& times_box);

// The pixels of the picture that reach into the panel, as one textured rectangle over a slightly larger one
// that shows as its frame. Its corners are picture pixels' corners: at large zooms a rectangle for the whole
// picture would run far off the screen, and its texture coordinates out of float's digits.
// `size` is the picture's; the texture may have fewer pixels.
void draw_picture(ImDrawList& list, ImTextureID texture, glm::ivec2 size, const View& view,
                  const Rect& panel);

// "zoom 2×", "zoom 50 %".
std::string zoom_text(double zoom);

}  // namespace sidelight
