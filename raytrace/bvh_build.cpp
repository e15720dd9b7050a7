// SPDX-License-Identifier: MIT
#include <algorithm>

#include "common/math/norms.h"
#include "common/parallel.h"
#include "raytrace/bvh.h"
#include "raytrace/bvh_items.h"

namespace sidelight::raytrace {
namespace {

struct Split {
  int axis = -1;
  int bin = 0;  // items of bins < bin go left
  float cost = kInfinity;
};

class Builder {
 public:
  // Reorders the items; `spare` has room for as many. Lengths times `unit` have squares.
  Builder(BoxedItem* boxed, BoxedItem* spare, float unit) : items_(boxed), spare_(spare), unit_(unit) {}

  // Nodes of the subtree over `range`, its root first, into `nodes`; subtrees of at most `task_size` items that begin
  // below it are left out and listed in `tasks`, where one is given.
  struct Task {
    Range range;
    std::uint32_t node, slot;  // whose child it is
  };
  std::uint32_t build(const Range& range, KeptArray<BvhNode>& nodes, std::vector<Task>* tasks,
                      std::uint32_t task_size) {
    const auto node = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    const Children children = divide(range);
    for (std::uint32_t slot = 0; slot < BvhNode::kWidth; ++slot) {
      const bool used = slot < children.size;
      const Range child = used ? children.range[slot] : Range{};
      const bool leaf = child.count <= Bvh::kMaxLeaf;
      set_child(nodes[node], slot, child, leaf);
      if (!used || leaf) continue;
      if (tasks && child.count <= task_size)
        tasks->push_back({child, node, slot});
      else {
        const std::uint32_t first = build(child, nodes, tasks, task_size);
        nodes[node].first[slot] = first;
      }
    }
    return node;
  }

 private:
  struct Children {
    std::array<Range, BvhNode::kWidth> range;
    std::uint32_t size = 0;
  };

  struct Bins {
    std::array<std::array<FloatBox, kMostBins>, 3> of;
    Bins() {}  // those in use are set up by best_split()
  };

  static void set_child(BvhNode& node, std::uint32_t slot, const Range& child, bool leaf) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.face[axis][slot] = child.boxes.low[axis];
      node.face[axis + 3][slot] = child.boxes.high[axis];
    }
    node.first[slot] = leaf ? child.first : 0;
    node.count[slot] = leaf ? child.count : 0;
  }

  // Splits the largest part that is too large for a leaf, until all slots are taken.
  Children divide(const Range& range) {
    Children children;
    children.range[children.size++] = range;
    while (children.size < BvhNode::kWidth) {
      int largest = -1;
      float most = -1;
      for (std::uint32_t i = 0; i < children.size; ++i) {
        if (children.range[i].count <= Bvh::kMaxLeaf) continue;
        const float area = children.range[i].boxes.half_area(unit_);
        if (area > most) {
          most = area;
          largest = static_cast<int>(i);
        }
      }
      if (largest < 0) break;
      const std::array<Range, 2> parts = halves(children.range[static_cast<std::size_t>(largest)]);
      children.range[static_cast<std::size_t>(largest)] = parts[0];
      children.range[children.size++] = parts[1];
    }
    for (std::uint32_t i = 0; i < children.size; ++i) children.range[i].depth = range.depth + 1;
    return children;
  }

  // Large ranges are judged by a sample of about this many items: their bins hold enough of them.
  static constexpr std::uint32_t kSample = 2048;

  // A leaf is asked in whole vectors, and costs the same however few items it has: full ones are worth more.
  static float leaves_of(std::uint32_t items) {
    return static_cast<float>((items + Bvh::kMaxLeaf - 1) / Bvh::kMaxLeaf);
  }

