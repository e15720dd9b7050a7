// SPDX-License-Identifier: MIT
// A packet against the spheres of a leaf, one by one. See packet_kernel.h.
#pragma once

#include "raytrace/packet_setup.h"

namespace sidelight::raytrace {

// A sphere with f = o - c and q = f² - r²: with b = -f . d and the discriminant D = b² - d² q, 1/t = (b +- sqrt D) / q, +
// from outside, - from within.
//
// Rounding, with g = |f| + r as sums of components: D is off by less than 2^-46 d² g², and by a ray that passes aside by n,
// d² (2 r n + n²): the near error, 2 near_error reach, and what the error of (u, v) makes at the sphere, below 4 g of it. Depths are told only well inside the outline and
// for an origin well off the surface.
struct SphereSetup {
  double b_u, b_v, b_w, q;  // b = b_u u + b_v v + b_w
  double b_error;
  double doubt, clear;  // of D / d²: below -doubt it is surely missed, above `clear` surely met
  double per_q = 1, root_sign = 1;
  bool sure = false;  // whether 1/t is known where it is surely met
};

template <class D>
SphereSetup set_up_sphere(const RayPacket& p, const double* row, std::uint32_t count) {
  SphereSetup s;
  const double radius = row[3 * count];
  const Vec3<double> f{p.origin.x - row[0], p.origin.y - row[count], p.origin.z - row[2 * count]};
  const auto along = [&](const glm::dvec3& d) { return -((f.x * d.x + f.y * d.y) + f.z * d.z); };
  s.b_u = along(p.U);
  s.b_v = along(p.V);
  s.b_w = along(p.W);
  s.q = dot(f, f) - radius * radius;
  const double g = l1(f) + radius + p.distance, size_q = lane_abs(s.q);
  const double near = 2 * p.near_error * p.reach, aside = near + 4 * g * p.place_error;
  s.doubt = 0x1p-46 * (g * g) + aside * (2 * radius + aside);
  s.b_error = 0x1p-46 * g + 2 * g * p.place_error;
  s.clear = lane_max(0x1p-28 * (g * g), 0x1p-20 * (radius * radius));
  s.sure = size_q > 0x1p-18 * (g * g) && size_q > 0x1p24 * (near * g);
  s.per_q = 1 / (s.sure ? s.q : 1.0);
  s.root_sign = s.q < 0 ? -1 : 1;
  return s;
}

// Groups in which some ray may meet the sphere before what it keeps. Seen from outside: from the greatest b of a group.
template <class F>
std::uint32_t groups_met(const RayPacket& p, const SphereSetup& s) {
  const std::uint32_t all = (1u << p.groups) - 1;
  const double q = s.q - s.doubt;
  if (!s.sure || !(q > 0)) return all;
  const auto size = [](double x) { return lane_abs(static_cast<float>(x)); };
  const float error = 0x1p-20f * ((size(s.b_u) * p.extent_u + size(s.b_v) * p.extent_v) + size(s.b_w)) +
                      static_cast<float>(2 * s.b_error);
  const float less_q = static_cast<float>(q) * (1 - 0x1p-20f);
  std::uint32_t bits = 0;
  for (std::size_t g = 0; g < static_cast<std::size_t>(p.groups); g += kLanes<F>) {
    const auto greatest = [&](double x, const std::array<RayPacket::PerGroup<float>, 2>& of) {
      return F(static_cast<float>(x)) * load<F>(&of[x >= 0 ? 1 : 0][g]);
    };
    const F b =
        (greatest(s.b_u, p.group_u) + greatest(s.b_v, p.group_v)) + F(static_cast<float>(s.b_w) + error);
    const F square = b * b * F(1 + 0x1p-20f), discriminant = square - load<F>(&p.least_square[g]) * F(less_q);
    const F w = (b + square_root(lane_max<F>(discriminant, F(0)))) * F((1 + 0x1p-12f) / less_q);
    bits |= mask_bits<F>(b >= F(0) && discriminant >= F(0) && w >= load<F>(&p.least_w[g])) << g;
  }
  return bits & all;
}

template <class F, class D>
bool test_spheres(RayPacket& p, const SphereSetup& s, std::size_t ray, std::uint32_t primitive,
                  SignCounts& counts) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  alignas(64) std::array<float, kLanes<F>> ws, w_errors, states;  // state: 1 surely met, -1 surely missed
  for (std::size_t lane = 0; lane < kLanes<F>; lane += kLanes<D>) {
    const D u = to_double<D>(load<FloatsOf<D>>(&p.u[ray + lane])),
            v = to_double<D>(load<FloatsOf<D>>(&p.v[ray + lane]));
    const D b = (u * D(s.b_u) + v * D(s.b_v)) + D(s.b_w), square = load<D>(&p.square[ray + lane]);
    const D discriminant = b * b - square * D(s.q);
    const D root = square_root(lane_max<D>(discriminant, D(0)));
    const Mask<D> met = discriminant > square * D(s.clear);
    const D w_error =
        (square * D(s.doubt) / select<D>(met, root, D(1)) + D(s.b_error)) * D(lane_abs(s.per_q));
    store(to_float<D>(w_error), &w_errors[lane]);
    const D missed = select<D>(discriminant < -(square * D(s.doubt)), D(-1), D(0));
    store(to_float<D>((b + D(s.root_sign) * root) * D(s.per_q)), &ws[lane]);
    store(to_float<D>(select<D>(met, D(1), missed)), &states[lane]);
  }
  const F state = load<F>(states.data());
  const Mask<F> may = state >= F(0), met = state > F(0);
  if (!any<F>(may)) return false;
  // An unclear one has no depth, so it is asked wherever it is.
  const Mask<F> clear = s.sure ? met : Mask<F>(false);
  return keep_nearer<F>(p, ray, primitive, clear, may, select<F>(clear, load<F>(ws.data()), F(0)),
                        select<F>(clear, load<F>(w_errors.data()), F(kInfinity)), counts);
}

template <class F, class D>
void test_leaf(const Prepared& prepared, const PacketAxes&, const SphereLeaves& leaves, std::uint32_t first,
               std::uint32_t count, RayPacket& p, SignCounts& counts) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t primitive = leaves.bvh.items[first + i];
    if (casts_none<F>(prepared, p, primitive)) continue;
    const SphereSetup setup = set_up_sphere<D>(p, leaves.leaf(first) + i, count);
    const std::uint32_t groups = groups_met<F>(p, setup);
    std::uint32_t changed = 0;
    for (std::uint32_t bits = groups; bits != 0; bits &= bits - 1) {
      const std::size_t group = static_cast<std::size_t>(std::countr_zero(bits)) * RayPacket::kGroup;
      bool any_changed = false;
      for (std::size_t ray = group; ray < group + RayPacket::kGroup; ray += kLanes<F>)
        any_changed |= test_spheres<F, D>(p, setup, ray, primitive, counts);
      if (any_changed) changed |= bits & (~bits + 1);
    }
    counts.tests += RayPacket::kGroup * static_cast<std::uint64_t>(std::popcount(groups));
    if (changed != 0) update_least<F>(p, changed);
  }
}

}  // namespace sidelight::raytrace
