// SPDX-License-Identifier: MIT
// surface_kernel.h for triangles, whose lanes have more to do.
#pragma once

#include <memory>

#include "common/model/surface_lanes.h"

namespace sidelight {

// A triangle seen from the eye: visibility.h's TriangleView and DepthPlane, place.cpp's outward normal.
template <class F>
struct TriangleLanes {
  Vec3<F> v0, e1, e2;
  std::array<Vec3<F>, 3> edge, normal;
  Vec3<F> facing;  // Nv; not of unit length unless a triangle of the group is flat, or rays leave
  F clearance;     // if rays leave
  F facing_size;   // |x| + |y| + |z| of it
  F lengths2;      // |a_0|² + |a_1|² + |a_2|²
  Vec3<F> n;
  F a0_n, depth_bound;  // lengths2 (|e1|² + |e2|²)
  Mask<F> sure, sure_depth;
};

// place.cpp's clearance_of().
template <class F>
F triangle_clearance(const Vec3<F>& outward, const Vec3<F>& v0, const Vec3<F>& v1, const Vec3<F>& v2) {
  const auto reach = [](const F& a, const F& b, const F& c) {
    return lane_max(lane_max(lane_abs(a), lane_abs(b)), lane_abs(c));
  };
  return F(16 * 0x1p-53) * dot(absolute(outward), Vec3<F>{reach(v0.x, v1.x, v2.x), reach(v0.y, v1.y, v2.y),
                                                          reach(v0.z, v1.z, v2.z)});
}
// Bounds, by |p_j q_k| + |p_k q_j| <= |p| |q|, with room for their own rounding:
//   side: 6 u |a0| . weight <= 6 u sqrt(3) |a0| |a1| |a2|; squared, 2^-99.2 times the product of the squares.
//   depth: w1 <= |e1| + |a0| + |a1| <= 2 (|a0| + |a1|), so weight <= 4 sqrt(S T) with S = |a0|² + |a1|² + |a2|²,
//   T = |e1|² + |e2|²; |a0| . weight <= sqrt(3 S) 4 sqrt(S T) <= 2^31 |a0 . n| iff S² T <= 2^56.4 (a0 . n)².
template <class F>
TriangleLanes<F> triangle_lanes(const SurfaceLanes<F>& lanes, const Vec3<F>& origin, bool want_t) {
  TriangleLanes<F> out;
  const Vec3<F> v1 = lanes.scene_vector(1), v2 = lanes.scene_vector(2);
  out.v0 = lanes.scene_vector(0);
  out.e1 = v1 - out.v0;
  out.e2 = v2 - out.v0;
  const Vec3<F> a0 = out.v0 - origin, a1 = v1 - origin, a2 = v2 - origin;
  out.edge = {cross(a1, a2), cross(a2, a0), cross(a0, a1)};

  const F s0 = dot(a0, a0), s1 = dot(a1, a1), s2 = dot(a2, a2);
  out.lengths2 = (s0 + s1) + s2;
  const F side = dot(a0, out.edge[0]);
  out.sure = side * side > F(0x1p-99) * ((s0 * s1) * s2);

  out.n = cross(out.e1, out.e2);
  Vec3<F> outward = out.n;
  if (lanes.group().flat || lanes.wants_leaving()) {
    const F most = lane_max(lane_max(lane_abs(out.n.x), lane_abs(out.n.y)), lane_abs(out.n.z));
    outward = normalized(Vec3<F>{out.n.x / most, out.n.y / most, out.n.z / most});
  }
  out.facing = select<F>(side < F(0), outward, -outward);
  out.facing_size = size(out.facing);
  if (lanes.wants_leaving()) out.clearance = triangle_clearance(outward, out.v0, v1, v2);
  if (lanes.group().smooth)
    out.normal = {lanes.scene_vector(3), lanes.scene_vector(4), lanes.scene_vector(5)};

  if (want_t) {
    out.a0_n = dot(a0, out.n);
    out.depth_bound = out.lengths2 * (dot(out.e1, out.e1) + dot(out.e2, out.e2));
    out.sure_depth = out.depth_bound * out.lengths2 <= F(0x1p56) * (out.a0_n * out.a0_n);
  }
  return out;
}

// N and whether it is sure. With vertex normals of zero, Nv. Of the sign of smooth . facing that of smooth . n is told
// where rounding cannot reach it: each is off by less than 8 u |smooth| |n|.
template <class F>
Vec3<F> triangle_normal(const TriangleLanes<F>& triangle, const std::array<F, 3>& barycentric,
                        const SurfaceBatch::Group& group, Mask<F>& sure) {
  if (!group.smooth) return triangle.facing;
  Vec3<F> smooth{F(0), F(0), F(0)};
  for (std::size_t k = 0; k < 3; ++k) smooth = smooth + barycentric[k] * triangle.normal[k];
  const F side = dot(smooth, triangle.facing), size_of_smooth = size(smooth);
  const Mask<F> none = size_of_smooth == F(0);
  const Mask<F> sure_side = lane_abs(side) > F(0x1p-48) * (size_of_smooth * triangle.facing_size);
  const Vec3<F> turned = select<F>(side < F(0), -smooth, smooth);
  if (!group.flat) {
    sure = sure && sure_side;
    return normalized(turned);
  }
  sure = sure && (sure_side || none);
  const Vec3<F> unit_or_x = select<F>(none, Vec3<F>{F(1), F(0), F(0)}, turned);
  return select<F>(none, triangle.facing, normalized(unit_or_x));
}

// Where one may be made: nothing is done to it before.
template <class F>
union RoomForTriangle {
  RoomForTriangle() {}
  TriangleLanes<F> lanes;
};

// What is known of a sample between the steps below. Arrays, which are not zeroed first as a Vec3 would be.
template <class F>
struct SampleLanes {
  std::array<F, 3> direction, barycentric;
};

// d . weight <= |d| sum |a_i| |a_j| <= |d| S, and 6 u of it may be 2^-20 |sum|.
// Depth: |d| 4 sqrt(S T) <= 2^31 |d . n| iff |d|² S T <= 2^58 (d . n)²; 2^57 for the rounding of the bound.
template <class F>
void locate_sample(const SurfaceView& view, const TriangleLanes<F>& triangle, SurfaceBatch& batch,
                   std::size_t i, SampleLanes<F>& sample) {
  SurfaceLanes<F> lanes(batch, i);
  const Vec3<F> d = lanes.direction(view);
  std::array<F, 3> e{dot(d, triangle.edge[0]), dot(d, triangle.edge[1]), dot(d, triangle.edge[2])};
  const F all = (e[0] + e[1]) + e[2], size_of_d = size(d);
  Mask<F> sure = triangle.sure && size_of_d * triangle.lengths2 <= F(0x1p30) * lane_abs(all);
  const Mask<F> negative = all < F(0);
  for (F& each : e) each = select<F>((each < F(0)) != negative, F(0), each);
  const F sum = (e[0] + e[1]) + e[2];
  const F first = lanes.group().smooth ? e[0] / sum : F(0);  // only the normal asks for it
  sample.direction = {d.x, d.y, d.z};
  sample.barycentric = {first, e[1] / sum, e[2] / sum};
  if (batch.want_t && !batch.has_t) {
    const F d_n = dot(d, triangle.n);
    const F t = triangle.a0_n / d_n;
    sure = sure && triangle.sure_depth && t > F(0) &&
           (size_of_d * size_of_d) * triangle.depth_bound <= F(0x1p57) * (d_n * d_n);
    lanes.put_t(t);
  }
  lanes.put_doubt(sure);
}

// Step by step, each for all entries, so that the processor has many short chains of operations at hand and not a few
// long ones.
template <class F>
void surfaces_of_triangles(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out) {
  constexpr auto kCount = static_cast<std::size_t>(kLanes<F>), kVectors = SurfaceBatch::kCapacity / kCount;
  const std::size_t vectors = (static_cast<std::size_t>(batch.size) + kCount - 1) / kCount;
  std::array<RoomForTriangle<F>, kVectors> room;
  std::array<const TriangleLanes<F>*, kVectors> triangle;
  std::array<SampleLanes<F>, kVectors> sample;

  std::uint32_t last = kNone;  // the one triangle that the vector before is of
  for (std::size_t v = 0; v < vectors; ++v) {
    const SurfaceLanes<F> lanes(batch, v * kCount);
    const std::uint32_t one = lanes.group().one && !batch.own_rays ? batch.primitive[v * kCount] : kNone;
    if (one != kNone && one == last) {
      triangle[v] = triangle[v - 1];
    } else {
      triangle[v] = std::construct_at(
          &room[v].lanes, triangle_lanes(lanes, lanes.origin(view), batch.want_t && !batch.has_t));
    }
    last = one;
  }
  for (std::size_t v = 0; v < vectors; ++v) locate_sample(view, *triangle[v], batch, v * kCount, sample[v]);
  for (std::size_t v = 0; v < vectors; ++v) {
    const TriangleLanes<F>& at = *triangle[v];
    const std::array<F, 3>& barycentric = sample[v].barycentric;
    const Vec3<F> point = (at.v0 + barycentric[1] * at.e1) + barycentric[2] * at.e2;
    put_position(view, point, out, v * kCount);
    SurfaceLanes<F> lanes(batch, v * kCount);
    if (!lanes.wants_leaving()) continue;
    lanes.put_leaving(point, at.facing, at.clearance);
    put_rounded(at.facing, out.facing, v * kCount);
  }
  for (std::size_t v = 0; v < vectors; ++v) {
    SurfaceLanes<F> lanes(batch, v * kCount);
    Mask<F> sure(true);
    const Vec3<F> normal = triangle_normal(*triangle[v], sample[v].barycentric, lanes.group(), sure);
    put_rounded(normal, out.normal, v * kCount);
    if (lanes.wants_leaving()) lanes.put_normal(normal);
    lanes.add_doubt(sure);
  }
  for (std::size_t v = 0; v < vectors; ++v) {
    const auto& [x, y, z] = sample[v].direction;
    if (SurfaceLanes<F>(batch, v * kCount).group().shiny)
      put_rounded(-normalized(Vec3<F>{x, y, z}), out.to_viewer, v * kCount);
  }
}

}  // namespace sidelight
