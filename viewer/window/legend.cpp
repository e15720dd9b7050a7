// SPDX-License-Identifier: MIT
// What the colours mean, in a row under the pictures: the causes with their numbers, the signed difference with a histogram
// over its scale, the rays of the inspected pixel.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

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
  ImU32 color;  // 0 where the text has none
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

std::vector<Entry> difference_entries(const DifferenceHistogram& histogram,
                                      const std::optional<Comparison>& comparison) {
  const double all =
      static_cast<double>(histogram.darker() + histogram.brighter() + histogram.equal + histogram.undefined);
  std::vector<Entry> out;
  const auto add = [&](double difference, const char* name, std::uint64_t pixels) {
    out.push_back({color_of(signed_difference_color(difference)),
                   fmt::format("{}: {:.1f} % of pixels", name, 100 * static_cast<double>(pixels) / all)});
  };
  add(-0.5, "darker", histogram.darker());
  add(0, "equal", histogram.equal);
  add(0.5, "brighter", histogram.brighter());
  if (histogram.undefined > 0) {
    add(std::nan(""), "not a number", histogram.undefined);
  } else if (comparison) {
    const Metrics& m = comparison->metrics;
    out.push_back({0, fmt::format("root mean square {:.4g}", m.rms)});
    out.push_back({0, fmt::format("greatest {:.4g} at {},{}", m.max.value, m.max.x, m.max.y)});
  }
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
  std::vector<std::size_t> out;
  if (state.mode == Mode::causes) out = {36, 40, 40, 46};
  if (state.mode == Mode::difference) out = {25, 24, 27, 26, 33};
  if (!state.inspected) return out;
  for (const char* name : kSegmentNames) out.push_back(std::string_view(name).size());
  return out;
}

// Of the caption's height: the square before the text with the space behind it, and the space to the next entry.
constexpr double kSwatch = 1.2, kGap = 1.2;

// The histogram at scale 1: its bars, the colours under them, the numbers under those. It stands left of the words.
constexpr double kBars = 44, kColors = 10, kNumbers = 1.3 * kSmallText,
                 kHistogram = kBars + kColors + kNumbers;
constexpr double kWidest = 460, kPartOfWidth = 0.35, kBeside = 24;

double histogram_width(int width, double scale) { return std::min(kWidest * scale, kPartOfWidth * width); }

// The box without it.
Rect words_box(const Rect& box, double scale) {
  const double taken = histogram_width(box.width(), scale) + kBeside * scale;
  return {box.x0 + static_cast<int>(std::lround(taken)), box.y0, box.x1, box.y1};
}

void draw_histogram(const Canvas& canvas, const DifferenceHistogram& histogram, const Rect& box) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const double s = canvas.scale(), width = histogram_width(box.width(), s), foot = box.y0 + kBars * s;
  const double bar = width / static_cast<double>(histogram.pixels.size());
  for (std::size_t bin = 0; bin < histogram.pixels.size(); ++bin) {
    const double x0 = box.x0 + bar * static_cast<double>(bin), x1 = x0 + bar;
    list.AddRectFilled(point(x0, foot - kBars * s * histogram.height(bin)), point(x1, foot), kQuiet);
    list.AddRectFilled(point(x0, foot), point(x1, foot + kColors * s),
                       color_of(signed_difference_color(DifferenceHistogram::middle(bin))));
  }
  list.AddRect(point(box.x0, foot), point(box.x0 + width, foot + kColors * s), kFrame);
  constexpr std::array<const char*, 5> kTicks{"-1", "-1/4", "0", "+1/4", "+1"};
  const ImFont& font = *canvas.fonts().small;
  for (std::size_t k = 0; k < kTicks.size(); ++k) {
    const double length = static_cast<double>(font.CalcTextSizeA(font.FontSize, 1e6f, 0, kTicks[k]).x);
    const double x = box.x0 + (width - length) * static_cast<double>(k) / (kTicks.size() - 1);
    list.AddText(&font, font.FontSize, point(x, foot + (kColors + 1) * s), kQuiet, kTicks[k]);
  }
}

}  // namespace

std::uint32_t segment_color(SegmentKind kind) { return kSegmentColors[static_cast<std::size_t>(kind)]; }

int legend_height(const WindowState& state, int width, double scale, bool brief) {
  const double height = kCaptionText * scale;
  std::vector<double> widths;
  for (const std::size_t length : longest(state))
    widths.push_back(kSwatch * height + text_width_bound(length, height));
  if (widths.empty()) return 0;
  const int beside = words_box({0, 0, width, 0}, scale).width();
  const bool histogram =
      state.mode == Mode::difference && !brief && beside >= *std::max_element(widths.begin(), widths.end());
  const double words = kLegendLine * flow_rows(widths, kGap * height, histogram ? beside : width);
  return static_cast<int>(std::lround(scale * (std::max(words, histogram ? kHistogram : 0) + kLegendFoot)));
}

void draw_legend(const Canvas& canvas, const WindowContents& contents, const Rect& whole) {
  const bool brief = whole.height() <= legend_height(contents.state, whole.width(), canvas.scale(), true);
  const bool with_histogram = contents.shown.histogram && !brief;
  if (with_histogram) draw_histogram(canvas, *contents.shown.histogram, whole);
  const Rect box = with_histogram ? words_box(whole, canvas.scale()) : whole;
  std::vector<Entry> entries;
  if (contents.state.mode == Mode::causes) {
    if (contents.finished.finished) entries = cause_entries(contents.state, contents.finished.comparison);
  } else if (const auto& histogram = contents.shown.histogram) {
    entries = difference_entries(*histogram, contents.finished.comparison);
  }
  if (contents.inspection) std::ranges::move(ray_entries(*contents.inspection), std::back_inserter(entries));
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImFont& font = *canvas.fonts().caption;
  const double height = static_cast<double>(font.FontSize), line = kLegendLine * canvas.scale();
  glm::dvec2 at(box.x0, box.y0);
  for (const Entry& entry : entries) {
    const ImVec2 size = font.CalcTextSizeA(font.FontSize, 1e6f, 0, entry.text.c_str());
    const double width = kSwatch * height + static_cast<double>(size.x);
    if (at.x > box.x0 && at.x + width > box.x1) {
      if (at.y + line + height > box.y1) {  // the rest is left out
        const double end = at.x - kGap * height;
        if (end <= box.x1)
          list.AddText(&font, font.FontSize, point(end + 0.1 * height, at.y), kText, ellipsis(font));
        break;
      }
      at = {box.x0, at.y + line};
    }
    list.AddRectFilled(point(at + glm::dvec2(0, 0.15 * height)), point(at + glm::dvec2(0.8, 0.95) * height),
                       entry.color);
    const int left = static_cast<int>(std::lround(at.x + kSwatch * height)), top = static_cast<int>(at.y);
    draw_line(list, font, {left, top, box.x1, top + static_cast<int>(std::ceil(height))}, kText, entry.text);
    at.x += width + kGap * height;
  }
}

}  // namespace sidelight