  Split best_split(const Range& range, const Binning& binning) const {
    std::array<std::array<std::uint32_t, kMostBins>, 3> counts{};
    Bins boxes;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t bin = 0; bin < binning.bins; ++bin) boxes.of[axis][bin] = FloatBox{};
    const std::uint32_t step = std::max(1u, range.count / kSample);
    std::uint32_t sampled = 0;
    for (std::uint32_t k = range.first; k < range.first + range.count; k += step) {
      ++sampled;
      const FloatBox box = items_[k].box();
      const auto bin = binning.of(box);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto b = static_cast<std::size_t>(bin[axis]);
        boxes.of[axis][b].grow(box);
        ++counts[axis][b];
      }
    }
    // Cost of cutting before each bin: areas from the right first, then sweep from the left.
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (binning.per_width[axis] == 0) continue;
      std::array<float, kMostBins> right_cost{};
      FloatBox box;
      std::uint32_t items = 0;
      for (std::size_t bin = binning.bins - 1; bin > 0; --bin) {
        box.grow(boxes.of[axis][bin]);
        items += counts[axis][bin];
        right_cost[bin] = box.half_area(unit_) * leaves_of(items * step);
      }
      box = {};
      items = 0;
      for (std::size_t bin = 1; bin < binning.bins; ++bin) {
        box.grow(boxes.of[axis][bin - 1]);
        items += counts[axis][bin - 1];
        if (items == 0 || items == sampled) continue;
        const float cost = box.half_area(unit_) * leaves_of(items * step) + right_cost[bin];
        if (cost < best.cost) best = {static_cast<int>(axis), static_cast<int>(bin), cost};
      }
    }
    return best;
  }

  // Reorders the range into two that are not empty.
  std::array<Range, 2> halves(const Range& range) {
    // Deep in a pathological scene, or where all centres coincide: by count, so that depth stays bounded.
    constexpr int kDepthOfHalving = Bvh::kMaxDepth - 34;
    const Binning binning(range);
    const Split split = range.depth < kDepthOfHalving ? best_split(range, binning) : Split{};
    const std::uint32_t count = split.axis < 0 ? halve(range) : partition(range, binning, split);
    return {part(range.first, count, range.depth),
            part(range.first + count, range.count - count, range.depth)};
  }

  // Without a branch that nobody could predict: every item is written to both sides, and stays on its own. The
  // number of those on the left.
  std::uint32_t partition(const Range& range, const Binning& binning, const Split& split) {
    const auto axis = static_cast<std::size_t>(split.axis);
    const float from = binning.from[axis], per_width = binning.per_width[axis];
    BoxedItem *left = items_ + range.first, *right = spare_ + range.first;
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k) {
      const BoxedItem item = items_[k];
      const bool goes_left = Binning::of(items_[k].center(axis), from, per_width) < split.bin;
      *left = item;
      *right = item;
      left += goes_left;
      right += !goes_left;
    }
    std::copy(spare_ + range.first, right, left);
    return static_cast<std::uint32_t>(left - items_) - range.first;
  }

  std::uint32_t halve(const Range& range) {
    BoxedItem* begin = items_ + range.first;
    const Quad width = range.boxes.high - range.boxes.low;
    const auto axis = static_cast<std::size_t>(greatest_axis<float>(width[0], width[1], width[2]));
    std::nth_element(begin, begin + range.count / 2, begin + range.count,
                     [&](const BoxedItem& a, const BoxedItem& b) {
                       const float center_a = a.center(axis), center_b = b.center(axis);
                       return center_a < center_b || (center_a == center_b && a.item() < b.item());
                     });
    return range.count / 2;
  }

  Range part(std::uint32_t first, std::uint32_t count, int depth) const {
    Range range{first, count, {}, {}, depth};
    for (std::uint32_t k = first; k < first + count; ++k) {
      const FloatBox box = items_[k].box();
      range.boxes.grow(box);
      range.centers.grow(center_of(box));
    }
    return range;
  }

  BoxedItem *items_, *spare_;
  float unit_;
};

// body(block, first, boxes) for all items, block by block in parallel; boxes[0] is that of items[first].
template <class Body>
void for_boxes(std::span<const std::uint32_t> items, const BoxesOf& boxes_of, int threads, const Body& body) {
  parallel_blocks(items.size(), threads, [&](std::size_t block, std::size_t first, std::size_t last) {
    KeptArray<Box> boxes(last - first);
    boxes_of(items.subspan(first, last - first), boxes.data());
    body(block, first, boxes);
  });
}

