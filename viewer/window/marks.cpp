// SPDX-License-Identifier: MIT
// What is written on the pictures: the linked cursor, the numbers of pixels when far in, the inspected pixel and its
// rays.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

#include "viewer/window/camera_moves.h"
#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"
#include "viewer/window/window_panels.h"

namespace sidelight {
namespace {

// From this zoom on there is room for the numbers of a pixel.
constexpr double kNumbersZoom = 48;

struct OnePanel {
  const ShownPanel* shown;
  Rect box;   // the picture is placed by
  Rect seen;  // of it
};

std::vector<OnePanel> panels_in_place(const WindowContents& contents, const WindowLayout& layout) {
  const auto& panels = contents.shown.panels;
  const auto& [left, right] = std::tie(layout.panels.left, layout.panels.right);
  if (panels.size() == 1) return {{&panels.front(), left, left}};
  const ShownPanel *first = &panels[0], *second = &panels[1];
  if (contents.state.view.flipped) std::swap(first, second);
  if (!contents.shown.swipe) return {{first, left, left}, {second, right, right}};
  const auto [before, after] = swipe_halves(contents.state, left);
  return {{first, left, before}, {second, left, after}};
}

bool is_dark(const Image8& image, glm::ivec2 at) {
  const std::size_t i = 3 * (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(at.x));
  return 2 * image.rgb[i] + 5 * image.rgb[i + 1] + image.rgb[i + 2] < 8 * 120;
}

// The numbers of every pixel in sight, on the pixel, black on bright and white on dark.
void draw_numbers(const Canvas& canvas, ImDrawList& list, const WindowContents& contents,
                  const OnePanel& panel) {
  const View& view = contents.state.view;
  const glm::ivec2 size = picture_size(contents.state);
  const Image8& image = panel.shown->image;
  if (view.zoom < kNumbersZoom || image.width != size.x || image.height != size.y) return;
  const Rect part = shown_part(contents.state);
  const glm::dvec2 origin = picture_origin(view, panel.box);
  const ImFont& font = *canvas.fonts().small;
  const float height = static_cast<float>(std::floor(view.zoom / 4.2));
  const auto bound = [&](double edge, double from, int limit) {
    return std::clamp(static_cast<int>(std::floor((edge - from) / view.zoom)), 0, limit - 1);
  };
  for (int y = bound(panel.seen.y0, origin.y, size.y); y <= bound(panel.seen.y1, origin.y, size.y); ++y)
    for (int x = bound(panel.seen.x0, origin.x, size.x); x <= bound(panel.seen.x1, origin.x, size.x); ++x) {
      const std::vector<std::string> lines = panel.shown->numbers({x + part.x0, y + part.y0});
      const ImU32 color = is_dark(image, {x, y}) ? IM_COL32(255, 255, 255, 230) : IM_COL32(0, 0, 0, 230);
      const glm::dvec2 corner = origin + view.zoom * glm::dvec2(x, y) + 0.08 * view.zoom;
      for (std::size_t i = 0; i < lines.size(); ++i)
        list.AddText(
            &font, height,
            point(corner + glm::dvec2(0, static_cast<double>(height) * 1.15 * static_cast<double>(i))), color,
            lines[i].c_str());
    }
}

void draw_cursor(const Canvas& canvas, ImDrawList& list, const WindowContents& contents, const Rect& box) {
  if (!contents.state.cursor) return;
  const glm::dvec2 at =
      picture_origin(contents.state.view, box) + *contents.state.cursor * contents.state.view.zoom;
  const double s = canvas.scale();
  for (const auto& [grow, color] : {std::pair(1.0, kPage), std::pair(0.0, kText)})
    for (const glm::dvec2& way : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)})
      list.AddLine(point(at + way * (5 * s)), point(at + way * (14 * s)), color,
                   static_cast<float>((1.5 + 2 * grow) * s));
}

void draw_inspected(const Canvas& canvas, ImDrawList& list, const WindowContents& contents, const Rect& box) {
  if (!contents.state.inspected) return;
  const Rect part = shown_part(contents.state);
  const double zoom = contents.state.view.zoom, s = canvas.scale();
  const glm::dvec2 from = picture_origin(contents.state.view, box) +
                          zoom * glm::dvec2(*contents.state.inspected - glm::ivec2(part.x0, part.y0));
  const double around = std::max(0.0, 8 * s - zoom / 2);  // a pixel is small: a frame at some distance
  const auto frame = [&](ImU32 color, double width) {
    list.AddRect(point(from - around), point(from + zoom + around), color, 0, 0,
                 static_cast<float>(width * s));
  };
  frame(kPage, 5);
  frame(kText, 2.5);
}

// The part of a segment in front of the eye, in the panel's pixels.
void draw_segment(ImDrawList& list, const Camera& camera, RaySegment segment, const glm::dvec2& origin,
                  double zoom, float width) {
  const double near = 1e-3 * glm::distance(segment.from, segment.to) + 1e-9;
  const double a = in_front(camera, segment.from), b = in_front(camera, segment.to);
  if (a <= near && b <= near) return;
  if (a < near) segment.from += (near - a) / (b - a) * (segment.to - segment.from);
  if (b < near) segment.to = segment.from + (a - near) / (a - b) * (segment.to - segment.from);
  // Ends far outside the window are drawn to a point nearer by: floats have no digits for them.
  const auto on_screen = [&](const glm::dvec3& p) {
    return glm::clamp(origin + zoom * project(camera, p), glm::dvec2(-1e5), glm::dvec2(1e5));
  };
  const glm::dvec2 from = on_screen(segment.from), to = on_screen(segment.to);
  list.AddLine(point(from), point(to), IM_COL32(0, 0, 0, 160), width * 2);
  list.AddLine(point(from), point(to), segment_color(segment.kind), width);
  list.AddCircleFilled(point(to), width * 1.6f, segment_color(segment.kind));
}

void draw_rays(const Canvas& canvas, ImDrawList& list, const WindowContents& contents, const Rect& box) {
  if (!contents.inspection) return;
  const Inspection& inspection = *contents.inspection;
  const Camera camera =
      make_camera(contents.state.camera, contents.state.scene->width, contents.state.scene->height, 1);
  const Rect part = shown_part(contents.state);
  const double zoom = contents.state.view.zoom;
  const glm::dvec2 origin = picture_origin(contents.state.view, box) - zoom * glm::dvec2(part.x0, part.y0);
  for (const RaySegment& segment : ray_segments(inspection))
    draw_segment(list, camera, segment, origin, zoom, static_cast<float>(2 * canvas.scale()));
}

}  // namespace

void draw_marks(const Canvas& canvas, const WindowContents& contents, const WindowLayout& layout) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const View& view = contents.state.view;
  for (const OnePanel& panel : panels_in_place(contents, layout)) {
    if (panel.seen.width() <= 0 || panel.seen.height() <= 0) continue;
    const glm::dvec2 low =
        glm::max(picture_origin(view, panel.box), glm::dvec2(panel.seen.x0, panel.seen.y0));
    const glm::dvec2 high =
        picture_origin(view, panel.box) + view.zoom * glm::dvec2(picture_size(contents.state));
    list.PushClipRect(point(low), point(glm::min(high, glm::dvec2(panel.seen.x1, panel.seen.y1))));
    draw_numbers(canvas, list, contents, panel);
    draw_rays(canvas, list, contents, panel.box);
    draw_inspected(canvas, list, contents, panel.box);
    draw_cursor(canvas, list, contents, panel.box);
    list.PopClipRect();
  }
}

}  // namespace sidelight
