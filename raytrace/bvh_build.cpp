// SPDX-License-Identifier: MIT
#include <algorithm>

#include "raytrace/bvh.h"

namespace sidelight::raytrace {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kMaxLeaf = 8;
constexpr double kNodeCost = 1, kItemCost = 2;   // of a box pair and of one exact triangle test, measured: about 1 : 2

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return f <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}
float round_up(double x) { return -round_down(-x); }

struct Split {
  int axis = -1;
  int bin = 0;   // items of bins < bin go left
  double cost = std::numeric_limits<double>::infinity();
};

class Builder {
 public:
  Builder(std::span<const Box> boxes, std::span<const std::uint32_t> items, Bvh& bvh)
      : boxes_(boxes), items_(items), bvh_(bvh), order_(boxes.size()) {
    for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  }

  void build() {
    bvh_.nodes.reserve(2 * boxes_.size());
    bvh_.nodes.emplace_back();
    divide(0, 0, static_cast<std::uint32_t>(order_.size()), 0);
    for (const std::uint32_t i : order_) bvh_.items.push_back(items_[i]);
  }

 private:
  glm::dvec3 center(std::uint32_t i) const { return 0.5 * boxes_[i].low + 0.5 * boxes_[i].high; }

  void divide(std::uint32_t node, std::uint32_t first, std::uint32_t count, int depth) {
    Box bounds, centers;
    for (std::uint32_t k = first; k < first + count; ++k) {
      bounds.grow(boxes_[order_[k]]);
      centers.grow(center(order_[k]));
    }
    for (int axis = 0; axis < 3; ++axis) {
      bvh_.nodes[node].low[static_cast<std::size_t>(axis)] = round_down(bounds.low[axis]);
      bvh_.nodes[node].high[static_cast<std::size_t>(axis)] = round_up(bounds.high[axis]);
    }

    const Split split = best_split(first, count, bounds, centers);
    const bool worth_it = split.axis >= 0 && split.cost < kItemCost * count;
    if (count <= kMaxLeaf && !worth_it) {
      bvh_.nodes[node].first = first;
      bvh_.nodes[node].count = count;
      return;
    }
    const std::uint32_t middle = partition(first, count, centers, split, depth);
    const auto left = static_cast<std::uint32_t>(bvh_.nodes.size());
    bvh_.nodes.emplace_back();
    bvh_.nodes.emplace_back();
    bvh_.nodes[node].first = left;
    bvh_.nodes[node].count = 0;
    divide(left, first, middle - first, depth + 1);
    divide(left + 1, middle, first + count - middle, depth + 1);
  }

  int bin_of(std::uint32_t i, int axis, const Box& centers) const {
    const double width = centers.high[axis] - centers.low[axis];
    const double at = (center(i)[axis] - centers.low[axis]) / width;
    return std::clamp(static_cast<int>(at * kBins), 0, kBins - 1);
  }

  Split best_split(std::uint32_t first, std::uint32_t count, const Box& bounds, const Box& centers) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centers.high[axis] > centers.low[axis])) continue;
      std::array<Box, kBins> boxes;
      std::array<std::uint32_t, kBins> counts{};
      for (std::uint32_t k = first; k < first + count; ++k) {
        const auto bin = static_cast<std::size_t>(bin_of(order_[k], axis, centers));
        boxes[bin].grow(boxes_[order_[k]]);
        ++counts[bin];
      }
      // Cost of cutting before each bin: areas from the right first, then sweep from the left.
      std::array<double, kBins> right_cost{};
      Box box;
      std::uint32_t items = 0;
      for (std::size_t bin = kBins - 1; bin > 0; --bin) {
        box.grow(boxes[bin]);
        items += counts[bin];
        right_cost[bin] = box.half_area() * items;
      }
      box = {};
      items = 0;
      for (std::size_t bin = 1; bin < kBins; ++bin) {
        box.grow(boxes[bin - 1]);
        items += counts[bin - 1];
        if (items == 0 || items == count) continue;
        const double cost =
            kNodeCost + kItemCost * (box.half_area() * items + right_cost[bin]) / bounds.half_area();
        if (cost < best.cost) best = {axis, static_cast<int>(bin), cost};
      }
    }
    return best;
  }

  // Reorders [first, first + count) and returns where its right part begins; both parts are non-empty.
  std::uint32_t partition(std::uint32_t first, std::uint32_t count, const Box& centers, const Split& split,
                          int depth) {
    const auto begin = order_.begin() + first, end = begin + count;
    // Deep in a pathological scene, or where all centres coincide: halves, so that depth stays bounded.
    constexpr int kDepthOfHalving = Bvh::kMaxDepth - 34;
    if (split.axis < 0 || depth >= kDepthOfHalving) {
      const int axis = split.axis < 0 ? 0 : split.axis;
      std::nth_element(begin, begin + count / 2, end, [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(center(a)[axis], a) < std::pair(center(b)[axis], b);
      });
      return first + count / 2;
    }
    const auto middle = std::partition(
        begin, end, [&](std::uint32_t i) { return bin_of(i, split.axis, centers) < split.bin; });
    return static_cast<std::uint32_t>(middle - order_.begin());
  }

  std::span<const Box> boxes_;
  std::span<const std::uint32_t> items_;
  Bvh& bvh_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

Bvh build_bvh(std::span<const Box> boxes, std::span<const std::uint32_t> items) {
  Bvh bvh;
  if (boxes.empty()) return bvh;
  for (const Box& box : boxes)
    for (int axis = 0; axis < 3; ++axis)
      bvh.reach = std::max({bvh.reach, std::abs(box.low[axis]), std::abs(box.high[axis])});
  Builder(boxes, items, bvh).build();
  return bvh;
}

}  // namespace sidelight::raytrace
