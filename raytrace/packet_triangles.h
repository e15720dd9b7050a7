// SPDX-License-Identifier: MIT
// A packet against the triangles of a leaf: set up together, then one by one against the groups. See packet_kernel.h.
#pragma once

#include "raytrace/packet_keep.h"

namespace sidelight::raytrace {

// Eight primitives of a leaf as the rays see them: edge functions up to a positive factor, of values up to 1 within the
// packet, and 1/t. In float, with bounds.
struct LeafSetup {
  using Row = std::array<float, 8>;
  alignas(64) std::array<Row, 3> x, y, c;  // E_k = x u + y v + c
  alignas(64) Row doubt;                   // an |E_k| not above it may have either sign
  alignas(64) Row wx, wy, wc, w_error;
  alignas(
      64) Row sure;  // not 0: the side is sure, and all bounds hold; else nothing is known of side and depth
};

// Bounds. l_k = |a_k|, l their greatest, m that of the edges e1, e2, all as sums of components; u = 2^-53.
//   h = a_0 . n: n is off by 4 u (w1 e2 + e1 w2) <= 2^-48 l m per component (visibility.h, depth_plane()), h by 2^-47 l² m.
//   N_k = a_i x a_j: d . N_k, and W, U, V . N_k, off by less than 2^-48 |d| l_i l_j; and visibility.h's own value for a
//   shadow ray, which starts at the surface, by the same with l + distance.
//   Float: coefficients, products and sums: 2^-22 of |x| U + |y| V + |c|, which is 1; 2^-21 with room.
// A side is sure where the origin lies clearly off the plane: seen under more than 2^-17 from all of the triangle, so that
// its own light cannot be blocked by it, and so far off that what is near in depth is near in space.
template <class D>
void set_up_triangles(const RayPacket& p, const double* leaf, std::uint32_t count, std::size_t lane,
                      LeafSetup& out) {
  const Vec3<D> origin = wide_of<D>(p.origin), W = wide_of<D>(p.W), U = wide_of<D>(p.U), V = wide_of<D>(p.V);
  const auto corner = [&](std::uint32_t k) {
    const double* row = leaf + lane + 3 * k * count;
    return Vec3<D>{load<D>(row), load<D>(row + count), load<D>(row + 2 * count)};
  };
  const Vec3<D> v0 = corner(0), v1 = corner(1), v2 = corner(2);
  const std::array<Vec3<D>, 3> a{v0 - origin, v1 - origin, v2 - origin};
  const Vec3<D> e1 = v1 - v0, e2 = v2 - v0, n = cross(e1, e2);
  const std::array<D, 3> length{l1(a[0]), l1(a[1]), l1(a[2])};
  const D l = lane_max<D>(lane_max<D>(length[0], length[1]), length[2]), m = lane_max<D>(l1(e1), l1(e2));
  const D h = dot(a[0], n), size_h = lane_abs<D>(h), size_n = l1(n);
  const Mask<D> sure = size_h > D(0x1p-27) * ((l * l) * m) && size_h > D(0x1p-17) * (l * size_n) &&
                       size_h > D(0x1p-20 * p.reach) * size_n;
  const D extent_u(static_cast<double>(p.extent_u)), extent_v(static_cast<double>(p.extent_v));
  const D distance(p.distance), ray_length(p.length), place(p.place_error);

  // 1/t
  const D per_h = D(1) / select<D>(sure, h, D(1));
  const D wx = per_h * dot(U, n), wy = per_h * dot(V, n), wc = per_h * dot(W, n);
  const D most_w = (lane_abs<D>(wx) * extent_u + lane_abs<D>(wy) * extent_v) + lane_abs<D>(wc);
  const D w_error = (D(0x1p-21) * most_w + place * (lane_abs<D>(wx) + lane_abs<D>(wy))) +
                    D(0x1p-46) * ray_length * (l * m) * lane_abs<D>(per_h);
  store(to_float<D>(wx), &out.wx[lane]);
  store(to_float<D>(wy), &out.wy[lane]);
  store(to_float<D>(wc), &out.wc[lane]);
  store(to_float<D>(w_error), &out.w_error[lane]);
  store(to_float<D>(select<D>(sure, D(1), D(0))), &out.sure[lane]);

  const D turn = select<D>(h < D(0), D(-1), D(1));
  D doubt(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Vec3<D> edge = cross(a[i], a[j]);
    const D x = dot(U, edge), y = dot(V, edge), c = dot(W, edge);
    const D unit = (lane_abs<D>(x) * extent_u + lane_abs<D>(y) * extent_v) + lane_abs<D>(c);
    const D rounding = D(0x1p-46) * ray_length * ((length[i] + distance) * (length[j] + distance)) +
                       place * (lane_abs<D>(x) + lane_abs<D>(y)) +
                       D(p.near_error) * l1(edge) * (ray_length + D(p.reach) * most_w);
    const D per_unit = D(1) / select<D>(unit > D(0), unit, D(1));
    const D scale = turn * per_unit;
    store(to_float<D>(scale * x), &out.x[k][lane]);
    store(to_float<D>(scale * y), &out.y[k][lane]);
    store(to_float<D>(scale * c), &out.c[k][lane]);
    doubt = lane_max<D>(doubt, rounding * per_unit);
  }
  // Where the side is not sure E may have either sign as well.
  store(to_float<D>(select<D>(sure, doubt + D(0x1p-21), D(2))), &out.doubt[lane]);
}

// ---- One triangle against the groups ----

// Groups in which some ray may meet triangle i of the set-up before what it keeps, as bits.
template <class F>
std::uint32_t groups_met(const RayPacket& p, const LeafSetup& s, std::size_t i) {
  std::uint32_t bits = 0;
  const bool sure = s.sure[i] != 0;
  for (std::size_t g = 0; g < static_cast<std::size_t>(p.groups); g += kLanes<F>) {
    const F u = load<F>(&p.group_u[g]), v = load<F>(&p.group_v[g]);
    const F half_u = load<F>(&p.half_u[g]), half_v = load<F>(&p.half_v[g]);
    const auto greatest = [&](float x, float y, float c) {
      return ((F(x) * u + F(y) * v) + F(c)) + (lane_abs<F>(F(x)) * half_u + lane_abs<F>(F(y)) * half_v);
    };
    const F e0 = greatest(s.x[0][i], s.y[0][i], s.c[0][i]), e1 = greatest(s.x[1][i], s.y[1][i], s.c[1][i]),
            e2 = greatest(s.x[2][i], s.y[2][i], s.c[2][i]);
    Mask<F> met = lane_min<F>(lane_min<F>(e0, e1), e2) >= F(-s.doubt[i]);
    if (sure) {
      const F w = greatest(s.wx[i], s.wy[i], s.wc[i]) + F(s.w_error[i]);
      met = met && w >= F(0) && w * F(kSurely) >= load<F>(&p.least_w[g]);
    }
    bits |= mask_bits<F>(met) << g;
  }
  return bits & ((1u << p.groups) - 1);
}

// Returns the groups in which something may have changed.
template <class F>
std::uint32_t test_triangle(RayPacket& p, const LeafSetup& s, std::size_t i, std::uint32_t primitive,
                            SignCounts& counts) {
  const std::uint32_t groups = groups_met<F>(p, s, i);
  const bool sure = s.sure[i] != 0;
  std::uint32_t changed = 0;
  for (std::uint32_t bits = groups; bits != 0; bits &= bits - 1) {
    const std::size_t group = static_cast<std::size_t>(std::countr_zero(bits)) * RayPacket::kGroup;
    bool any_changed = false;
    for (std::size_t first = group; first < group + RayPacket::kGroup; first += kLanes<F>) {
      const F u = load<F>(&p.u[first]), v = load<F>(&p.v[first]);
      const auto at = [&](float x, float y, float c) { return (F(x) * u + F(y) * v) + F(c); };
      const F e =
          lane_min<F>(lane_min<F>(at(s.x[0][i], s.y[0][i], s.c[0][i]), at(s.x[1][i], s.y[1][i], s.c[1][i])),
                      at(s.x[2][i], s.y[2][i], s.c[2][i]));
      const Mask<F> may = e >= F(-s.doubt[i]);
      if (!any<F>(may)) continue;
      any_changed |= keep_nearer<F>(p, first, primitive, e > F(s.doubt[i]), may,
                                    at(s.wx[i], s.wy[i], s.wc[i]), F(s.w_error[i]), sure, counts);
    }
    if (any_changed) changed |= bits & (~bits + 1);
  }
  const auto tested = RayPacket::kGroup * static_cast<std::uint64_t>(std::popcount(groups));
  counts.tests += tested;
  counts.filtered += 3 * tested;
  return changed;
}

template <class F, class D>
void test_leaf(const Prepared& prepared, const TriangleLeaves& leaves, std::uint32_t first,
               std::uint32_t count, RayPacket& p, SignCounts& counts) {
  LeafSetup setup;
  for (std::size_t lane = 0; lane < count; lane += kLanes<D>)
    set_up_triangles<D>(p, leaves.leaf(first), count, lane, setup);
  std::uint32_t changed = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t primitive = leaves.bvh.items[first + i];
    if (casts_none<F>(prepared, p, primitive)) continue;
    changed |= test_triangle<F>(p, setup, i, primitive, counts);
  }
  if (changed != 0) update_least<F>(p, changed);
}

}  // namespace sidelight::raytrace
