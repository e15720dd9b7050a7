// SPDX-License-Identifier: MIT
// A packet against the triangles of a leaf: set up together, then each against the groups that may meet it. See
// packet_kernel.h.
#pragma once

#include "raytrace/packet_setup.h"

namespace sidelight::raytrace {

// Of an interval, the end at which x times it is greatest: 0 the lower, 1 the upper one. (The sign bit: no branch.)
inline std::size_t greatest_end(float x) { return 1 - (std::bit_cast<std::uint32_t>(x) >> 31); }

// A triangle of a set-up, and rays from this one on: i << 8 | ray.
using Pairs = std::array<std::int32_t, 8 * RayPacket::kCapacity + RayPacket::kGroups>;

// Adds triangle i of the set-up with the groups in which some ray may meet it before what it keeps.
template <class F>
std::size_t add_groups_met(const RayPacket& p, const LeafSetup& s, std::size_t i, Pairs& pairs,
                           std::size_t size) {
  using I = Ints<F>;
  const I rays = generate<I>([](int lane) { return RayPacket::kGroup * lane; });
  for (std::size_t g = 0; g < static_cast<std::size_t>(p.groups); g += kLanes<F>) {
    const auto least = [&](const auto& of) { return load<F>(&of[0][g]); };
    const auto most = [&](const auto& of) { return load<F>(&of[1][g]); };
    const auto greatest = [&](float x, float y, float c) {
      return mul_add(F(x), load<F>(&p.group_u[greatest_end(x)][g]),
                     mul_add(F(y), load<F>(&p.group_v[greatest_end(y)][g]), F(c)));
    };
    const F w = greatest(s.wx[i], s.wy[i], s.wc[i]) + F(s.w_error[i]);
    Mask<F> met = F(s.low_u[i]) <= most(p.group_u) && F(s.high_u[i]) >= least(p.group_u) &&
                  F(s.low_v[i]) <= most(p.group_v) && F(s.high_v[i]) >= least(p.group_v) &&
                  w * F(kSurely) >= lane_max<F>(load<F>(&p.least_w[g]), F(0));
    // Where the rectangle holds one group or none there is little left for the edges to say.
    if (count<F>(met) > 1) {
      const F e0 = greatest(s.x[0][i], s.y[0][i], s.c[0][i]), e1 = greatest(s.x[1][i], s.y[1][i], s.c[1][i]),
              e2 = greatest(s.x[2][i], s.y[2][i], s.c[2][i]);
      met = met && lane_min<F>(lane_min<F>(e0, e1), e2) >= F(-s.doubt[i]);
    }
    size +=
        store_some<F>(met, rays + I(static_cast<std::int32_t>(i << 8 | g * RayPacket::kGroup)), &pairs[size]);
  }
  return size;
}

// The edge function that is least, at each of these rays.
template <class F>
F least_edge(const RayPacket& p, const LeafSetup& s, std::size_t i, std::size_t first) {
  const F u = load<F>(&p.u[first]), v = load<F>(&p.v[first]);
  const auto at = [&](std::size_t k) {
    return mul_add(F(s.x[k][i]), u, mul_add(F(s.y[k][i]), v, F(s.c[k][i])));
  };
  return lane_min<F>(lane_min<F>(at(0), at(1)), at(2));
}

// What is set up, primitives[i] for each i that is alive, against all rays: which groups may meet which; which rays of
// them; and what these keep. Step by step, so that hardly a branch hangs on a result that has just been asked for.
template <class F>
void test_set_up(const Prepared& prepared, RayPacket& p, const LeafSetup& s, const std::uint32_t* primitives,
                 SignCounts& counts) {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  Pairs near, met;
  std::size_t near_size = 0, met_size = 0;
  for (std::uint32_t alive = s.alive; alive != 0; alive &= alive - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(alive));
    if (!casts_none<F>(prepared, p, primitives[i])) near_size = add_groups_met<F>(p, s, i, near, near_size);
  }
  for (std::size_t k = 0; k < near_size; ++k)
    for (std::int32_t pair = near[k]; pair < near[k] + RayPacket::kGroup; pair += kLanes<F>) {
      const auto i = static_cast<std::size_t>(pair >> 8), first = static_cast<std::size_t>(pair & 255);
      met[met_size] = pair;
      met_size += any<F>(least_edge<F>(p, s, i, first) >= F(-s.doubt[i]));
    }
  std::uint32_t changed = 0;
  for (std::size_t k = 0; k < met_size; ++k) {
    const auto i = static_cast<std::size_t>(met[k] >> 8), first = static_cast<std::size_t>(met[k] & 255);
    const F e = least_edge<F>(p, s, i, first), doubt(s.doubt[i]);
    const F w =
        mul_add(F(s.wx[i]), load<F>(&p.u[first]), mul_add(F(s.wy[i]), load<F>(&p.v[first]), F(s.wc[i])));
    if (keep_nearer<F>(p, first, primitives[i], e > doubt, e >= -doubt, w, F(s.w_error[i]), counts))
      changed |= 1u << first / kGroup;
  }
  counts.tests += kGroup * near_size;
  counts.filtered += 3 * kGroup * near_size;
  if (changed != 0) update_least<F>(p, changed);
}

template <class F, class D>
void test_leaf(const Prepared& prepared, const PacketAxes& axes, const TriangleLeaves& leaves,
               std::uint32_t first, std::uint32_t count, RayPacket& p, SignCounts& counts) {
  LeafSetup setup;
  for (std::size_t lane = 0; lane < count; lane += kLanes<D>)
    set_up_triangles<D>(p, axes, leaves.leaf(first), count, lane, setup);
  setup.alive &= (1u << count) - 1;
  if (setup.alive != 0) test_set_up<F>(prepared, p, setup, &leaves.bvh.items[first], counts);
}

}  // namespace sidelight::raytrace
