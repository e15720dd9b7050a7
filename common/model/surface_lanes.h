// SPDX-License-Identifier: MIT
// How the lanes of surface_kernel.h read a SurfaceBatch, and write what they find into it and a ShadingBatch.
#pragma once

#include "common/math/lane_vectors.h"
#include "common/math/vec.h"
#include "common/model/surface_batch.h"

namespace sidelight {

struct SurfaceView {
  const Scene& scene;
  Vec3<double> eye, right, up, axis;  // of the camera
  double longest = 0;                 // l1_norm() of no eye ray's direction is more
  double length_scale = 1;            // of the shading tables: a power of two, so that nothing is rounded
};

// ---- From and to the batches ----

template <class F>
class SurfaceLanes {
 public:
  SurfaceLanes(SurfaceBatch& batch, std::size_t first) : batch_(batch), first_(first) {}

  // of(index) of the primitives at hand: a vector of the scene, or a number.
  template <class Of>
  Vec3<F> scene_vector(const Of& of) const {
    return load_vectors<F>([&](int lane) { return &of(index(lane)).x; });
  }
  template <class Of>
  F scene_number(const Of& of) const {
    return generate<F>([&](int lane) { return of(index(lane)); });
  }
  Vec3<F> origin(const SurfaceView& view) const {
    return batch_.own_rays ? load_rows<F>(batch_.origin, first_) : wide<F>(view.eye);
  }
  Vec3<F> direction(const SurfaceView& view) const {
    if (batch_.own_rays) return load_rows<F>(batch_.direction, first_);
    const F column = load<F>(&batch_.column[first_]), row = load<F>(&batch_.row[first_]);
    return (column * wide<F>(view.right) + row * wide<F>(view.up)) + wide<F>(view.axis);
  }
  F given_t() const { return load<F>(&batch_.t[first_]); }
  void put_t(const F& t) { store(t, &batch_.t[first_]); }
  bool wants_leaving() const { return batch_.want_leaving; }
  void put_leaving(const Vec3<F>& point, const Vec3<F>& facing, const F& clearance) {
    store_rows<F>(point, batch_.point, first_);
    store_rows<F>(facing, batch_.facing, first_);
    store(clearance, &batch_.clearance[first_]);
  }
  void put_normal(const Vec3<F>& normal) { store_rows<F>(normal, batch_.normal, first_); }
  void put_doubt(const Mask<F>& sure) {
    store(select<F>(sure, F(0), F(1)), &batch_.doubtful[first_]);
    if constexpr (kLanes<F> == 1)
      batch_.any_doubtful |= !sure;
    else
      batch_.any_doubtful |= !stdx::all_of(sure);
  }

 private:
  std::uint32_t index(int lane) const {
    return batch_.index[batch_.run[first_ + static_cast<std::size_t>(lane)]];
  }

  SurfaceBatch& batch_;
  std::size_t first_;
};

// Gives the length `length` (1 or -1) to what has been rounded, as unit_rounded() does; what it does otherwise is doubtful.
// F: floats.
template <class F>
void make_unit(ShadingBatch::Rgb& vectors, const F& length, SurfaceBatch& batch) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); i += kLanes<F>) {
    const Vec3<F> v = load_rows<F>(vectors, i);
    const F length2 = dot(v, v);
    store_rows<F>((length / square_root(length2)) * v, vectors, i);
    const Mask<F> odd = !(length2 >= F(kLeastPlain) && length2 <= F(kMostPlain));
    if (!any<F>(odd)) continue;
    batch.any_doubtful = true;
    const std::uint32_t bits = mask_bits<F>(odd);
    for (std::size_t lane = 0; lane < kLanes<F>; ++lane)
      if ((bits >> lane & 1) != 0) batch.doubtful[i + lane] = 1;
  }
}

// shading_point(), of a point in units of the shading tables.
template <class F>
void put_position(const Vec3<F>& scaled, ShadingBatch& out, std::size_t i) {
  const auto above = [](const F& x) { return x - to_double<F>(to_float(x)); };
  store_rows(to_floats(scaled), out.high, i);
  store_rows(to_floats(Vec3<F>{above(scaled.x), above(scaled.y), above(scaled.z)}), out.low, i);
}
// N and -V are left to make_unit().
template <class F>
void put_point(const SurfaceView& view, const Vec3<F>& point, const Vec3<F>& normal, const Vec3<F>& direction,
               ShadingBatch& out, std::size_t i) {
  put_position(F(view.length_scale) * point, out, i);
  store_rows(to_floats(normal), out.normal, i);
  store_rows(to_floats(direction), out.to_viewer, i);
}

}  // namespace sidelight
