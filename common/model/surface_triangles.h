// SPDX-License-Identifier: MIT
// surface_kernel.h for triangles, in two steps: what all samples of a run need of their triangle, once a run, in lanes
// across runs; then the samples, in lanes across samples.
#pragma once

#include <limits>

#include "common/model/surface_lanes.h"

namespace sidelight {

// place.cpp's clearance_of().
template <class F>
F triangle_clearance(const Vec3<F>& outward, const Vec3<F>& v0, const Vec3<F>& v1, const Vec3<F>& v2) {
  const auto reach = [](const F& a, const F& b, const F& c) {
    return lane_max(lane_max(lane_abs(a), lane_abs(b)), lane_abs(c));
  };
  return F(16 * 0x1p-53) * dot(absolute(outward), Vec3<F>{reach(v0.x, v1.x, v2.x), reach(v0.y, v1.y, v2.y),
                                                          reach(v0.z, v1.z, v2.z)});
}

template <class F>
class TriangleSurfaces {
 public:
  TriangleSurfaces(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out)
      : view_(view), batch_(batch), out_(out), runs_(*batch.triangle_runs) {}

  void find_all() {
    for (std::size_t r = 0; r < static_cast<std::size_t>(batch_.runs); r += kCount) {
      if (!is_seen(r)) see(r);
      smooth_ = smooth_ || runs_.smooth[r];
    }
    for_each_vector([&](std::size_t i, const auto& of_run) { locate(i, of_run); });
    for_each_vector([&](std::size_t i, const auto& of_run) {
      place(i, of_run);
      smooth_ ? interpolate(i, of_run) : copy_normal(i, of_run);
    });
    if (smooth_) make_unit<FloatLanes<F>>(out_.normal, 1, batch_);
  }

 private:
  static constexpr auto kCount = static_cast<std::size_t>(kLanes<F>);

  // ---- The triangles ----

  // of(triangle) of the runs from r on.
  template <class Of>
  Vec3<F> scene_vectors(std::size_t r, const Of& of) const {
    return load_vectors<F>([&](int lane) {
      return &of(view_.scene.triangles[batch_.index[r + static_cast<std::size_t>(lane)]]).x;
    });
  }
  Vec3<F> corners(std::size_t r, std::size_t k) const {
    return scene_vectors(r, [&](const Triangle& triangle) -> const glm::dvec3& {
      return view_.scene.positions[triangle.vertex[k]];
    });
  }
  // 0 of a flat triangle. (One with three normals of 0 is as good as flat.)
  Vec3<F> vertex_normals(std::size_t r, std::size_t k) const {
    return scene_vectors(r, [&](const Triangle& triangle) -> const glm::dvec3& {
      static constexpr glm::dvec3 kFlat(0);
      return triangle.normal[k] == kNone ? kFlat : view_.scene.normals[triangle.normal[k]];
    });
  }

  // Whether the vector's triangles are those that were looked at last time.
  bool is_seen(std::size_t r) {
    if (!runs_.kept) return false;
    const std::uint32_t* const now = &batch_.index[r];
    std::uint32_t* const before = &runs_.seen[r];
    std::uint32_t unlike = 0;
    for (std::size_t lane = 0; lane < kCount; ++lane) {
      unlike |= before[lane] ^ now[lane];
      before[lane] = now[lane];
    }
    return unlike == 0;
  }

