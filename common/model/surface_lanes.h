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

template <class F>
Vec3<F> wide(const Vec3<double>& v) {
  return {F(v.x), F(v.y), F(v.z)};
}
template <class F>
Vec3<F> absolute(const Vec3<F>& v) {
  return {lane_abs(v.x), lane_abs(v.y), lane_abs(v.z)};
}

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
  std::uint32_t index(int lane) const {
    return batch_.index[batch_.run[first_ + static_cast<std::size_t>(lane)]];
  }
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

template <class Floats>
void put(const Vec3<Floats>& v, ShadingBatch::Rgb& to, std::size_t i) {
  store(v.x, &to[0][i]);
  store(v.y, &to[1][i]);
  store(v.z, &to[2][i]);
}
template <class F>
auto rounded(const Vec3<F>& v) {
  using Floats = decltype(to_float(v.x));
  return Vec3<Floats>{to_float(v.x), to_float(v.y), to_float(v.z)};
}

// Gives the length `length` (1 or -1) to what has been rounded, as unit_rounded() does; what it does otherwise is doubtful.
// F: floats.
template <class F>
void make_unit(ShadingBatch::Rgb& vectors, const F& length, SurfaceBatch& batch) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); i += kLanes<F>) {
    const Vec3<F> v{load<F>(&vectors[0][i]), load<F>(&vectors[1][i]), load<F>(&vectors[2][i])};
    const F length2 = dot(v, v);
    put((length / square_root(length2)) * v, vectors, i);
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
  put(rounded(scaled), out.high, i);
  put(rounded(Vec3<F>{above(scaled.x), above(scaled.y), above(scaled.z)}), out.low, i);
}
// N and -V are left to make_unit().
template <class F>
void put_point(const SurfaceView& view, const Vec3<F>& point, const Vec3<F>& normal, const Vec3<F>& direction,
               ShadingBatch& out, std::size_t i) {
  put_position(F(view.length_scale) * point, out, i);
  put(rounded(normal), out.normal, i);
  put(rounded(direction), out.to_viewer, i);
}

}  // namespace sidelight
