// SPDX-License-Identifier: MIT
// ray_batches.h over lanes D of doubles. Included by the kernels only (kernels_in_lanes.h).
#pragma once

#include "common/math/lane_ops.h"
#include "common/math/vec.h"
#include "raytrace/ray_batches.h"

namespace sidelight::raytrace {

// Turned over about Nv where its height above the surface is wrong.
template <class D>
[[gnu::always_inline]] inline Vec3<D> folded(const Vec3<D>& v, const Vec3<D>& facing, const D& height,
                                             const Mask<D>& wrong) {
  return select<D>(wrong, v - D(2) * height * facing, v);
}

// As make_ray() does it.
template <class D>
[[gnu::always_inline]] inline Vec3<D> without_dust(const Vec3<D>& v) {
  const auto each = [](const D& x) { return select<D>(lane_abs<D>(x) < D(1e-100), D(0), x); };
  return {each(v.x), each(v.y), each(v.z)};
}

// reflect_direction() and refract_direction(): the same operations in the same order.
template <class D>
[[gnu::flatten]] void directions_in_lanes(OpticsBatch& batch) {
  for (std::size_t i = 0; i < batch.size; i += kLanes<D>) {
    const Vec3<D> d = normalized<D>(load_rows<D>(batch.direction, i)), n = load_rows<D>(batch.normal, i),
                  nv = load_rows<D>(batch.facing, i);
    const D along = dot(d, n);

    const Vec3<D> r = d - D(2) * along * n;
    const D above = dot(r, nv);
    store_rows(without_dust(normalized<D>(folded<D>(r, nv, above, above < D(0)))), batch.mirrored, i);

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
    store_rows(without_dust(select<D>(straight, d, bent)), batch.refracted, i);
    store<D>(select<D>(total, D(1), D(0)), &batch.total[i]);
  }
}

// sphere_roots(), and what intersect() makes of them, likewise.
template <class D>
[[gnu::flatten]] void own_hits_in_lanes(BallBatch& batch) {
  using I = Ints<D>;
  const D infinity(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < batch.size; i += kLanes<D>) {
    const Vec3<D> d = load_rows<D>(batch.direction, i);
    const Vec3<D> f = load_rows<D>(batch.origin, i) - load_rows<D>(batch.center, i);
    const D radius = load<D>(&batch.radius[i]), r2 = radius * radius;
    const D dd = dot(d, d), b = -dot(f, d);
    const Vec3<D> nearest = f + (b / dd) * d;
    const D discriminant = r2 - dot(nearest, nearest);
    const Mask<D> meets = discriminant >= D(0);
    const D root = square_root(dd * select<D>(meets, discriminant, D(0)));
    const I sign = to_bits<D>(b) & to_bits<D>(D(-0.0));
    const D q = b + from_bits<D>(to_bits<D>(root) | sign);
    const Mask<D> apart = meets && q != D(0);
    const D t0 = (dot(f, f) - r2) / select<D>(apart, q, D(1)), t1 = q / dd;
    const D low = select<D>(t0 <= t1, t0, t1), high = select<D>(t0 <= t1, t1, t0);

    const Mask<D> low_counts = apart && low > D(0) && low < infinity;
    const Mask<D> high_counts = apart && high > D(0) && high < infinity;
    const Mask<D> passes = load<D>(&batch.passes[i]) != D(0);
    const D first = select<D>(low_counts, low, select<D>(high_counts, high, infinity));
    const D second = select<D>(low_counts && high_counts && high > low, high, infinity);
    store<D>(select<D>(passes, second, first), &batch.t[i]);
  }
}

}  // namespace sidelight::raytrace
