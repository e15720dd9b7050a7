// SPDX-License-Identifier: MIT
// sphere_roots(), and what intersect() makes of them, over lanes D of doubles: the same operations in the same order.
// Included by the kernels only (kernels_in_lanes.h).
#pragma once

#include "common/math/lane_ops.h"
#include "common/math/vec.h"
#include "raytrace/ball_batch.h"

namespace sidelight::raytrace {

template <class D>
[[gnu::flatten]] void own_hits_in_lanes(BallBatch& batch) {
  using I = Ints<D>;
  const D infinity(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < batch.size; i += kLanes<D>) {
    const auto vector = [&](const SurfaceBatch::Vectors& from) {
      return Vec3<D>{load<D>(&from[0][i]), load<D>(&from[1][i]), load<D>(&from[2][i])};
    };
    const Vec3<D> d = vector(batch.direction), f = vector(batch.origin) - vector(batch.center);
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