  // Bounds, by |p_j q_k| + |p_k q_j| <= |p| |q|, with room for their own rounding:
  //   side: 6 u |a0| . weight <= 6 u sqrt(3) |a0| |a1| |a2|; squared, 2^-99.2 times the product of the squares.
  //   edges: d . weight <= |d| sum |a_i| |a_j| <= |d| S with S = |a0|² + |a1|² + |a2|², and 6 u of it may be
  //   2^-20 |sum|.
  //   depth: w1 <= |e1| + |a0| + |a1| <= 2 (|a0| + |a1|), so weight <= 4 sqrt(S T), T = |e1|² + |e2|²;
  //   |a0| . weight <= sqrt(3 S) 4 sqrt(S T) <= 2^31 |a0 . n| iff S² T <= 2^56.4 (a0 . n)².
  void see(std::size_t r) {
    const Vec3<F> v0 = corners(r, 0), v1 = corners(r, 1), v2 = corners(r, 2);
    const Vec3<F> e1 = v1 - v0, e2 = v2 - v0, origin = SurfaceLanes<F>(batch_, r).origin(view_);
    const F scale(view_.length_scale);
    store_rows<F>(scale * v0, runs_.v0, r);
    store_rows<F>(scale * e1, runs_.e1, r);
    store_rows<F>(scale * e2, runs_.e2, r);
    const Vec3<F> a0 = v0 - origin, a1 = v1 - origin, a2 = v2 - origin;
    const Vec3<F> opposite = cross(a1, a2);
    const F side = dot(a0, opposite), turn = select<F>(side < F(0), F(-1), F(1));
    store_rows<F>(turn * opposite, runs_.edge[0], r);
    store_rows<F>(turn * cross(a2, a0), runs_.edge[1], r);
    store_rows<F>(turn * cross(a0, a1), runs_.edge[2], r);

    const F s0 = dot(a0, a0), s1 = dot(a1, a1), s2 = dot(a2, a2), lengths2 = (s0 + s1) + s2;
    Mask<F> sure = side * side > F(0x1p-99) * ((s0 * s1) * s2);
    const Vec3<F> n = cross(e1, e2);
    const Vec3<F> toward = -turn * n;  // the side of Nv
    sure = see_normals(r, toward) && sure;
    const F never(std::numeric_limits<double>::infinity());
    store(select<F>(sure, F(0x1p-30) * lengths2, never), &runs_.least_sum[r]);
    if (batch_.want_leaving) store(triangle_clearance(facing(toward), v0, v1, v2), &runs_.clearance[r]);
    if (!batch_.want_t || batch_.has_t) return;
    const F a0_n = dot(a0, n), bound = lengths2 * (dot(e1, e1) + dot(e2, e2));
    const Mask<F> sure_depth = bound * lengths2 <= F(0x1p56) * (a0_n * a0_n);
    store_rows<F>(n, runs_.n, r);
    store(a0_n, &runs_.a0_n[r]);
    store(select<F>(sure_depth, bound, never), &runs_.depth_bound[r]);
  }

  // Nv
  static Vec3<F> facing(const Vec3<F>& toward) {
    const F most = lane_max(lane_max(lane_abs(toward.x), lane_abs(toward.y)), lane_abs(toward.z));
    return normalized(Vec3<F>{toward.x / most, toward.y / most, toward.z / most});
  }

  // Vertex normals, turned to the side of Nv: all that lies between them is on the side on which they are. Whether that is
  // sure of each: it is off by less than 8 u |normal| |toward|, and so is what surface_at() makes of one between them.
  Mask<F> see_normals(std::size_t r, const Vec3<F>& toward) {
    const Vec3<F> n0 = vertex_normals(r, 0), n1 = vertex_normals(r, 1), n2 = vertex_normals(r, 2);
    const Mask<F> flat = (l1_norm(n0) + l1_norm(n1)) + l1_norm(n2) == F(0);
    const bool any_flat = any<F>(flat);
    const F side = dot(n0, toward), turn = select<F>(side < F(0), F(-1), F(1));
    const F apart = lane_min(lane_min(turn * side, turn * dot(n1, toward)), turn * dot(n2, toward));
    const Mask<F> sure = apart > F(0x1p-46) * l1_norm(toward);
    Vec3<F> turned = turn * n0;
    Vec3<F> to1 = turn * n1 - turned, to2 = turn * n2 - turned;
    if (any_flat || batch_.want_leaving) {
      const Vec3<F> facing_here = facing(toward);
      if (batch_.want_leaving) store_rows<F>(facing_here, runs_.facing, r);
      turned = select<F>(flat, facing_here, turned);
      const Vec3<F> nothing{F(0), F(0), F(0)};
      to1 = select<F>(flat, nothing, to1);
      to2 = select<F>(flat, nothing, to2);
    }
    store_rows<F>(turned, runs_.normal, r);
    store_rows<F>(to1, runs_.to_normal1, r);
    store_rows<F>(to2, runs_.to_normal2, r);
    runs_.smooth[r] = smooth_ || any<F>(l1_norm(to1) + l1_norm(to2) > F(0));
    if (!runs_.smooth[r]) put_one_normal(r, turned);
    return sure || flat;
  }

  // N of triangles in which it does not change: what interpolate() and make_unit() would make of it.
  void put_one_normal(std::size_t r, const Vec3<F>& normal) {
    const Vec3<F> without_sign = normal + Vec3<F>{F(0), F(0), F(0)};  // of zeros
    const auto unit = normalized(to_floats(without_sign));
    store_rows<F>(Vec3<F>{to_double<F>(unit.x), to_double<F>(unit.y), to_double<F>(unit.z)},
                  runs_.unit_rounded, r);
    if (batch_.want_leaving) store_rows<F>(normalized(without_sign), runs_.unit, r);
  }

