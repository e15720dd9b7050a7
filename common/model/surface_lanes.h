// SPDX-License-Identifier: MIT
// How the lanes of surface_kernel.h read a SurfaceBatch, and write what they find into it and a ShadingBatch.
#pragma once

#include "common/math/lane_ops.h"
#include "common/math/vec.h"
#include "common/model/surface_batch.h"

namespace sidelight {

struct SurfaceView {
  Vec3<double> eye, right, up, axis;  // of the camera
  double length_scale = 1;            // of the shading tables
};

template <class F>
Vec3<F> wide(const Vec3<double>& v) {
  return {F(v.x), F(v.y), F(v.z)};
}
template <class F>
F size(const Vec3<F>& v) {
  return (lane_abs(v.x) + lane_abs(v.y)) + lane_abs(v.z);
}
template <class F>
Vec3<F> absolute(const Vec3<F>& v) {
  return {lane_abs(v.x), lane_abs(v.y), lane_abs(v.z)};
}
// As glm::normalize: by the reciprocal of the length.
template <class F>
Vec3<F> normalized(const Vec3<F>& v) {
  return (F(1) / square_root(dot(v, v))) * v;
}

// V
template <class F>
Vec3<F> to_viewer(const Vec3<F>& direction) {
  return (F(-1) / square_root(dot(direction, direction))) * direction;
}

// ---- From and to the batches ----

template <class F>
class SurfaceLanes {
 public:
  SurfaceLanes(SurfaceBatch& batch, std::size_t first) : batch_(batch), first_(first) {}

  const SurfaceBatch::Group& group() const { return batch_.group[first_ / SurfaceBatch::kGroup]; }
  F scene_number(std::size_t vector, std::size_t component) const {
    const auto& channel = batch_.vector[vector][component];
    return group().one ? F(channel[group().first]) : load<F>(&channel[first_]);
  }
  Vec3<F> scene_vector(std::size_t i) const {
    return {scene_number(i, 0), scene_number(i, 1), scene_number(i, 2)};
  }
  Vec3<F> origin(const SurfaceView& view) const {
    return batch_.own_rays ? own(batch_.origin) : wide<F>(view.eye);
  }
  void direction(const SurfaceView& view, Vec3<F>& to) const {
    if (batch_.own_rays) {
      to = own(batch_.direction);
    } else {
      const F column = load<F>(&batch_.column[first_]), row = load<F>(&batch_.row[first_]);
      to = (column * wide<F>(view.right) + row * wide<F>(view.up)) + wide<F>(view.axis);
    }
  }
  F given_t() const { return load<F>(&batch_.t[first_]); }
  void put_t(const F& t) { store(t, &batch_.t[first_]); }
  bool wants_leaving() const { return batch_.want_leaving; }
  void put_leaving(const Vec3<F>& point, const Vec3<F>& facing, const F& clearance) {
    put(point, batch_.point);
    put(facing, batch_.facing);
    store(clearance, &batch_.clearance[first_]);
  }
  void put_normal(const Vec3<F>& normal) { put(normal, batch_.normal); }
  void put_doubt(const Mask<F>& sure) {
    store(select<F>(sure, F(0), F(1)), &batch_.doubtful[first_]);
    if constexpr (kLanes<F> == 1)
      batch_.any_doubtful |= !sure;
    else
      batch_.any_doubtful |= !stdx::all_of(sure);
  }

 private:
  Vec3<F> own(const SurfaceBatch::Vectors& from) const {
    return {load<F>(&from[0][first_]), load<F>(&from[1][first_]), load<F>(&from[2][first_])};
  }
  void put(const Vec3<F>& v, SurfaceBatch::Vectors& to) {
    store(v.x, &to[0][first_]);
    store(v.y, &to[1][first_]);
    store(v.z, &to[2][first_]);
  }

  SurfaceBatch& batch_;
  std::size_t first_;
};

template <class F>
void put_rounded(const Vec3<F>& v, ShadingBatch::Rgb& to, std::size_t i) {
  store(to_float(v.x), &to[0][i]);
  store(to_float(v.y), &to[1][i]);
  store(to_float(v.z), &to[2][i]);
}

// shading_point()
template <class F>
void put_position(const SurfaceView& view, const Vec3<F>& point, ShadingBatch& out, std::size_t i) {
  const Vec3<F> scaled = F(view.length_scale) * point;
  const auto above = [](const F& x) { return x - to_double<F>(to_float(x)); };
  put_rounded(scaled, out.high, i);
  put_rounded(Vec3<F>{above(scaled.x), above(scaled.y), above(scaled.z)}, out.low, i);
}
template <class F>
void put_point(const SurfaceView& view, const Vec3<F>& point, const Vec3<F>& normal, const Vec3<F>& direction,
               bool shiny, ShadingBatch& out, std::size_t i) {
  put_position(view, point, out, i);
  put_rounded(normal, out.normal, i);
  if (shiny) put_rounded(to_viewer(direction), out.to_viewer, i);
}

}  // namespace sidelight
