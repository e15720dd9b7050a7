// SPDX-License-Identifier: MIT
// A packet (packets.h) against the hierarchies, for lane types F of floats (rays, groups, boxes) and D of doubles (the
// set-up of a leaf's triangles side by side). Included only by packets_scalar.cpp, packets_avx2.cpp and
// packets_avx512.cpp, each compiled for its instruction set.
#pragma once

#include <bit>

#include "common/math/lane_ops.h"
#include "common/math/vec.h"
#include "raytrace/packets.h"

namespace sidelight::raytrace {

// Eight primitives of a leaf as the rays see them: edge functions up to a positive factor, of values up to 1 within the
// packet, and 1/t. In float, with bounds.
struct LeafSetup {
  using Row = std::array<float, 8>;
  alignas(64) std::array<Row, 3> x, y, c;  // E_k = x u + y v + c
  alignas(64) Row doubt;                   // an |E_k| not above it may have either sign
  alignas(64) Row wx, wy, wc, w_error;
  alignas(64)
      Row sure;  // not 0: the side is sure, and all bounds hold; else nothing is known of depths and sides
};

template <class D>
using FloatsOf = decltype(to_float<D>(D{}));
template <class F>
Vec3<F> wide_of(const glm::dvec3& v) {
  return {F(v.x), F(v.y), F(v.z)};
}
template <class F>
F l1(const Vec3<F>& v) {
  return (lane_abs<F>(v.x) + lane_abs<F>(v.y)) + lane_abs<F>(v.z);
}

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

// ---- One primitive against the groups ----

template <class F>
void ask_lanes(RayPacket& p, std::size_t first, std::uint32_t bits, std::uint32_t primitive,
               SignCounts& counts) {
  for (; bits != 0; bits &= bits - 1) {
    const std::size_t ray = first + static_cast<std::size_t>(std::countr_zero(bits));
    p.asked[ray] = true;
    p.ask(p, ray, primitive, counts);
  }
}

// Keeps the primitive where it is surely met and surely nearer than what is kept; asks where that is doubtful. Whether
// anything may have changed.
template <class F>
bool keep_nearer(RayPacket& p, std::size_t first, std::uint32_t primitive, const Mask<F>& met,
                 const Mask<F>& may, const F& w, const F& w_error, bool sure, SignCounts& counts) {
  using I = Ints<F>;
  const F held = load<F>(&p.w[first]);
  const Mask<F> nearer = met && w * F(0x1p-17f) > w_error && w > held * F(kSurely);
  const Mask<F> farther = (w + w_error) * F(kSurely) < held;
  const Mask<F> open = held < F(std::numeric_limits<float>::infinity());
  const Mask<F> decided = sure ? nearer || farther : Mask<F>(false);
  const Mask<F> doubtful = may && open && !decided;
  const Mask<F> taken = sure ? nearer : Mask<F>(false);
  std::uint32_t asked = mask_bits<F>(doubtful);
  if (p.any_hit && sure)
    // The light lies clearly before the surface that asks, which then is not in its way.
    for (std::uint32_t bits = asked & mask_bits<F>(met); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      if (p.own[first + lane] == static_cast<std::int32_t>(primitive)) asked &= ~(1u << lane);
    }
  if (any<F>(taken)) {
    store(select<F>(taken, p.any_hit ? F(std::numeric_limits<float>::infinity()) : w, held), &p.w[first]);
    const F id = from_bits<F>(I(static_cast<std::int32_t>(primitive)));
    store(to_bits<F>(select<F>(taken, id, from_bits<F>(load<I>(&p.primitive[first])))), &p.primitive[first]);
  }
  if (asked != 0) ask_lanes<F>(p, first, asked, primitive, counts);
  return asked != 0 || any<F>(taken);
}

template <class F>
float least_of_group(const RayPacket& p, std::size_t group) {
  const float* w = &p.w[group * RayPacket::kGroup];
  F low = load<F>(w);
  for (int lane = kLanes<F>; lane < RayPacket::kGroup; lane += kLanes<F>)
    low = lane_min<F>(low, load<F>(w + lane));
  return least(low);
}

// After something was kept in these groups.
template <class F>
void update_least(RayPacket& p, std::uint32_t groups) {
  for (; groups != 0; groups &= groups - 1) {
    const auto g = static_cast<std::size_t>(std::countr_zero(groups));
    p.least_w[g] = least_of_group<F>(p, g);
  }
  float low = p.least_w[0];
  for (std::size_t g = 1; g < static_cast<std::size_t>(p.groups); ++g) low = lane_min(low, p.least_w[g]);
  p.least = low;
}

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

// ---- Leaves ----

template <class F>
bool casts_none(const Prepared& prepared, const RayPacket& p, std::uint32_t primitive) {
  if (!p.any_hit || p.all_cast) return false;
  return !prepared.scene.materials[primitive_material(prepared.scene, primitive)].casts_shadow;
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
    const F x(static_cast<float>(s.b_u)), y(static_cast<float>(s.b_v));
    const F middle =
        (x * load<F>(&p.group_u[g]) + y * load<F>(&p.group_v[g])) + F(static_cast<float>(s.b_w) + error);
    const F b = middle + (lane_abs<F>(x) * load<F>(&p.half_u[g]) + lane_abs<F>(y) * load<F>(&p.half_v[g]));
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
  return keep_nearer<F>(p, ray, primitive, met, may, select<F>(met, load<F>(ws.data()), F(0)),
                        select<F>(met, load<F>(w_errors.data()), F(kInfinity)), s.sure, counts);
}

template <class F, class D>
void test_leaf(const Prepared& prepared, const SphereLeaves& leaves, std::uint32_t first, std::uint32_t count,
               RayPacket& p, SignCounts& counts) {
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

// ---- The walk ----

// n . x - offset of one corner of each of eight boxes: the one that lies farthest along n, or nearest.
struct PacketPlane {
  std::array<std::size_t, 3> face;  // rows of BvhNode::face
  std::array<float, 3> n;
  float offset = 0;  // n . (o - center), by the slack on the safe side
};
struct PacketPlanes {
  std::array<PacketPlane, 4> side;  // >= 0 inside
  PacketPlane last, first;          // n . (x - o) is the depth of x, the same for all rays
};

// Bound: the float sum of three products, 2^-22 |n| reach, and the pad for all rounding and nearness: 2^-20 with room.
template <class B>
PacketPlane packet_plane(const RayPacket& p, const Bvh& bvh, const Vec3<double>& normal, double scale,
                         bool farthest) {
  PacketPlane out;
  const std::array<double, 3> n{scale * normal.x, scale * normal.y, scale * normal.z};
  double offset = 0, size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    out.n[i] = static_cast<float>(n[i]);
    out.face[i] = (n[i] >= 0) == farthest ? i + 3 : i;
    offset += n[i] * (p.origin[axis] - bvh.center[axis]);
    size += lane_abs(n[i]);
  }
  const double slack = 0x1p-19 * size * p.reach;
  out.offset = static_cast<float>(farthest ? offset - slack : offset + slack);
  return out;
}

// Planes through the origin along the packet's four sides: with D = W . (U x V), d . ((W + u1 U) x V) = D (u1 - u).
template <class B>
PacketPlanes packet_planes(const RayPacket& p, const Bvh& bvh) {
  const auto vec = [](const glm::dvec3& v) { return Vec3<double>{v.x, v.y, v.z}; };
  const Vec3<double> W = vec(p.W), U = vec(p.U), V = vec(p.V), depth = cross(U, V);
  const double D = dot(W, depth), turn = D < 0 ? -1.0 : 1.0;
  // A little wider than the rays, for the rounding of u and v.
  const double u1 = (1 + 0x1p-20) * static_cast<double>(p.extent_u) + p.place_error;
  const double v1 = (1 + 0x1p-20) * static_cast<double>(p.extent_v) + p.place_error;
  const auto side = [&](const Vec3<double>& a, const Vec3<double>& b) {
    const Vec3<double> n = cross(a, b);
    return packet_plane<B>(p, bvh, n, turn / l1(n), true);
  };
  PacketPlanes out;
  out.side = {side(W + u1 * U, V), side(V, W - u1 * U), side(U, W + v1 * V), side(W - v1 * V, U)};
  out.last = packet_plane<B>(p, bvh, depth, 1 / D, true);
  out.first = packet_plane<B>(p, bvh, depth, 1 / D, false);
  return out;
}

// The children that the packet may meet, as bits, and the depth from which on.
template <class B>
std::uint32_t meet_boxes(const BvhNode& node, const PacketPlanes& planes,
                         std::array<float, BvhNode::kWidth>& depth) {
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < BvhNode::kWidth; lane += kLanes<B>) {
    const auto at = [&](const PacketPlane& plane) {
      const auto part = [&](std::size_t i) {
        return B(plane.n[i]) * load<B>(&node.face[plane.face[i]][lane]);
      };
      return ((part(0) + part(1)) + part(2)) - B(plane.offset);
    };
    Mask<B> met = at(planes.last) >= B(0);
    for (const PacketPlane& plane : planes.side) met = met && at(plane) >= B(0);
    store(lane_max<B>(at(planes.first), B(0)), &depth[lane]);
    bits |= mask_bits<B>(met) << lane;
  }
  return bits;
}