  // ---- The samples ----

  // visit(first sample, which run each lane is of).
  template <class Visit>
  void for_each_vector(const Visit& visit) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch_.size); i += kCount)
      if (batch_.run[i] == batch_.run[i + kCount - 1])
        visit(i, OneEntry<F>(batch_.run[i]));
      else
        visit(i, AscendingLanes<F>(&batch_.run[i]));
  }

  template <class OfRun>
  void locate(std::size_t i, const OfRun& of_run) {
    const Vec3<F> d = SurfaceLanes<F>(batch_, i).direction(view_);
    if (batch_.shiny) store_rows(to_floats(d), out_.to_viewer, i);
    std::array<F, 3> e;
    for (std::size_t k = 0; k < 3; ++k) e[k] = fused_dot(d, of_run.vector(runs_.edge[k]));
    const F all = (e[0] + e[1]) + e[2], size_of_d = batch_.own_rays ? l1_norm(d) : F(view_.longest);
    Mask<F> sure = all >= size_of_d * of_run(runs_.least_sum.data());
    for (F& each : e) each = lane_max(F(0), each);  // what rounding gave the other sign is 0
    const F per_sum = F(1) / ((e[0] + e[1]) + e[2]);
    store(e[1] * per_sum, &b1_[i]);
    store(e[2] * per_sum, &b2_[i]);
    if (batch_.want_t && !batch_.has_t) find_depth(i, of_run, d, size_of_d, sure);
    SurfaceLanes<F>(batch_, i).put_doubt(sure);
  }

  // b1 and b2 along the ways from what is at vertex 0.
  template <class OfRun>
  Vec3<F> between(std::size_t i, const OfRun& of_run, const TriangleRuns::Vectors& at0,
                  const TriangleRuns::Vectors& to1, const TriangleRuns::Vectors& to2) const {
    const F b1 = load<F>(&b1_[i]), b2 = load<F>(&b2_[i]);
    return fused<F>(b2, of_run.vector(to2), fused<F>(b1, of_run.vector(to1), of_run.vector(at0)));
  }

  template <class OfRun>
  void place(std::size_t i, const OfRun& of_run) {
    const Vec3<F> scaled = between(i, of_run, runs_.v0, runs_.e1, runs_.e2);
    put_position(scaled, out_, i);
    if (!batch_.want_leaving) return;
    const Vec3<F> facing_here = of_run.vector(runs_.facing);
    SurfaceLanes<F>(batch_, i).put_leaving(F(1 / view_.length_scale) * scaled, facing_here,
                                           of_run(runs_.clearance.data()));
    store_rows(to_floats(facing_here), out_.facing, i);
  }

  template <class OfRun>
  void interpolate(std::size_t i, const OfRun& of_run) {
    const Vec3<F> normal = between(i, of_run, runs_.normal, runs_.to_normal1, runs_.to_normal2);
    store_rows(to_floats(normal), out_.normal, i);
    if (batch_.want_leaving) SurfaceLanes<F>(batch_, i).put_normal(normalized(normal));
  }
  template <class OfRun>
  void copy_normal(std::size_t i, const OfRun& of_run) {
    store_rows(to_floats(of_run.vector(runs_.unit_rounded)), out_.normal, i);
    if (batch_.want_leaving) SurfaceLanes<F>(batch_, i).put_normal(of_run.vector(runs_.unit));
  }

  // |d| 4 sqrt(S T) <= 2^31 |d . n| iff |d|² S T <= 2^58 (d . n)²; 2^57 for the rounding of the bound.
  template <class OfRun>
  void find_depth(std::size_t i, const OfRun& of_run, const Vec3<F>& d, const F& size_of_d, Mask<F>& sure) {
    const F d_n = dot(d, of_run.vector(runs_.n));
    const F t = of_run(runs_.a0_n.data()) / d_n;
    sure = sure && t > F(0) &&
           (size_of_d * size_of_d) * of_run(runs_.depth_bound.data()) <= F(0x1p57) * (d_n * d_n);
    SurfaceLanes<F>(batch_, i).put_t(t);
  }

  const SurfaceView& view_;
  SurfaceBatch& batch_;
  ShadingBatch& out_;
  bool smooth_ = false;  // whether N changes within a triangle of the batch
  TriangleRuns& runs_;
  alignas(64) SurfaceBatch::Channel<double> b1_, b2_;  // barycentrics
};

}  // namespace sidelight
