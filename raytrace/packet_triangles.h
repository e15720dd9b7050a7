// SPDX-License-Identifier: MIT
// A packet against the triangles of a leaf: set up together, then each against the groups that may meet it. See
// packet_kernel.h.
#pragma once

#include <span>

#include "raytrace/packet_setup.h"

namespace sidelight::raytrace {

// Adds the triangles that some ray of group g may meet before what it keeps: their rectangle holds some of the group's, and
// there each edge function is >= 0 somewhere, and the depth near enough. Returns how many.
template <class F>
std::size_t add_triangles_met(const RayPacket& p, const TriangleSetup& s, std::size_t g,
                              std::int32_t* pairs) {
  const F low_u(p.group_u[0][g]), high_u(p.group_u[1][g]), low_v(p.group_v[0][g]), high_v(p.group_v[1][g]);
  std::size_t size = 0;
  for (std::size_t i = 0; i < s.doubt.size(); i += kLanes<F>) {
    const auto greatest = [&](const PerItem& x_row, const PerItem& y_row, const PerItem& c_row) {
      const F x = load<F>(&x_row[i]), y = load<F>(&y_row[i]);
      return (lane_max<F>(x * low_u, x * high_u) + lane_max<F>(y * low_v, y * high_v)) + load<F>(&c_row[i]);
    };
    const F e0 = greatest(s.x[0], s.y[0], s.c[0]), e1 = greatest(s.x[1], s.y[1], s.c[1]),
            e2 = greatest(s.x[2], s.y[2], s.c[2]);
    const F w = greatest(s.wx, s.wy, s.wc) + load<F>(&s.w_error[i]);
    const Mask<F> within = load<F>(&s.low_u[i]) <= high_u && load<F>(&s.high_u[i]) >= low_u &&
                           load<F>(&s.low_v[i]) <= high_v && load<F>(&s.high_v[i]) >= low_v;
    const Mask<F> met = within && lane_min<F>(lane_min<F>(e0, e1), e2) >= -load<F>(&s.doubt[i]) &&
                        w * F(kSurely) >= F(lane_max(p.least_w[g], 0.0f));
    size += add_pairs<F>(met, i, g, pairs + size);
  }
  return size;
}

// The edge function that is least, at each of these rays.
template <class F>
F least_edge(const RayPacket& p, const TriangleSetup& s, std::size_t i, std::size_t first) {
  const F u = load<F>(&p.u[first]), v = load<F>(&p.v[first]);
  const auto at = [&](std::size_t k) {
    return mul_add(F(s.x[k][i]), u, mul_add(F(s.y[k][i]), v, F(s.c[k][i])));
  };
  return lane_min<F>(lane_min<F>(at(0), at(1)), at(2));
}

// Of the leaves that are set up.
using LeafPrimitives = std::array<const std::uint32_t*, kLeavesTogether>;

// What is set up, where it is within anything, against the rays of these groups: which triangles may be
// met in which; which rays of them; and what these keep. Step by step, so that hardly a branch hangs on a result that has
// just been asked for.
template <class F>
void test_triangles(RayPacket& p, const TriangleSetup& s, Groups groups, const LeafPrimitives& primitives,
                    VisibilityCounts& counts) {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  Pairs near, met;
  std::size_t near_size = 0, met_size = 0;
  for (; groups != 0; groups &= groups - 1)
    near_size +=
        add_triangles_met<F>(p, s, static_cast<std::size_t>(std::countr_zero(groups)), &near[near_size]);
  for (std::size_t k = 0; k < near_size; ++k)
    for (std::int32_t pair = near[k]; pair < near[k] + RayPacket::kGroup; pair += kLanes<F>) {
      const auto [i, first] = item_and_ray(pair);
      met[met_size] = pair;
      met_size += any<F>(least_edge<F>(p, s, i, first) >= F(-s.doubt[i]));
    }
  Groups changed = 0;
  for (std::size_t k = 0; k < met_size; ++k) {
    const auto [i, first] = item_and_ray(met[k]);
    const F e = least_edge<F>(p, s, i, first), doubt(s.doubt[i]);
    const F w =
        mul_add(F(s.wx[i]), load<F>(&p.u[first]), mul_add(F(s.wy[i]), load<F>(&p.v[first]), F(s.wc[i])));
    if (keep_nearer<F>(p, first, primitives[i / Bvh::kMaxLeaf][i % Bvh::kMaxLeaf], e > doubt, e >= -doubt, w,
                       F(s.w_error[i]), counts))
      changed |= Groups{1} << first / kGroup;
  }
  counts.tests += kGroup * near_size;
  counts.filtered += 3 * kGroup * near_size;
  if (changed != 0) update_least<F>(p, changed);
}

// Up to kLeavesTogether leaves: as many triangles as F has lanes where they are most, and loops that end, with a branch
// that is guessed wrong, half as often.
template <class F, class B, class D>
void test_leaves(const Prepared& prepared, const PacketAxes& axes, const TriangleLeaves& leaves,
                 std::span<const PacketEntry> entries, RayPacket& p, VisibilityCounts& counts) {
  TriangleSetup setup;
  LeafPrimitives primitives{};
  Groups groups = 0;
  for (std::size_t k = 0; k < kLeavesTogether; ++k) {
    const std::size_t at = k * Bvh::kMaxLeaf;
    if (k >= entries.size()) {
      std::fill_n(&setup.low_u[at], Bvh::kMaxLeaf, kInfinity);
      continue;
    }
    const PacketEntry& entry = entries[k];
    primitives[k] = &leaves.bvh.items[entry.first];
    if (set_up_leaf<D>(p, axes, leaves.leaf(entry.first), entry.count, at, setup)) groups |= entry.groups;
    hide_what_casts_none(prepared, p, primitives[k], entry.count, &setup.low_u[at], kInfinity);
  }
  test_triangles<F>(p, setup, groups, primitives, counts);
}

}  // namespace sidelight::raytrace
