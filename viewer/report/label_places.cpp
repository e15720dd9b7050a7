// SPDX-License-Identifier: MIT
#include "viewer/report/label_places.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/utf8.h"

namespace sidelight {
namespace {

constexpr std::array kDistances{10.0, 18.0, 28.0, 40.0, 54.0, 70.0, 90.0};  // of a label from its mark
constexpr std::size_t kFirstFar = 4;  // nearer ones are preferred while they also avoid what they may overlap
constexpr std::size_t kFirstWithLeader = 2;  // nearer ones need no line to their mark

// Right first, as one reads; then above and below, where lines of equal error leave room.
constexpr std::array<std::array<double, 2>, 12> kDirections{{{1, 0},
                                                             {-1, 0},
                                                             {0.7, -0.7},
                                                             {0.7, 0.7},
                                                             {-0.7, -0.7},
                                                             {-0.7, 0.7},
                                                             {0, -1},
                                                             {0, 1},
                                                             {0.4, -0.9},
                                                             {0.4, 0.9},
                                                             {-0.4, -0.9},
                                                             {-0.4, 0.9}}};

bool within(const Rectangle& inner, const Rectangle& outer) {
  return inner.x0 >= outer.x0 && inner.x1 <= outer.x1 && inner.y0 >= outer.y0 && inner.y1 <= outer.y1;
}

// The box that touches `anchor` with the side or corner that looks back to the mark.
Rectangle box_at(const glm::dvec2& anchor, const glm::dvec2& direction, const glm::dvec2& size) {
  const bool beside = std::abs(direction.y) < 0.5;
  const double x = direction.x > 0.1    ? anchor.x
                   : direction.x < -0.1 ? anchor.x - size.x
                                        : anchor.x - size.x / 2;
  const double y = beside ? anchor.y - size.y / 2 : direction.y > 0 ? anchor.y : anchor.y - size.y;
  return {x, y, x + size.x, y + size.y};
}

// Whether the line from a to b meets the box, looked at in steps finer than any box is small.
bool line_meets(const glm::dvec2& a, const glm::dvec2& b, const Rectangle& box) {
  constexpr int kSteps = 32;
  for (int i = 1; i < kSteps; ++i) {
    const glm::dvec2 p = a + (b - a) * (static_cast<double>(i) / kSteps);
    if (p.x > box.x0 && p.x < box.x1 && p.y > box.y0 && p.y < box.y1) return true;
  }
  return false;
}

bool overlaps_any(const Rectangle& box, const std::vector<Rectangle>& all) {
  return std::any_of(all.begin(), all.end(), [&](const Rectangle& each) { return overlap(each, box); });
}

// `taken` holds labels from first_label on, which no line to a mark may cross.
bool is_free(const LabelRequest& request, const LabelPlace& place, const std::vector<Rectangle>& taken,
             std::size_t first_label) {
  if (overlaps_any(place.box, taken)) return false;
  return !place.leader ||
         std::none_of(taken.begin() + static_cast<std::ptrdiff_t>(first_label), taken.end(),
                      [&](const Rectangle& label) { return line_meets(request.mark, *place.leader, label); });
}

}  // namespace

std::string shortened(const std::string& text) {
  std::size_t count = 0, i = 0;
  for (; i < text.size() && count < kLongestLine; ++count)
    i += std::max<std::size_t>(1, utf8_length(text, i));
  return i < text.size() ? text.substr(0, i) + "…" : text;
}

std::vector<std::string> in_two_lines(const std::string& text) {
  if (utf8_count(text) <= kLongestLine) return {text};
  std::size_t blank = std::string::npos;
  for (std::size_t at = 0; (at = text.find(' ', at)) != std::string::npos; ++at)
    if (utf8_count(text.substr(0, at)) <= kLongestLine) blank = at;
  if (blank == std::string::npos) return {shortened(text)};
  return {text.substr(0, blank), shortened(text.substr(blank + 1))};
}

double text_width(const std::string& line, double letter) {
  return letter * static_cast<double>(utf8_count(line));
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

std::vector<std::optional<LabelPlace>> place_labels(const std::vector<LabelRequest>& requests,
                                                    std::vector<Rectangle> taken,
                                                    const std::vector<Rectangle>& avoided,
                                                    const Rectangle& frame) {
  const std::size_t first_label = taken.size();
  const auto find = [&](const LabelRequest& request, std::size_t form, std::size_t rings,
                        const std::vector<Rectangle>& also_taken) -> std::optional<LabelPlace> {
    for (std::size_t ring = 0; ring < rings; ++ring)
      for (const auto& [x, y] : kDirections) {
        if (ring >= kFirstWithLeader && y == 0) continue;  // the line would hide in lines of equal error
        const glm::dvec2 direction(x, y), anchor = request.mark + kDistances[ring] * direction;
        LabelPlace place{box_at(anchor, direction, request.sizes[form]), form, {}};
        if (ring >= kFirstWithLeader) place.leader = anchor;
        if (within(place.box, frame) && !overlaps_any(place.box, also_taken) &&
            is_free(request, place, taken, first_label))
          return place;
      }
    return {};
  };
  std::vector<std::optional<LabelPlace>> out;
  for (const LabelRequest& request : requests) {
    std::optional<LabelPlace> place;
    for (std::size_t form = 0; form < request.sizes.size() && !place; ++form) {
      place = find(request, form, kFirstFar, avoided);
      if (!place) place = find(request, form, kDistances.size(), {});
    }
    if (place) taken.push_back(place->box);
    out.push_back(place);
  }
  return out;
}

}  // namespace sidelight
