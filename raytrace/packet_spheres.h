// SPDX-License-Identifier: MIT
// A packet against the spheres of a leaf: set up together, then each against the groups that may meet it. See
// packet_kernel.h.
#pragma once

#include <span>

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
  using PerItem = std::array<float, Bvh::kMaxLeaf>;
  alignas(32) std::array<PerItem, 3> gx, gy, gc;  // g = gx u + gy v + gc
  alignas(32) PerItem doubt;                      // of D
  alignas(32) PerItem bx, by, bc, root;           // 1/t = bx u + by v + bc + root sqrt D
  alignas(32) PerItem b_error, root_error;  // of 1/t: b_error + root_error / sqrt D; -inf: not to be met
  alignas(32) PerItem clear;                // D above which 1/t is known; infinite where it is not known
};

// Spheres from `lane` on, of the `count` of a leaf.
template <class D>
void set_up_spheres(const RayPacket& p, const double* leaf, std::uint32_t count, std::size_t lane,
                    SphereSetup& s) {
  const auto row = [&](std::size_t k) { return load<D>(leaf + lane + k * count); };
  const auto put = [&](const D& x, SphereSetup::PerItem& to) { store(to_float<D>(x), &to[lane]); };
  const Mask<D> asked = lane_numbers<D>() < D(static_cast<double>(count) - static_cast<double>(lane));
  const D radius = select<D>(asked, row(3), D(1)), per_r = D(1) / radius, unit = per_r * D(1 / p.length);
  const Vec3<D> f = wide<D>(p.origin) - load_corner<D>(leaf + lane, count);
  const Vec3<D> U = wide<D>(p.U), V = wide<D>(p.V), W = wide<D>(p.W);
  const Vec3<D> x = unit * cross(U, f), y = unit * cross(V, f), c = unit * cross(W, f);
  const D extent_u(static_cast<double>(p.extent_u)), extent_v(static_cast<double>(p.extent_v));
  const D size = l1_norm(f), l = (size + radius) + D(p.distance), near(2 * p.near_error * p.reach);
  const D off = D(0x1p-22) * ((l1_norm(x) * extent_u + l1_norm(y) * extent_v) + l1_norm(c)) +
                (D(0x1p-49) * size + near) * per_r + D(p.place_error) * (l1_norm(x) + l1_norm(y));
  const D in_radii = l * per_r;
  const D doubt =
      ((D(2) + off) * off + D(0x1p-21) * ((D(1) + off) * (D(1) + off))) + D(0x1p-46) * (in_radii * in_radii);
  store_rows(to_floats(x), s.gx, lane);
  store_rows(to_floats(y), s.gy, lane);
  store_rows(to_floats(c), s.gc, lane);
  put(doubt, s.doubt);

  const D q = dot(f, f) - radius * radius, size_q = lane_abs<D>(q);
  const Mask<D> sure = size_q > D(0x1p-18) * (l * l) && size_q > (D(0x1p24) * near) * l;
  const D per_q = select<D>(sure, D(1) / select<D>(sure, q, D(1)), D(0)), size_per_q = lane_abs<D>(per_q);
  const auto along = [&](const Vec3<D>& d) { return -per_q * dot(f, d); };
  const D bx = along(U), by = along(V), bc = along(W), root = (radius * D(p.length)) * size_per_q;
  const D size_x = lane_abs<D>(bx), size_y = lane_abs<D>(by);
  const D b_error = D(0x1p-21) * (((size_x * extent_u + size_y * extent_v) + lane_abs<D>(bc)) + root) +
                    D(p.place_error) * (size_x + size_y) + (D(0x1p-46) * (l * D(p.length))) * size_per_q;
  put(bx, s.bx);
  put(by, s.by);
  put(bc, s.bc);
  put(root, s.root);
  put(select<D>(asked, select<D>(sure, b_error, D(kInfinity)), D(-kInfinity)), s.b_error);
  put(root * doubt, s.root_error);
  put(select<D>(sure, D(2) * doubt, D(kInfinity)), s.clear);
}

