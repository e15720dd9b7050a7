// SPDX-License-Identifier: MIT
// Triangles as the rays of a packet see them, those of two leaves side by side: edge functions and 1/t over (u, v), and
// the rectangle of (u, v) that holds the triangle, in float with bounds. See packet_kernel.h.
//
// A place x relative to the origin is written in the packet's own axes, x = s (W + u U + v V), as q = (s u, s v, s): what
// is left is cross products in q. After M. Olano and T. Greer, 1997 (common/model/ray_sheet.h).
//
// Bounds. With N = [U V W]: q = x / N, rows m_k of 1/N are cross products over det N, |q_k| <= r_k |x|, all lengths as
// sums of components, u = 2^-53. Computed q is off by 2^-50 r_k |x| (3u for the rows, 3u for the product, u for x). With
// l >= |a_k|, m the greatest of the edges e1, e2, and kappa = |U||V||W| / det N (1 for axes at right angles, seen along
// one):
//   E_k = (u, v, 1) . (q_i x q_j) = d . (a_i x a_j) / det N is off by 2^-47 kappa |d| l_i l_j / det N; visibility.h's own
//   value for a shadow ray, which starts at the surface, by 2^-48 |d| of the same with l + distance.
//   n = e1 x e2 likewise, with m². h = q_0 . n by 2^-45.6 kappa² l m² / det N; visibility.h's by 2^-47 l² m / det N.
//   Float: coefficients, products and sums: 2^-22 of |x| U + |y| V + |c|, which is 1; 2^-21 with room.
// A side is sure where both are below 2^-20 of h, and the origin lies clearly off the plane: seen under more than 2^-17
// from all of the triangle, so that its own light cannot be blocked by it, and so far off that what is near in depth is
// near in space.
#pragma once

#include <algorithm>

#include "raytrace/packet_keep.h"

namespace sidelight::raytrace {

// The packet's own axes, and what the bounds need of them.
struct PacketAxes {
  std::array<Vec3<double>, 3> row;  // of 1/N
  Vec3<double> size;                // |row|
  std::array<double, 2> per_place;  // r_0, r_1: a place off by x makes u or v off by this times |x| / s
  double per_det;                   // 1 / |det N|
  double kappa;
  // A triangle lies ahead (behind) of the origin where s > (< -) ahead_0 + ahead_l l: then s is good to 2^-24 of it.
  double ahead_0, ahead_l;
};

[[gnu::always_inline]] inline PacketAxes packet_axes(const RayPacket& p) {
  const Vec3<double> U = wide<double>(p.U), V = wide<double>(p.V), W = wide<double>(p.W), UV = cross(U, V);
  const double det = dot(W, UV), per_det = 1 / det, size_det = lane_abs(per_det);
  PacketAxes axes;
  axes.row = {per_det * cross(V, W), per_det * cross(W, U), per_det * UV};
  axes.size = {l1_norm(axes.row[0]), l1_norm(axes.row[1]), l1_norm(axes.row[2])};
  axes.per_place = {size_det * (l1_norm(V) * l1_norm(W)), size_det * (l1_norm(W) * l1_norm(U))};
  axes.per_det = size_det;
  axes.kappa = axes.per_place[0] * l1_norm(U);
  const double per_s = size_det * (l1_norm(U) * l1_norm(V));
  axes.ahead_0 = 0x1p24 * per_s * (p.near_error * p.reach + 0x1p-50 * p.distance);
  axes.ahead_l = 0x1p-26 * per_s;
  return axes;
}

constexpr float kFarPlace = 1e30f;  // farther than any u and v

// Of the triangles of some leaves, each leaf's from a multiple of kMaxLeaf on.
struct TriangleSetup {
  alignas(64) std::array<PerItem, 3> x, y, c;  // E_k = x u + y v + c up to a positive factor, up to 1
  alignas(64) PerItem doubt;  // an |E_k| not above it may have either sign; 2 where the side is not sure
  alignas(64) PerItem wx, wy, wc, w_error;  // 1/t; w_error is infinite where the side is not sure
  // What the triangle is within; of eye rays, whole numbers. low_u is infinite where no ray is to be asked about it.
  alignas(64) PerItem low_u, high_u, low_v, high_v;
};

template <class D>
D mul_add_dot(const Vec3<D>& a, const Vec3<D>& b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, D(a.z * b.z)));
}
template <class D>
Vec3<D> mul_add_cross(const Vec3<D>& a, const Vec3<D>& b) {
  return {mul_add(a.y, b.z, D(-(a.z * b.y))), mul_add(a.z, b.x, D(-(a.x * b.z))),
          mul_add(a.x, b.y, D(-(a.y * b.x)))};
}
// x a + y b + c, of absolute values: the most that an affine function of this size can be.
template <class D>
D most_of(const Vec3<D>& f, const Vec3<D>& size) {
  return mul_add_dot(absolute(f), size);
}
// The most that |u|, |v| and 1 can be.
template <class D>
Vec3<D> extents(const RayPacket& p) {
  return {D(static_cast<double>(p.extent_u)), D(static_cast<double>(p.extent_v)), D(1)};
}

