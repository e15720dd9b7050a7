// SPDX-License-Identifier: MIT
// A packet against the spheres of a leaf, one by one. See packet_kernel.h.
#pragma once

#include "raytrace/packet_setup.h"

namespace sidelight::raytrace {

// A sphere of radius r with f = o - c, in units of r and of L >= |d|: g = (d x f) / (r L) is affine in (u, v), and |g| r
// is how far the ray passes from the center, times |d| / L. So it is met where D = |d / L|² - |g|² >= 0, and with
// q = f² - r² 1/t = (-f . d +- r L sqrt D) / q, + from outside, - from within. Small where it matters, so that it holds in
// float.
//
// Bounds: g is off by `off`: 2^-22 of its terms, for float; 2^-49 |f| / r, for its coefficients; what the error of (u, v)
// makes; and, for what is only near, 2 near_error reach / r. Then D by 2 off + off² where |g| <= 1, by 2^-21 for float, and
// by 2^-46 ((|f| + r + distance) / r)² in visibility.h; and its root by that over itself. Depths are told for an origin
// well off the surface.
struct SphereSetup {
  std::array<float, 3> gx, gy, gc;  // g = gx u + gy v + gc
  float doubt;                      // of D
  float bx, by, bc, root;           // 1/t = bx u + by v + bc + root sqrt D
  float b_error, root_error;        // of 1/t: b_error + root_error / sqrt D
  bool sure = false;                // whether 1/t is known where it is surely met
};

inline SphereSetup set_up_sphere(const RayPacket& p, const double* row, std::uint32_t count) {
  SphereSetup s;
  const auto vec = [](const glm::dvec3& v) { return Vec3<double>{v.x, v.y, v.z}; };
  const double radius = row[3 * count], per_r = 1 / radius, unit = per_r / p.length;
  const Vec3<double> f{p.origin.x - row[0], p.origin.y - row[count], p.origin.z - row[2 * count]};
  const Vec3<double> x = unit * cross(vec(p.U), f), y = unit * cross(vec(p.V), f),
                     c = unit * cross(vec(p.W), f);
  const double extent_u = static_cast<double>(p.extent_u), extent_v = static_cast<double>(p.extent_v);
  const double size = l1(f), l = size + radius + p.distance, near = 2 * p.near_error * p.reach;
  const double off = 0x1p-22 * ((l1(x) * extent_u + l1(y) * extent_v) + l1(c)) + 0x1p-49 * size * per_r +
                     p.place_error * (l1(x) + l1(y)) + near * per_r;
  const double doubt =
      (2 + off) * off + 0x1p-21 * ((1 + off) * (1 + off)) + 0x1p-46 * ((l * per_r) * (l * per_r));
  const auto row_of = [](const Vec3<double>& v) {
    return std::array{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  s.gx = row_of(x);
  s.gy = row_of(y);
  s.gc = row_of(c);
  s.doubt = static_cast<float>(doubt);

  const double q = dot(f, f) - radius * radius, size_q = lane_abs(q);
  s.sure = size_q > 0x1p-18 * (l * l) && size_q > 0x1p24 * (near * l);
  const double per_q = s.sure ? 1 / q : 0;
  const auto along = [&](const glm::dvec3& d) { return -per_q * dot(f, vec(d)); };
  const double bx = along(p.U), by = along(p.V), bc = along(p.W), root = radius * p.length * lane_abs(per_q);
  s.bx = static_cast<float>(bx);
  s.by = static_cast<float>(by);
  s.bc = static_cast<float>(bc);
  s.root = static_cast<float>(root);
  s.b_error = static_cast<float>(
      0x1p-21 * ((lane_abs(bx) * extent_u + lane_abs(by) * extent_v) + lane_abs(bc) + root) +
      p.place_error * (lane_abs(bx) + lane_abs(by)) + 0x1p-46 * (l * p.length) * lane_abs(per_q));
  s.root_error = static_cast<float>(root * doubt);
  return s;
}

// Groups in which some ray may meet the sphere before what it keeps, as bits.
template <class F>
std::uint32_t groups_met(const RayPacket& p, const SphereSetup& s) {
  std::uint32_t bits = 0;
  for (std::size_t at = 0; at < static_cast<std::size_t>(p.groups); at += kLanes<F>) {
    const auto middle = [&](const auto& of) { return F(0.5f) * (load<F>(&of[1][at]) + load<F>(&of[0][at])); };
    const auto half = [&](const auto& of) {
      return F(0.5f + 0x1p-20f) * (load<F>(&of[1][at]) - load<F>(&of[0][at]));
    };
    const F u = middle(p.group_u), v = middle(p.group_v), half_u = half(p.group_u), half_v = half(p.group_v);
    const auto at_middle = [&](float x, float y, float c) {
      return mul_add(F(x), u, mul_add(F(y), v, F(c)));
    };
    const auto change = [&](float x, float y) {
      return mul_add(lane_abs<F>(F(x)), half_u, F(lane_abs<F>(F(y)) * half_v));
    };
    F least(0);  // of |g|²
    for (std::size_t k = 0; k < 3; ++k) {
      const F g =
          lane_max<F>(lane_abs<F>(at_middle(s.gx[k], s.gy[k], s.gc[k])) - change(s.gx[k], s.gy[k]), F(0));
      least = mul_add(g, g, least);
    }
    const F w = (at_middle(s.bx, s.by, s.bc) + change(s.bx, s.by)) + F(s.root + s.b_error);
    Mask<F> met = !(least > F(1 + 2 * s.doubt));
    if (s.sure) met = met && w * F(kSurely) >= lane_max<F>(load<F>(&p.least_w[at]), F(0));
    bits |= mask_bits<F>(met) << at;
  }
  return bits & ((1u << p.groups) - 1);
}

template <class F>
bool test_spheres(RayPacket& p, const SphereSetup& s, std::size_t ray, std::uint32_t primitive,
                  SignCounts& counts) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const F u = load<F>(&p.u[ray]), v = load<F>(&p.v[ray]);
  const auto at = [&](float x, float y, float c) { return mul_add(F(x), u, mul_add(F(y), v, F(c))); };
  F square(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const F g = at(s.gx[k], s.gy[k], s.gc[k]);
    square = mul_add(g, g, square);
  }
  const F discriminant = load<F>(&p.square[ray]) - square;
  const Mask<F> may = !(discriminant < F(-s.doubt));
  if (!any<F>(may)) return false;
  // An unclear one has no depth, so it is asked wherever it is.
  const Mask<F> met = s.sure ? discriminant > F(2 * s.doubt) : Mask<F>(false);
  const F root = square_root(select<F>(met, discriminant, F(1)));
  const F w = mul_add(F(s.root), root, at(s.bx, s.by, s.bc));
  return keep_nearer<F>(p, ray, primitive, met, may, select<F>(met, w, F(0)),
                        select<F>(met, F(s.b_error) + F(s.root_error) / root, F(kInfinity)), counts);
}

template <class F, class D>
void test_leaf(const Prepared& prepared, const PacketAxes&, const SphereLeaves& leaves, std::uint32_t first,
               std::uint32_t count, RayPacket& p, SignCounts& counts) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t primitive = leaves.bvh.items[first + i];
    if (casts_none<F>(prepared, p, primitive)) continue;
    const SphereSetup setup = set_up_sphere(p, leaves.leaf(first) + i, count);
    const std::uint32_t groups = groups_met<F>(p, setup);
    std::uint32_t changed = 0;
    for (std::uint32_t bits = groups; bits != 0; bits &= bits - 1) {
      const std::size_t group = static_cast<std::size_t>(std::countr_zero(bits)) * RayPacket::kGroup;
      bool any_changed = false;
      for (std::size_t ray = group; ray < group + RayPacket::kGroup; ray += kLanes<F>)
        any_changed |= test_spheres<F>(p, setup, ray, primitive, counts);
      if (any_changed) changed |= bits & (~bits + 1);
    }
    counts.tests += RayPacket::kGroup * static_cast<std::uint64_t>(std::popcount(groups));
    if (changed != 0) update_least<F>(p, changed);
  }
}

}  // namespace sidelight::raytrace
