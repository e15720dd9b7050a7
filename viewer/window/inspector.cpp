// SPDX-License-Identifier: MIT
// The inspector's panel: left the fragments that competed for the pixel, right the tree of rays, in the words of
// `explain`; between them the specular lobe with the angle at which it is seen.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "viewer/report/plot_svg.h"
#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"
#include "viewer/window/window_panels.h"

namespace sidelight {
namespace {

using std::numbers::pi;

// A line of words, broken at spaces only (a number stays whole), each row under the line's own beginning: the tree of
// rays still shows.
void wrapped_line(std::string_view line) {
  const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
  const float indent = 2 * ImGui::CalcTextSize(" ").x * static_cast<float>(first);
  line.remove_prefix(first);
  const auto width = [&](std::size_t length) {
    return ImGui::CalcTextSize(line.data(), line.data() + length).x;
  };
  do {
    std::size_t length = line.size();
    while (width(length) > ImGui::GetContentRegionAvail().x - indent) {
      const std::size_t space = line.rfind(' ', length - 1);
      if (space == std::string_view::npos || space == 0) break;
      length = space;
    }
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
    ImGui::TextUnformatted(line.data(), line.data() + length);
    line.remove_prefix(std::min(length + 1, line.size()));
  } while (!line.empty());
}

void wrapped(const std::string& words) {
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find('\n', at), words.size());
    wrapped_line(std::string_view(words).substr(at, end - at));
    at = end + 1;
  }
}

// A column of text that scrolls on its own, under a coloured heading.
void column(const Canvas& canvas, const WindowState& state, KeyTarget side, float width,
            const std::string& heading, const std::string& words) {
  const bool left = side == KeyTarget::fragments;
  ImGui::BeginChild(left ? "##fragments" : "##rays", ImVec2(width, 0));
  follow_keys(state, side);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, point(0, 1));
  ImGui::PushFont(canvas.fonts().caption);
  ImGui::PushStyleColor(ImGuiCol_Text, left ? kLeftAccent : kRightAccent);
  wrapped(heading);
  ImGui::PopStyleColor();
  ImGui::PopFont();
  wrapped(words);
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

// Where an angle from the normal, positive to the right, points to in the plot.
glm::dvec2 towards(double angle) { return {std::sin(angle), -std::cos(angle)}; }

void draw_arrow(ImDrawList& list, const ImFont& font, glm::dvec2 foot, glm::dvec2 way, ImU32 color,
                float width, const char* label) {
  const double size = static_cast<double>(font.FontSize);
  list.AddLine(point(foot), point(foot + way), color, width);
  list.AddCircleFilled(point(foot + way), 1.6f * width, color);
  const glm::dvec2 at = foot + way * (1 + 0.6 * size / std::max(1.0, std::hypot(way.x, way.y)));
  list.AddText(&font, font.FontSize, point(at - glm::dvec2(0.35, 0.5) * size), color, label);
}

// The lecture's plot: surface, N, L, Rl and V, and cos^s about Rl as a curve, with the ray to the viewer marked where
// it meets it.
void draw_lobe(const Canvas& canvas, const Lobe& lobe, const Rect& box) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const double s = canvas.scale(), line = 1.3 * kSmallText * s;
  const double reach = std::min(box.width() * 0.42, box.height() - 4.4 * line);
  if (reach < 20 * s) return;
  const glm::dvec2 foot((box.x0 + box.x1) / 2.0, box.y1 - 3.2 * line);
  const ImFont& font = *canvas.fonts().small;
  const auto width = static_cast<float>(2 * s);
  list.AddLine(point(foot - glm::dvec2(reach * 1.1, 0)), point(foot + glm::dvec2(reach * 1.1, 0)), kFrame,
               width);

  const double mirrored = lobe.light_angle;
  const double viewer = mirrored + (lobe.towards_normal ? -lobe.view_angle : lobe.view_angle);
  const auto radius = [&](double from_mirrored) { return sidelight::lobe(from_mirrored, lobe.shininess); };
  constexpr int kPieces = 240;
  for (int i = 0; i <= kPieces; ++i) {
    const double angle = (2.0 * i / kPieces - 1) * pi / 2;
    if (std::abs(mirrored + angle) > pi / 2) continue;  // under the surface
    list.PathLineTo(point(foot + reach * radius(angle) * towards(mirrored + angle)));
  }
  list.PathStroke(kLeftAccent, 0, width);
  draw_arrow(list, font, foot, reach * towards(0), kQuiet, width, "N");
  draw_arrow(list, font, foot, 0.9 * reach * towards(-mirrored), kText, width, "L");
  draw_arrow(list, font, foot, reach * towards(mirrored), kLeftAccent, width, "R");
  draw_arrow(list, font, foot, 0.9 * reach * towards(viewer), kRightAccent, width, "V");
  list.AddCircleFilled(point(foot + reach * radius(lobe.view_angle) * towards(viewer)), 2.5f * width,
                       kRightAccent);
  const std::string words = fmt::format("light {}:\ncos({:.1f}\u00B0)^{:g} = {:.4g}", lobe.light + 1,
                                        lobe.view_angle * 180 / pi, lobe.shininess, lobe.value);
  list.AddText(&font, font.FontSize, point(box.x0, box.y1 - 2.2 * line), kText, words.c_str());
}

}  // namespace

void draw_inspector(const Canvas& canvas, const WindowContents& contents, const Rect& box,
                    std::vector<Command>& out) {
  const DockWindow window("##inspector", box);
  if (!contents.inspection) return text("looking ...");
  const Inspection& inspection = *contents.inspection;
  std::string heading = fmt::format("pixel {},{}: z-buffer {}", inspection.pixel.x, inspection.pixel.y,
                                    color_text(mean_color(inspection.samples, Side::raster)));
  if (contents.state.faults.any()) heading += "\n" + told_of_faults(contents.state.faults);
  const float whole = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
  // The middle is for the plot; where letters are large the words need it more.
  const bool plotted = box.width() > 900 * canvas.scale();
  const auto middle = plotted ? static_cast<float>(std::min(260 * canvas.scale(), box.width() / 5.0)) : 0.0f;
  const float side = (whole - middle) / 2 - gap;
  const ImVec2 top = ImGui::GetCursorScreenPos();
  column(canvas, contents.state, KeyTarget::fragments, side, heading,
         inspected_words(inspection, Side::raster));
  if (plotted) {
    ImGui::SetCursorScreenPos({top.x + side + gap, top.y});
    key_button("y copy as command", out);
    const int x = static_cast<int>(top.x + side + gap);
    if (const std::optional<Lobe> lobe = specular_lobe(inspection))
      draw_lobe(
          canvas, *lobe,
          {x, static_cast<int>(top.y + 2 * ImGui::GetFontSize()), x + static_cast<int>(middle), box.y1});
  }
  ImGui::SetCursorScreenPos({top.x + whole - side, top.y});
  column(canvas, contents.state, KeyTarget::rays, side,
         inspection.too_many_rays
             ? "ray tracer"
             : "ray tracer " + color_text(mean_color(inspection.samples, Side::raytrace)),
         inspected_words(inspection, Side::raytrace));
}

}  // namespace sidelight
