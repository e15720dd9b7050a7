// SPDX-License-Identifier: MIT
// shadow_places.h for lane types D of doubles. Included by the kernels only (kernels_in_lanes.h).
#pragma once

#include <cstring>

#include "common/math/lane_ops.h"
#include "raytrace/shadow_places.h"

namespace sidelight::raytrace {

// Of a mask of doubles, that of the floats beside them.
template <class D>
auto beside(const Mask<D>& mask) {
  return to_float<D>(select<D>(mask, D(1), D(0))) > FloatBeside<D>(0);
}

// Which points lie behind a face: that of their greatest coordinate, the first of equals.
template <class D>
Mask<D> is_behind(const CubeFace& face, const std::array<D, 3>& p) {
  const D x = lane_abs<D>(p[0]), y = lane_abs<D>(p[1]), z = lane_abs<D>(p[2]);
  const Mask<D> first = x >= y && x >= z, second = !(x >= y) && y >= z;
  const Mask<D> on_axis = face.axis == 0 ? first : face.axis == 1 ? second : !(first || second);
  const D along = D(face.sign) * p[static_cast<std::size_t>(face.axis)];
  return on_axis && along >= D(CubeFace::kLeastDepth);
}

template <class D>
[[gnu::flatten]] std::size_t find_places_in_lanes(const ShadowQueries& queries, const CubeFace& face,
                                                  bool all, ShadowPlaces& places) {
  using F = FloatBeside<D>;
  using I = Ints<F>;
  const std::array<const double*, 3> from{queries.x.data(), queries.y.data(), queries.z.data()};
  const auto axis = static_cast<std::size_t>(face.axis);
  const I lanes = lane_numbers<I>();
  const D wide(CubeFace::kWide);
  std::size_t size = 0;
  for (std::size_t i = 0; i < queries.size(); i += kLanes<D>) {
    Mask<F> asks = real_mask<F>(load<I>(&queries.asks[i]) != I(0));
    if (!any<F>(asks)) continue;
    std::array<D, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = load<D>(from[k] + i) - D(face.light[static_cast<int>(k)]);
    const D depth = D(face.sign) * p[axis], per_depth = D(1) / depth;
    const D u = per_depth * p[(axis + 1) % 3], v = per_depth * p[(axis + 2) % 3];
    if (all) {
      const Mask<D> seen =
          depth >= D(CubeFace::kLeastDepth) && lane_abs<D>(u) <= wide && lane_abs<D>(v) <= wide;
      if (any<F>(asks && !beside<D>(seen))) return kNotSeen;
    } else {
      asks = asks && beside<D>(is_behind(face, p));
    }
    const auto put = [&](const D& x, std::vector<float>& to) {
      std::array<std::int32_t, kLanes<F>> bits;
      store_some<F>(asks, to_bits<F>(to_float<D>(x)), bits.data());
      std::memcpy(&to[size], bits.data(), sizeof bits);
    };
    put(u - D(face.middle_u), places.u);
    put(v - D(face.middle_v), places.v);
    put(per_depth, places.per_depth);
    store_some<F>(asks, load<I>(&queries.own[i]), &places.own[size]);
    size += store_some<F>(asks, lanes + I(static_cast<std::int32_t>(i)), &places.number[size]);
  }
  return size;
}

}  // namespace sidelight::raytrace