// Adds the spheres that some ray of group g may meet before what it keeps. Returns how many.
template <class B>
std::size_t add_spheres_met(const RayPacket& p, const SphereSetup& s, std::size_t g, std::int32_t* pairs) {
  const auto middle = [&](const auto& of) { return B(0.5f * (of[1][g] + of[0][g])); };
  const auto half = [&](const auto& of) { return B((0.5f + 0x1p-20f) * (of[1][g] - of[0][g])); };
  const B u = middle(p.group_u), v = middle(p.group_v), half_u = half(p.group_u), half_v = half(p.group_v);
  std::size_t size = 0;
  for (std::size_t i = 0; i < Bvh::kMaxLeaf; i += kLanes<B>) {
    const auto at = [&](const SphereSetup::PerItem& row) { return load<B>(&row[i]); };
    const auto at_middle = [&](const B& x, const B& y, const B& c) {
      return mul_add(x, u, mul_add(y, v, c));
    };
    const auto change = [&](const B& x, const B& y) {
      return mul_add(lane_abs<B>(x), half_u, B(lane_abs<B>(y) * half_v));
    };
    B least(0);  // of |g|²
    for (std::size_t k = 0; k < 3; ++k) {
      const B x = at(s.gx[k]), y = at(s.gy[k]);
      const B from = lane_max<B>(lane_abs<B>(at_middle(x, y, at(s.gc[k]))) - change(x, y), B(0));
      least = mul_add(from, from, least);
    }
    const B bx = at(s.bx), by = at(s.by);
    const B w = (at_middle(bx, by, at(s.bc)) + change(bx, by)) + (at(s.root) + at(s.b_error));
    const Mask<B> met =
        !(least > mul_add(B(2), at(s.doubt), B(1))) && w * B(kSurely) >= B(lane_max(p.least_w[g], 0.0f));
    size += add_pairs<B>(met, i, g, pairs + size);
  }
  return size;
}

template <class F>
bool test_sphere(RayPacket& p, const SphereSetup& s, std::size_t i, std::size_t ray, std::uint32_t primitive,
                 VisibilityCounts& counts) {
  const F u = load<F>(&p.u[ray]), v = load<F>(&p.v[ray]);
  const auto at = [&](float x, float y, float c) { return mul_add(F(x), u, mul_add(F(y), v, F(c))); };
  F square(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const F g = at(s.gx[k][i], s.gy[k][i], s.gc[k][i]);
    square = mul_add(g, g, square);
  }
  const F discriminant = load<F>(&p.square[ray]) - square;
  const Mask<F> may = !(discriminant < F(-s.doubt[i]));
  if (!any<F>(may)) return false;
  // An unclear one has no depth, so it is asked wherever it is.
  const Mask<F> met = discriminant > F(s.clear[i]);
  const F root = square_root(select<F>(met, discriminant, F(1)));
  const F w = mul_add(F(s.root[i]), root, at(s.bx[i], s.by[i], s.bc[i]));
  const F error = F(s.b_error[i]) + F(s.root_error[i]) / root;
  return keep_nearer<F>(p, ray, primitive, met, may, select<F>(met, w, F(0)),
                        select<F>(met, error, F(kInfinity)), counts);
}

template <class F, class B, class D>
void test_leaves(const Prepared& prepared, const PacketAxes&, const SphereLeaves& leaves,
                 std::span<const PacketEntry> one, RayPacket& p, VisibilityCounts& counts) {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  auto [depth, first, count, groups] = one.front();
  const std::uint32_t* primitives = &leaves.bvh.items[first];
  SphereSetup setup;
  setup.b_error.fill(-kInfinity);
  for (std::size_t lane = 0; lane < count; lane += kLanes<D>)
    set_up_spheres<D>(p, leaves.leaf(first), count, lane, setup);
  hide_what_casts_none(prepared, p, primitives, count, setup.b_error.data(), -kInfinity);
  Pairs near;
  std::size_t size = 0;
  for (; groups != 0; groups &= groups - 1)
    size += add_spheres_met<B>(p, setup, static_cast<std::size_t>(std::countr_zero(groups)), &near[size]);
  Groups changed = 0;
  for (std::size_t k = 0; k < size; ++k) {
    const auto [i, group] = item_and_ray(near[k]);
    bool any_changed = false;
    for (std::size_t ray = group; ray < group + kGroup; ray += kLanes<F>)
      any_changed |= test_sphere<F>(p, setup, i, ray, primitives[i], counts);
    if (any_changed) changed |= Groups{1} << group / kGroup;
  }
  counts.tests += kGroup * size;
  if (changed != 0) update_least<F>(p, changed);
}

}  // namespace sidelight::raytrace