// Where the boxes are. A tree far from the world's origin is kept relative to its middle.
void place(Bvh& bvh, std::span<const std::uint32_t> items, const BoxesOf& boxes_of, int threads) {
  std::vector<Box> of_block(blocks_of(items.size()));
  for_boxes(items, boxes_of, threads, [&](std::size_t block, std::size_t, const KeptArray<Box>& boxes) {
    Box all;
    for (const Box& box : boxes) all.grow(box);
    of_block[block] = all;
  });
  Box world;
  for (const Box& box : of_block) world.grow(box);
  for (int axis = 0; axis < 3; ++axis) {
    bvh.reach = std::max({bvh.reach, std::abs(world.low[axis]), std::abs(world.high[axis])});
    if (world.low[axis] > 0 || world.high[axis] < 0)
      bvh.center[axis] = 0.5 * world.low[axis] + 0.5 * world.high[axis];
  }
}

// All items as one range, their boxes relative to `center`.
Range box_items(std::span<const std::uint32_t> items, const BoxesOf& boxes_of, const glm::dvec3& center,
                int threads, BoxedItem* boxed) {
  std::vector<Range> of_block(blocks_of(items.size()));
  for_boxes(items, boxes_of, threads, [&](std::size_t block, std::size_t first, const KeptArray<Box>& boxes) {
    Range part;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const FloatBox box{round_down(difference(boxes[i].low, center)),
                         round_up(difference(boxes[i].high, center))};
      boxed[first + i] = {items[first + i], box};
      part.boxes.grow(box);
      part.centers.grow(center_of(box));
    }
    of_block[block] = part;
  });
  Range all;
  all.count = static_cast<std::uint32_t>(items.size());
  for (const Range& range : of_block) {
    all.boxes.grow(range.boxes);
    all.centers.grow(range.centers);
  }
  return all;
}

// The upper levels here, then the subtrees below them in parallel; which they are depends on the items alone.
void build_nodes(Builder& builder, const Range& all, int threads, KeptArray<BvhNode>& nodes) {
  constexpr std::uint32_t kTaskSize = 8192;
  std::vector<Builder::Task> tasks;
  builder.build(all, nodes, &tasks, kTaskSize);
  std::vector<KeptArray<BvhNode>> subtrees(tasks.size());
  parallel_for(static_cast<int>(tasks.size()), threads, [&](int i, int) {
    const auto task = static_cast<std::size_t>(i);
    builder.build(tasks[task].range, subtrees[task], nullptr, 0);
  });
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const auto base = static_cast<std::uint32_t>(nodes.size());
    nodes[tasks[i].node].first[tasks[i].slot] = base;
    for (BvhNode& node : subtrees[i])
      for (std::size_t slot = 0; slot < BvhNode::kWidth; ++slot)
        if (node.count[slot] == 0) node.first[slot] += base;
    nodes.insert(nodes.end(), subtrees[i].begin(), subtrees[i].end());
  }
}

}  // namespace

Bvh build_bvh(std::span<const std::uint32_t> items, const BoxesOf& boxes_of, int threads) {
  Bvh bvh;
  if (items.empty()) return bvh;
  place(bvh, items, boxes_of, threads);
  KeptArray<BoxedItem> boxed(2 * items.size());
  const Range all = box_items(items, boxes_of, bvh.center, threads, boxed.data());
  const Quad extent = all.boxes.high - all.boxes.low;
  const float longest = std::max({extent[0], extent[1], extent[2]});
  Builder builder(boxed.data(), boxed.data() + items.size(), longest > 0 ? 1 / longest : 1);
  build_nodes(builder, all, threads, bvh.nodes);
  bvh.items.resize(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) bvh.items[i] = boxed[i].item();
  return bvh;
}

}  // namespace sidelight::raytrace
