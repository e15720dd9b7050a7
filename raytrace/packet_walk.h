// SPDX-License-Identifier: MIT
// A packet down a hierarchy. See packet_kernel.h.
#pragma once

#include "common/prefetch.h"
#include "raytrace/packet_spheres.h"
#include "raytrace/packet_triangles.h"

namespace sidelight::raytrace {

// n . x - offset of one corner of each of eight boxes: the one that lies farthest along n, or nearest.
struct PacketPlane {
  std::array<std::size_t, 3> face;  // rows of BvhNode::face
  std::array<float, 3> n;
  float offset = 0;  // n . (o - center), by the slack on the safe side
};

// What boxes are asked: their least and greatest q = (s u, s v, s) (packet_setup.h), and which groups of rays lie there.
struct PacketBounds {
  std::array<PacketPlane, 3> least, greatest;
  // A little wider than the rays, for the rounding of u and v and of what they are compared to: of all, and of each group.
  float extent_u, extent_v;
  alignas(64) RayPacket::PerGroup<float> low_u, high_u, low_v, high_v;
};

// Bound: the float sum of three products, 2^-22 |n| reach, and the pad for all rounding and nearness: 2^-20 with room.
inline PacketPlane packet_plane(const RayPacket& p, const Bvh& bvh, const Vec3<double>& normal,
                                bool farthest) {
  PacketPlane out;
  const std::array<double, 3> n{normal.x, normal.y, normal.z};
  double offset = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    out.n[i] = static_cast<float>(n[i]);
    out.face[i] = (n[i] >= 0) == farthest ? i + 3 : i;
    offset += n[i] * (p.origin[axis] - bvh.center[axis]);
  }
  const double slack = 0x1p-19 * l1_norm(normal) * p.reach;
  out.offset = static_cast<float>(farthest ? offset - slack : offset + slack);
  return out;
}

[[gnu::always_inline]] inline PacketBounds packet_bounds(const RayPacket& p, const PacketAxes& axes,
                                                         const Bvh& bvh) {
  PacketBounds out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.least[k] = packet_plane(p, bvh, axes.row[k], false);
    out.greatest[k] = packet_plane(p, bvh, axes.row[k], true);
  }
  const auto wider = [&](float extent) {
    return 0x1p-20f * extent + static_cast<float>((1 + 0x1p-20) * p.place_error);
  };
  const float more_u = wider(p.extent_u), more_v = wider(p.extent_v);
  out.extent_u = p.extent_u + more_u;
  out.extent_v = p.extent_v + more_v;
  for (std::size_t g = 0; g < p.least_w.size(); ++g) {
    out.low_u[g] = p.group_u[0][g] - more_u;
    out.high_u[g] = p.group_u[1][g] + more_u;
    out.low_v[g] = p.group_v[0][g] - more_v;
    out.high_v[g] = p.group_v[1][g] + more_v;
  }
  return out;
}

// Of eight boxes: those that the packet may meet, as bits, the depth from which on each lies, and what it is within.
struct BoxesSeen {
  using Row = std::array<float, BvhNode::kWidth>;
  alignas(64) Row depth, low_u, high_u, low_v, high_v;
  std::uint32_t met = 0;
};

template <class B>
[[gnu::always_inline]] inline BoxesSeen see_boxes(const BvhNode& node, const PacketBounds& bounds) {
  BoxesSeen seen;
  for (std::size_t lane = 0; lane < BvhNode::kWidth; lane += kLanes<B>) {
    const auto at = [&](const PacketPlane& plane) {
      const auto part = [&](std::size_t i) {
        return B(plane.n[i]) * load<B>(&node.face[plane.face[i]][lane]);
      };
      return ((part(0) + part(1)) + part(2)) - B(plane.offset);
    };
    const B first = at(bounds.least[2]), last = at(bounds.greatest[2]);
    Mask<B> met = last >= B(0);
    store(lane_max<B>(first, B(0)), &seen.depth[lane]);
    // Of a box that holds places beside the origin nothing is known.
    const Mask<B> clear = first >= B(1 / kFarPlace);
    const B per_first = B(1) / select<B>(clear, first, B(1)), per_last = B(1) / select<B>(clear, last, B(1));
    const auto within = [&](std::size_t k, float extent, BoxesSeen::Row& low_row, BoxesSeen::Row& high_row) {
      const B least = at(bounds.least[k]), greatest = at(bounds.greatest[k]);
      const B low = select<B>(clear, lane_min<B>(least * per_first, least * per_last), B(-kFarPlace)),
              high = select<B>(clear, lane_max<B>(greatest * per_first, greatest * per_last), B(kFarPlace));
      met = met && low <= B(extent) && high >= B(-extent);
      store(low, &low_row[lane]);
      store(high, &high_row[lane]);
    };
    within(0, bounds.extent_u, seen.low_u, seen.high_u);
    within(1, bounds.extent_v, seen.low_v, seen.high_v);
    seen.met |= mask_bits<B>(met) << lane;
  }
  return seen;
}

// Those of the groups that box i may hold rays of.
template <class F>
Groups groups_within(const PacketBounds& bounds, const BoxesSeen& seen, std::size_t i, Groups groups) {
  return some_of<F>(groups, [&](std::size_t g) {
    return mask_bits<F>(
        F(seen.low_u[i]) <= load<F>(&bounds.high_u[g]) && F(seen.high_u[i]) >= load<F>(&bounds.low_u[g]) &&
        F(seen.low_v[i]) <= load<F>(&bounds.high_v[g]) && F(seen.high_v[i]) >= load<F>(&bounds.low_v[g]));
  });
}