// The rectangle of (u, v) that surely holds the triangle; all of the plane where it does not lie ahead; nothing where it
// lies behind, where all rays pass beside it, and where it is not `asked`. Whether any of them holds something. u is off by
// 2^-22 of it, for the quotient and s, and by what the error of a place makes, and of a ray.
template <class D>
bool set_up_rectangle(const RayPacket& p, const PacketAxes& axes, const std::array<Vec3<D>, 3>& q, const D& l,
                      const Mask<D>& asked, std::size_t lane, TriangleSetup& out) {
  const D low_s = lane_min<D>(lane_min<D>(q[0].z, q[1].z), q[2].z),
          high_s = lane_max<D>(lane_max<D>(q[0].z, q[1].z), q[2].z);
  const D clear = mul_add(D(axes.ahead_l), l, D(axes.ahead_0));
  const Mask<D> ahead = low_s > clear, behind = high_s < -clear;
  const auto per = [&](const D& s) { return D(1) / select<D>(ahead, s, D(1)); };
  const std::array<D, 3> per_s{per(q[0].z), per(q[1].z), per(q[2].z)};
  const D most_per_s = lane_max<D>(lane_max<D>(per_s[0], per_s[1]), per_s[2]);
  const D place = D(p.near_error * p.reach + 0x1p-46 * p.distance) + D(0x1p-46) * l;
  const D ray((0x1p-48 + p.near_error) * p.length);
  struct Interval {
    D from, to;
  };
  const auto axis = [&](const D& a, const D& b, const D& c, double per_place) {
    const D low = lane_min<D>(lane_min<D>(a, b), c), high = lane_max<D>(lane_max<D>(a, b), c);
    const D margin = mul_add(D(per_place), mul_add(place, most_per_s, ray),
                             mul_add(D(0x1p-22), lane_max<D>(-low, high), D(p.place_error)));
    D from = low - margin, to = high + margin;
    if (p.lattice) {
      from = lane_ceil(from);
      to = lane_floor(to);
    }
    const D far(static_cast<double>(kFarPlace));
    return Interval{select<D>(ahead, lane_max<D>(from, -far), -far),
                    select<D>(ahead, lane_min<D>(to, far), far)};
  };
  const auto holds_some = [&](const Interval& of, float extent) {
    const D most(static_cast<double>(extent));
    return of.from <= of.to && of.from <= most && of.to >= -most;
  };
  const Interval u = axis(per_s[0] * q[0].x, per_s[1] * q[1].x, per_s[2] * q[2].x, axes.per_place[0]),
                 v = axis(per_s[0] * q[0].y, per_s[1] * q[1].y, per_s[2] * q[2].y, axes.per_place[1]);
  const Mask<D> alive = asked && !behind && holds_some(u, p.extent_u) && holds_some(v, p.extent_v);
  const D nowhere(std::numeric_limits<double>::infinity());
  store(to_float<D>(select<D>(alive, u.from, nowhere)), &out.low_u[lane]);
  store(to_float<D>(u.to), &out.high_u[lane]);
  store(to_float<D>(v.from), &out.low_v[lane]);
  store(to_float<D>(v.to), &out.high_v[lane]);
  return any<D>(alive);
}

// What the edges need of the plane.
template <class D>
struct PlaneSetup {
  D h, most_w;  // n . q_0, and the greatest 1/t of any ray
  Mask<D> sure;
};

