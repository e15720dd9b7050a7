// SPDX-License-Identifier: MIT
// What the colours mean, in a row under the pictures: the causes with their numbers, or the rays of the inspected pixel.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "viewer/window/canvas.h"
#include "viewer/window/paint.h"
#include "viewer/window/window_panels.h"

namespace sidelight {
namespace {

// In the order of SegmentKind.
constexpr std::array<ImU32, 5> kSegmentColors{IM_COL32(255, 176, 60, 255), IM_COL32(60, 220, 160, 255),
                                              IM_COL32(200, 200, 200, 255), IM_COL32(255, 240, 140, 255),
                                              IM_COL32(90, 150, 255, 255)};
constexpr std::array<const char*, 5> kSegmentNames{"mirrored", "refracted", "straight on", "to a light: free",
                                                   "to a light: blocked"};

struct Entry {
  ImU32 color;
  std::string text;
};

ImU32 color_of(const glm::vec3& linear) {
  return IM_COL32(encode_srgb8(linear.x), encode_srgb8(linear.y), encode_srgb8(linear.z), 255);
}

// The map of causes is white where the terms do not make one picture of the other: where a fault is on that is its doing, and
// while slow motion has not drawn all objects there is nothing to count.
std::vector<Entry> cause_entries(const WindowState& state, const std::optional<Comparison>& comparison) {
  const std::vector<std::string> lines =
      comparison ? cause_lines(*comparison)
                 : std::vector<std::string>(kCauseNames.begin(), kCauseNames.end());
  std::vector<Entry> out;
  for (std::size_t i = 0; i < lines.size(); ++i) out.push_back({color_of(kCauseHues[i]), lines[i]});
  const ImU32 white = color_of(glm::vec3(1));
  if (!comparison)
    out.push_back({white, "no cause: not drawn yet"});
  else if (state.faults.any())
    out.push_back(
        {white, fmt::format("spoiled by faults: {} pixels of the account", comparison->unexplained)});
  else
    out.push_back({white, fmt::format("other surfaces seen: {}, unexplained: {}",
                                      comparison->visibility_mismatches, comparison->unexplained)});
  return out;
}

std::vector<Entry> ray_entries(const Inspection& inspection) {
  std::array<bool, kSegmentColors.size()> used{};
  for (const RaySegment& segment : ray_segments(inspection))
    used[static_cast<std::size_t>(segment.kind)] = true;
  std::vector<Entry> out;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) out.push_back({kSegmentColors[i], kSegmentNames[i]});
  return out;
}

// The longest there can be, for the room that they take.
std::vector<std::size_t> longest(const WindowState& state) {
  if (state.mode == Mode::causes) return {36, 40, 40, 46};
  if (!state.inspected) return {};
  std::vector<std::size_t> out;
  for (const char* name : kSegmentNames) out.push_back(std::string_view(name).size());
  return out;
}

// Of the caption's height: the square before the text with the space behind it, and the space to the next entry.
constexpr double kSwatch = 1.2, kGap = 1.2;

}  // namespace

std::uint32_t segment_color(SegmentKind kind) { return kSegmentColors[static_cast<std::size_t>(kind)]; }

int legend_rows(const WindowState& state, int width, double scale) {
  const double height = kCaptionText * scale;
  std::vector<double> widths;
  for (const std::size_t length : longest(state))
    widths.push_back(kSwatch * height + text_width_bound(length, height));
  return widths.empty() ? 0 : flow_rows(widths, kGap * height, width);
}

void draw_legend(const Canvas& canvas, const WindowContents& contents, const Rect& box) {
  std::vector<Entry> entries;
  if (contents.state.mode == Mode::causes) {
    if (contents.finished.finished) entries = cause_entries(contents.state, contents.finished.comparison);
  } else if (contents.inspection) {
    entries = ray_entries(*contents.inspection);
  }
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImFont& font = *canvas.fonts().caption;
  const double height = static_cast<double>(font.FontSize), line = kLegendLine * canvas.scale();
  glm::dvec2 at(box.x0, box.y0);
  for (const Entry& entry : entries) {
    const ImVec2 size = font.CalcTextSizeA(font.FontSize, 1e6f, 0, entry.text.c_str());
    const double width = kSwatch * height + static_cast<double>(size.x);
    if (at.x > box.x0 && at.x + width > box.x1) at = {box.x0, at.y + line};
    list.AddRectFilled(point(at + glm::dvec2(0, 0.15 * height)), point(at + glm::dvec2(0.8, 0.95) * height),
                       entry.color);
    list.AddText(&font, font.FontSize, point(at + glm::dvec2(kSwatch * height, 0)), kText,
                 entry.text.c_str());
    at.x += width + kGap * height;
  }
}

}  // namespace sidelight