template <class F, class B, class D, class Tree>
void walk_packet(const Prepared& prepared, const Tree& leaves, RayPacket& p, SignCounts& counts) {
  const Bvh& bvh = leaves.bvh;
  if (bvh.nodes.empty() || p.groups == 0) return;
  const PacketPlanes planes = packet_planes<B>(p, bvh);
  struct Entry {
    float depth;
    std::uint32_t first, count;
  };
  std::array<Entry, Bvh::kMaxDepth*(BvhNode::kWidth - 1) + 1> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0, 0};
  while (size > 0) {
    const Entry top = stack[--size];
    // Surely behind all that is kept; all rays of an infinite w are done.
    if (p.least == std::numeric_limits<float>::infinity()) return;
    if (top.depth * p.least > 1 + 0x1p-12f) continue;
    p.budget -= top.count > 0 ? 8 : 1;
    if (p.budget < 0) return;
    if (top.count > 0) {
      test_leaf<F, D>(prepared, leaves, top.first, top.count, p, counts);
      continue;
    }
    ++counts.nodes;
    const BvhNode& node = bvh.nodes[top.first];
    alignas(64) std::array<float, BvhNode::kWidth> depth;
    const std::uint32_t met = meet_boxes<B>(node, planes, depth);
    const std::size_t base = size;
    for (std::uint32_t bits = met; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      const Entry child{depth[i], node.first[i], node.count[i]};
      std::size_t at = size++;
      for (; at > base && stack[at - 1].depth <= child.depth; --at) stack[at] = stack[at - 1];
      stack[at] = child;
    }
  }
}

