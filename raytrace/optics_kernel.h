// SPDX-License-Identifier: MIT
// reflect_direction() and refract_direction() over lanes D of doubles: the same operations in the same order. Included by
// the kernels only (kernels_in_lanes.h).
#pragma once

#include "common/math/lane_ops.h"
#include "common/math/vec.h"
#include "raytrace/optics_batch.h"

namespace sidelight::raytrace {

// Turned over about Nv where its height above the surface is wrong.
template <class D>
[[gnu::always_inline]] inline Vec3<D> folded(const Vec3<D>& v, const Vec3<D>& facing, const D& height,
                                             const Mask<D>& wrong) {
  return select<D>(wrong, v - D(2) * height * facing, v);
}

// As make_ray() does it.
template <class D>
[[gnu::always_inline]] inline D without_dust(const D& x) {
  return select<D>(lane_abs<D>(x) < D(1e-100), D(0), x);
}

template <class D>
[[gnu::flatten]] void directions_in_lanes(OpticsBatch& batch) {
  for (std::size_t i = 0; i < batch.size; i += kLanes<D>) {
    const auto vector = [&](const SurfaceBatch::Vectors& from) {
      return Vec3<D>{load<D>(&from[0][i]), load<D>(&from[1][i]), load<D>(&from[2][i])};
    };
    const auto keep = [&](const Vec3<D>& v, SurfaceBatch::Vectors& to) {
      store<D>(without_dust<D>(v.x), &to[0][i]);
      store<D>(without_dust<D>(v.y), &to[1][i]);
      store<D>(without_dust<D>(v.z), &to[2][i]);
    };
    const Vec3<D> d = normalized<D>(vector(batch.direction)), n = vector(batch.normal),
                  nv = vector(batch.facing);
    const D along = dot(d, n);

    const Vec3<D> r = d - D(2) * along * n;
    const D above = dot(r, nv);
    keep(normalized<D>(folded<D>(r, nv, above, above < D(0))), batch.mirrored);

    const D eta = load<D>(&batch.eta[i]);
    const Mask<D> refracts = eta != D(OpticsBatch::kNoRefraction);
    if (!any<D>(refracts)) continue;
    const Vec3<D> normal = select<D>(along < D(0), n, nv);
    const D cos_i = -dot(d, normal);
    const Vec3<D> tangential = d + cos_i * normal;
    const D radicand = D(1) - eta * eta * dot(tangential, tangential);
    const Mask<D> straight = eta == D(1), total = radicand < D(0) && !straight;
    const Vec3<D> t = eta * tangential - square_root(lane_max<D>(radicand, D(0))) * normal;
    const D beyond = dot(t, nv);
    const Vec3<D> bent = normalized<D>(folded<D>(t, nv, beyond, beyond > D(0)));
    keep(select<D>(straight, d, bent), batch.refracted);
    store<D>(select<D>(total, D(1), D(0)), &batch.total[i]);
  }
}

}  // namespace sidelight::raytrace
