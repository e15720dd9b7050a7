// SPDX-License-Identifier: MIT
// surface_kernel.h for triangles, whose lanes have more to do.
#pragma once

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
void view_triangles(const SurfaceLanes<F>& lanes, const Vec3<F>& origin, bool want_t, TriangleLanes<F>& out) {
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
}

// N and whether it is sure. With vertex normals of zero, Nv. Of the sign of smooth . facing that of smooth . n is told
// where rounding cannot reach it: each is off by less than 8 u |smooth| |n|.
template <class F>
Vec3<F> triangle_normal(const TriangleLanes<F>& triangle, const std::array<F, 3>& barycentric,
                        const SurfaceBatch::Group& group, Mask<F>& sure) {
  if (!group.smooth) return triangle.facing;
  const auto& [n0, n1, n2] = triangle.normal;
  const Vec3<F> smooth = (barycentric[0] * n0 + barycentric[1] * n1) + barycentric[2] * n2;
  const F side = dot(smooth, triangle.facing), size_of_smooth = size(smooth);
  const Mask<F> sure_side = lane_abs(side) > F(0x1p-48) * (size_of_smooth * triangle.facing_size);
  const F length2 = dot(smooth, smooth);
  const auto turned = [&](const F& divisor) {
    const F per_length = F(1) / square_root(divisor);
    return select<F>(side < F(0), -per_length, per_length) * smooth;
  };
  if (!group.flat) {
    sure = sure && sure_side;
    return turned(length2);
  }
  const Mask<F> none = size_of_smooth == F(0);
  sure = sure && (sure_side || none);
  return select<F>(none, triangle.facing, turned(select<F>(none, F(1), length2)));
}

// What is known of a sample between the steps below.
template <class F>
struct SampleLanes {
  Vec3<F> direction;
  std::array<F, 3> barycentric;
  Mask<F> sure;
};

// d . weight <= |d| sum |a_i| |a_j| <= |d| S, and 6 u of it may be 2^-20 |sum|.
// Depth: |d| 4 sqrt(S T) <= 2^31 |d . n| iff |d|² S T <= 2^58 (d . n)²; 2^57 for the rounding of the bound.
template <class F>
void locate_sample(const TriangleLanes<F>& triangle, SurfaceBatch& batch, std::size_t i,
                   SampleLanes<F>& sample) {
  const Vec3<F>& d = sample.direction;
  std::array<F, 3> e{dot(d, triangle.edge[0]), dot(d, triangle.edge[1]), dot(d, triangle.edge[2])};
  const F all = (e[0] + e[1]) + e[2], size_of_d = size(d);
  sample.sure = triangle.sure && size_of_d * triangle.lengths2 <= F(0x1p30) * lane_abs(all);
  // What rounding gave the other sign is 0.
  const F sign = select<F>(all < F(0), F(-1), F(1));
  for (F& each : e) each = lane_max(F(0), sign * each);
  const F per_sum = F(1) / ((e[0] + e[1]) + e[2]);
  sample.barycentric = {e[0] * per_sum, e[1] * per_sum, e[2] * per_sum};
  if (!batch.want_t || batch.has_t) return;
  const F d_n = dot(d, triangle.n);
  const F t = triangle.a0_n / d_n;
  sample.sure = sample.sure && triangle.sure_depth && t > F(0) &&
                (size_of_d * size_of_d) * triangle.depth_bound <= F(0x1p57) * (d_n * d_n);
  SurfaceLanes<F>(batch, i).put_t(t);
}

// The vectors from `first` on, a few at a time, step by step, each step for all of them: the processor has several short
// chains of operations at hand and not a few long ones, and what lies between the steps stays in the first cache.
template <class F>
class TriangleSurfaces {
 public:
  TriangleSurfaces(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out)
      : view_(view), batch_(batch), out_(out) {}

  void find_all() {
    const auto size = static_cast<std::size_t>(batch_.size);
    for (std::size_t first = 0; first < size; first += kVectors * kCount)
      find(first, std::min(kVectors, (size - first + kCount - 1) / kCount));
  }

 private:
  static constexpr auto kCount = static_cast<std::size_t>(kLanes<F>);
  static constexpr std::size_t kVectors = 8;

  void find(std::size_t first, std::size_t vectors) {
    const auto for_each_vector = [&](const auto& visit) {
      for (std::size_t v = 0; v < vectors; ++v) visit(v, first + v * kCount);
    };
    for_each_vector([&](std::size_t v, std::size_t i) { triangle_[v] = view_triangles_at(i); });
    for_each_vector([&](std::size_t v, std::size_t i) {
      SurfaceLanes<F>(batch_, i).direction(view_, sample_[v].direction);
    });
    for_each_vector(
        [&](std::size_t v, std::size_t i) { locate_sample(*triangle_[v], batch_, i, sample_[v]); });
    for_each_vector([&](std::size_t v, std::size_t i) { put_point(*triangle_[v], sample_[v], i); });
    for_each_vector([&](std::size_t v, std::size_t i) { put_normal(*triangle_[v], sample_[v], i); });
    for_each_vector([&](std::size_t v, std::size_t i) {
      if (SurfaceLanes<F>(batch_, i).group().shiny)
        put_rounded(to_viewer(sample_[v].direction), out_.to_viewer, i);
    });
  }

  // A group that shows the triangle of the one before, and from the same place, needs no other view of it.
  const TriangleLanes<F>* view_triangles_at(std::size_t i) {
    const SurfaceLanes<F> lanes(batch_, i);
    const std::uint32_t one = lanes.group().one && !batch_.own_rays ? batch_.primitive[i] : kNone;
    if (one == kNone || one != last_) {
      last_room_ = (last_room_ + 1) % kVectors;
      view_triangles(lanes, lanes.origin(view_), batch_.want_t && !batch_.has_t, room_[last_room_]);
    }
    last_ = one;
    return &room_[last_room_];
  }

  void put_point(const TriangleLanes<F>& at, const SampleLanes<F>& sample, std::size_t i) {
    const Vec3<F> point = (at.v0 + sample.barycentric[1] * at.e1) + sample.barycentric[2] * at.e2;
    put_position(view_, point, out_, i);
    SurfaceLanes<F> lanes(batch_, i);
    if (!lanes.wants_leaving()) return;
    lanes.put_leaving(point, at.facing, at.clearance);
    put_rounded(at.facing, out_.facing, i);
  }

  void put_normal(const TriangleLanes<F>& at, const SampleLanes<F>& sample, std::size_t i) {
    SurfaceLanes<F> lanes(batch_, i);
    Mask<F> sure = sample.sure;
    const Vec3<F> normal = triangle_normal(at, sample.barycentric, lanes.group(), sure);
    put_rounded(normal, out_.normal, i);
    if (lanes.wants_leaving()) lanes.put_normal(normal);
    lanes.put_doubt(sure);
  }

  const SurfaceView& view_;
  SurfaceBatch& batch_;
  ShadingBatch& out_;
  // The views last made: a vector's is not overwritten before those of kVectors others are made.
  std::array<TriangleLanes<F>, kVectors> room_;
  std::size_t last_room_ = 0;
  std::uint32_t last_ = kNone;  // the one triangle that the vector before is of
  std::array<const TriangleLanes<F>*, kVectors> triangle_;
  std::array<SampleLanes<F>, kVectors> sample_;
};

}  // namespace sidelight