// 1/t over (u, v).
template <class D>
PlaneSetup<D> set_up_depth(const RayPacket& p, const PacketAxes& axes, const Vec3<D>& q0, const Vec3<D>& n,
                           const D& l, const D& m, std::size_t lane, TriangleSetup& out) {
  const D h = mul_add_dot(q0, n), size_h = lane_abs<D>(h), off = D(axes.per_det) * (l * m);
  const D size_n = most_of(n, wide<D>(axes.size));
  const Mask<D> sure = size_h > mul_add(D(0x1p-27), l, D(0x1p-25 * (axes.kappa * axes.kappa)) * m) * off &&
                       size_h > lane_max<D>(D(0x1p-17) * l, D(0x1p-20 * p.reach)) * size_n;
  const D per_h = select<D>(sure, D(1) / select<D>(sure, h, D(1)), D(0));
  const Vec3<D> w = per_h * n;
  const D most_w = most_of(w, extents<D>(p));
  const D w_error =
      mul_add(D(0x1p-21), most_w, D(p.place_error) * (lane_abs<D>(w.x) + lane_abs<D>(w.y))) +
      (D(0x1p-46 * p.length) * mul_add(D(axes.kappa), m, l)) * (m * lane_abs<D>(per_h) * D(axes.per_det));
  store(to_float<D>(w.x), &out.wx[lane]);
  store(to_float<D>(w.y), &out.wy[lane]);
  store(to_float<D>(w.z), &out.wc[lane]);
  store(to_float<D>(select<D>(sure, w_error, D(std::numeric_limits<double>::infinity()))),
        &out.w_error[lane]);
  return {h, most_w, sure};
}

// The edge functions, turned by the side.
template <class D>
void set_up_edges(const RayPacket& p, const PacketAxes& axes, const std::array<Vec3<D>, 3>& q, const D& l,
                  const PlaneSetup<D>& plane, std::size_t lane, TriangleSetup& out) {
  const D turn = select<D>(plane.h < D(0), D(-1), D(1)), reach_l = l + D(p.distance);
  const D ray = D(0x1p-46 * p.length * axes.per_det * (1 + axes.kappa)) * (reach_l * reach_l);
  const D near = D(p.near_error) * mul_add(D(p.reach), plane.most_w, D(p.length));
  D doubt(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3<D> edge = mul_add_cross(q[(k + 1) % 3], q[(k + 2) % 3]);
    const D unit = most_of(edge, extents<D>(p));
    const D rounding = mul_add(D(p.place_error), D(lane_abs<D>(edge.x) + lane_abs<D>(edge.y)),
                               mul_add(near, most_of(edge, wide<D>(axes.size)), ray));
    const D per_unit = D(1) / select<D>(unit > D(0), unit, D(1)), scale = turn * per_unit;
    store(to_float<D>(scale * edge.x), &out.x[k][lane]);
    store(to_float<D>(scale * edge.y), &out.y[k][lane]);
    store(to_float<D>(scale * edge.z), &out.c[k][lane]);
    doubt = lane_max<D>(doubt, rounding * per_unit);
  }
  store(to_float<D>(select<D>(plane.sure, doubt + D(0x1p-21), D(2))), &out.doubt[lane]);
}

// Triangles from `lane` on, of the `count` of a leaf, to `at`. Whether there is anything to ask of them.
template <class D>
bool set_up_triangles(const RayPacket& p, const PacketAxes& axes, const double* leaf, std::uint32_t count,
                      std::size_t lane, std::size_t at, TriangleSetup& out) {
  const auto corner = [&](std::uint32_t k) { return load_corner<D>(leaf + lane, count, k); };
  const auto in_axes = [&](const Vec3<D>& x) {
    const auto along = [&](const Vec3<double>& row) { return mul_add_dot(wide<D>(row), x); };
    return Vec3<D>{along(axes.row[0]), along(axes.row[1]), along(axes.row[2])};
  };
  const Vec3<D> v0 = corner(0), a0 = v0 - wide<D>(p.origin), e1 = corner(1) - v0, e2 = corner(2) - v0;
  const D m = lane_max<D>(l1_norm(e1), l1_norm(e2)), l = l1_norm(a0) + m;
  const Vec3<D> q0 = in_axes(a0), q1 = in_axes(e1), q2 = in_axes(e2);
  const std::array<Vec3<D>, 3> q{q0, q0 + q1, q0 + q2};
  const Mask<D> asked = lane_numbers<D>() < D(static_cast<double>(count) - static_cast<double>(lane));
  if (!set_up_rectangle<D>(p, axes, q, l, asked, at, out)) return false;
  const PlaneSetup<D> plane = set_up_depth<D>(p, axes, q0, mul_add_cross(q1, q2), l, m, at, out);
  set_up_edges<D>(p, axes, q, l, plane, at, out);
  return true;
}

// A leaf's, to `at`.
template <class D>
bool set_up_leaf(const RayPacket& p, const PacketAxes& axes, const double* leaf, std::uint32_t count,
                 std::size_t at, TriangleSetup& out) {
  bool any_asked = false;
  for (std::size_t lane = 0; lane < Bvh::kMaxLeaf; lane += kLanes<D>)
    if (lane < count)
      any_asked |= set_up_triangles<D>(p, axes, leaf, count, lane, at + lane, out);
    else
      std::fill_n(&out.low_u[at + lane], kLanes<D>, kInfinity);
  return any_asked;
}

}  // namespace sidelight::raytrace