// Those that have rays which are not done and do not surely keep something nearer than this.
template <class F>
Groups groups_beyond(const RayPacket& p, float depth, Groups groups) {
  return some_of<F>(groups, [&](std::size_t g) {
    return mask_bits<F>(F(depth) * load<F>(&p.least_w[g]) <= F(1 + 0x1p-12f));
  });
}

// All lines of a node, or of a leaf: they will be asked for soon, and where the tree is large, they are far away.
template <class Tree>
void fetch_ahead(const Tree& leaves, std::uint32_t first, std::uint32_t count) {
  constexpr std::size_t kLine = 64;
  const auto* from = count == 0 ? reinterpret_cast<const char*>(&leaves.bvh.nodes[first])
                                : reinterpret_cast<const char*>(leaves.leaf(first));
  const std::size_t size = count == 0 ? sizeof(BvhNode) : Tree::kRowCount * sizeof(double) * count;
  for (std::size_t at = 0; at < size; at += kLine) prefetch(from + at);
  if (count != 0) prefetch(&leaves.bvh.items[first]);
}

// A leaf in steps of RayPacket::budget.
template <class Tree>
constexpr std::int32_t kLeafWork = std::is_same_v<Tree, SphereLeaves> ? 4 : 1;
// How many leaves are tested together.
template <class Tree>
constexpr std::size_t kTogether = std::is_same_v<Tree, SphereLeaves> ? 1 : kLeavesTogether;

// Takes a leaf off the budgets of these groups. Returns those that can afford it; the others are done.
template <class F>
Groups spend(RayPacket& p, Groups groups, std::int32_t work) {
  using I = Ints<F>;
  const I lanes = lane_numbers<I>();
  const Groups over = some_of<F>(groups, [&](std::size_t g) {
    const I bit = (I(static_cast<std::int32_t>(groups >> g)) >> lanes) & I(1);
    const I budget = load<I>(&p.budget[g]) - bit * I(work);
    store(budget, &p.budget[g]);
    return mask_bits<I>(budget < I(0));
  });
  for (Groups bits = over; bits != 0; bits &= bits - 1)
    p.least_w[static_cast<std::size_t>(std::countr_zero(bits))] = kInfinity;
  return groups & ~over;
}

struct PacketStack {
  std::array<PacketEntry, Bvh::kMaxDepth*(BvhNode::kWidth - 1) + 1> entry;
  std::size_t size = 0;
};

// Adds what these groups may meet of a node's children, the nearest last.
template <class F, class B, class Tree>
void push_children(const Tree& leaves, const BvhNode& node, const PacketBounds& bounds, Groups groups,
                   PacketStack& stack) {
  const BoxesSeen seen = see_boxes<B>(node, bounds);
  const std::size_t base = stack.size;
  for (std::uint32_t bits = seen.met; bits != 0; bits &= bits - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(bits));
    const Groups within = groups_within<F>(bounds, seen, i, groups);
    if (within == 0) continue;
    const PacketEntry child{seen.depth[i], node.first[i], node.count[i], within};
    if (child.count == 0) fetch_ahead(leaves, child.first, 0);
    std::size_t at = stack.size++;
    for (; at > base && stack.entry[at - 1].depth <= child.depth; --at) stack.entry[at] = stack.entry[at - 1];
    stack.entry[at] = child;
  }
}

// Near things first. A leaf waits until some more have been found, while its numbers are on their way.
template <class F, class B, class D, class Tree>
void walk_packet(const Prepared& prepared, const PacketAxes& axes, const Tree& leaves, RayPacket& p,
                 VisibilityCounts& counts) {
  constexpr std::size_t kAhead = 8;
  if (leaves.bvh.nodes.empty()) return;
  const PacketBounds bounds = packet_bounds(p, axes, leaves.bvh);
  PacketStack stack;
  stack.entry[stack.size++] = {0, 0, 0, all_groups(p)};
  std::array<PacketEntry, kAhead> waiting;
  std::array<PacketEntry, kTogether<Tree>> ready;
  std::size_t arrived = 0, done = 0, ready_size = 0;
  const auto test_ready = [&] {
    test_leaves<F, B, D>(prepared, axes, leaves, std::span(ready.data(), ready_size), p, counts);
    ready_size = 0;
  };
  while (stack.size > 0 || done < arrived) {
    const bool is_leaf = stack.size == 0 || arrived - done == kAhead;
    const PacketEntry top = is_leaf ? waiting[done++ % kAhead] : stack.entry[--stack.size];
    Groups groups = groups_beyond<F>(p, top.depth, top.groups);
    if (groups == 0) continue;
    if (is_leaf) {
      if (p.any_hit) groups = spend<F>(p, groups, kLeafWork<Tree>);
      if (groups != 0) ready[ready_size++] = {top.depth, top.first, top.count, groups};
      if (ready_size == kTogether<Tree>) test_ready();
    } else if (top.count > 0) {
      fetch_ahead(leaves, top.first, top.count);
      waiting[arrived++ % kAhead] = top;
    } else {
      ++counts.nodes;
      push_children<F, B>(leaves, leaves.bvh.nodes[top.first], bounds, groups, stack);
    }
  }
  if (ready_size > 0) test_ready();
}

}  // namespace sidelight::raytrace