// ---- Planes, and all ----

// A plane is a triangle without edges.
template <class F>
void test_plane(const Prepared& prepared, RayPacket& p, std::uint32_t primitive, SignCounts& counts) {
  if (casts_none<F>(prepared, p, primitive)) return;
  const Plane& plane = prepared.scene.planes[primitive_ref(prepared.scene, primitive).index];
  const Vec3<double> n{plane.normal.x, plane.normal.y, plane.normal.z};
  const auto along = [&](const glm::dvec3& d) { return (n.x * d.x + n.y * d.y) + n.z * d.z; };
  const double h = along(plane.point - p.origin), size_h = lane_abs(h);
  const bool sure = size_h > 0x1p-17 * p.distance && size_h > 0x1p-20 * p.reach;
  const double per_h = 1 / (sure ? h : 1.0);
  const double x = per_h * along(p.U), y = per_h * along(p.V), c = per_h * along(p.W);
  const double error =
      0x1p-21 *
          ((lane_abs(x) * static_cast<double>(p.extent_u) + lane_abs(y) * static_cast<double>(p.extent_v)) +
           lane_abs(c)) +
      p.place_error * (lane_abs(x) + lane_abs(y)) + 0x1p-46 * p.length * lane_abs(per_h);
  LeafSetup s;
  for (std::size_t k = 0; k < 3; ++k) {
    s.x[k][0] = s.y[k][0] = 0;
    s.c[k][0] = 1;
  }
  s.doubt[0] = 0.5f;
  s.wx[0] = static_cast<float>(x);
  s.wy[0] = static_cast<float>(y);
  s.wc[0] = static_cast<float>(c);
  s.w_error[0] = static_cast<float>(error);
  s.sure[0] = sure ? 1.0f : 0.0f;
  update_least<F>(p, test_triangle<F>(p, s, 0, primitive, counts));
}

template <class D>
void find_squares(RayPacket& p) {
  const Vec3<D> W = wide_of<D>(p.W), U = wide_of<D>(p.U), V = wide_of<D>(p.V);
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.groups) * RayPacket::kGroup; i += kLanes<D>) {
    const Vec3<D> d =
        (W + to_double<D>(load<FloatsOf<D>>(&p.u[i])) * U) + to_double<D>(load<FloatsOf<D>>(&p.v[i])) * V;
    store(dot(d, d), &p.square[i]);
  }
  p.least_square.fill(0);
  for (std::size_t g = 0; g < static_cast<std::size_t>(p.groups); ++g) {
    const double* square = &p.square[g * RayPacket::kGroup];
    D low = load<D>(square);
    for (int i = kLanes<D>; i < RayPacket::kGroup; i += kLanes<D>)
      low = lane_min<D>(low, load<D>(square + i));
    p.least_square[g] = static_cast<float>(least(low)) * (1 - 0x1p-20f);
  }
}

template <class F, class B, class D>
void meet_all(const Prepared& prepared, RayPacket& p, SignCounts& counts) {
  for (const std::uint32_t plane : prepared.planes) test_plane<F>(prepared, p, plane, counts);
  walk_packet<F, B, D>(prepared, prepared.triangles, p, counts);
  if (prepared.spheres.bvh.nodes.empty() || p.budget < 0) return;
  find_squares<D>(p);
  walk_packet<F, B, D>(prepared, prepared.spheres, p, counts);
}

}  // namespace sidelight::raytrace
