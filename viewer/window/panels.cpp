// SPDX-License-Identifier: MIT
#include "viewer/window/panels.h"

#include <imgui.h>

#include <glm/common.hpp>
#include <stdexcept>

#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"

namespace sidelight {

std::string traced_name(const TraceSettings& trace) {
  std::string terms;
  const auto add = [&](bool on, const char* name) {
    if (on) terms += (terms.empty() ? "" : ", ") + std::string(name);
  };
  add(trace.shadows, "shadows");
  add(trace.reflection, "mirrors");
  add(trace.refraction, "glass");
  return "ray tracer: " + (terms.empty() ? "local light only" : terms);
}

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
}

}  // namespace sidelight
