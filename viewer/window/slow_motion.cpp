// SPDX-License-Identifier: MIT
// The two loop orders in slow motion: a slider each, under the picture that it builds up.
#include <imgui.h>

#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"
#include "viewer/window/window_panels.h"

namespace sidelight {

void draw_slow_motion(const Canvas& canvas, const WindowContents& contents, const Rect& box,
                      std::vector<Command>& out) {
  const WindowState& state = contents.state;
  const DockWindow window("##slow", box);
  int objects = state.objects, rows = state.rows;
  const auto half = static_cast<float>(box.width() / 2.0 - 24 * canvas.scale());
  ImGui::SetNextItemWidth(half);
  bool moved = ImGui::SliderInt("##objects", &objects, 0, static_cast<int>(state.drawn->objects.size()),
                                "for each object: %d rasterized");
  ImGui::SameLine(static_cast<float>(box.width() / 2.0 + 4 * canvas.scale()));
  ImGui::SetNextItemWidth(half);
  moved =
      ImGui::SliderInt("##rows", &rows, 0, state.scene->height, "for each pixel: %d rows traced") || moved;
  if (moved) out.push_back([objects, rows](Session& session) { session.set_slow(objects, rows); });
}

}  // namespace sidelight
