// SPDX-License-Identifier: MIT
// Which primitives of a leaf may stand near a point in the sense of stands_near() (place.h): filters over lanes D of
// doubles. They ask its quick questions with a distance that is at least its own, nearness() of the whole hierarchy, so
// what they drop it would drop; what is left is asked there. Included by the kernels only (bvh_kernel.h).
#pragma once

#include "common/math/lane_ops.h"
#include "common/math/vec.h"
#include "raytrace/leaves.h"

namespace sidelight::raytrace {

template <class D>
[[gnu::always_inline]] inline D size_of(const Vec3<D>& v) {
  return (lane_abs<D>(v.x) + lane_abs<D>(v.y)) + lane_abs<D>(v.z);
}

// may_be_near() of place.cpp: box, plane and edges. A bit each for the lanes from `leaf` on; `asked` are those that matter.
template <class D>
[[gnu::always_inline]] inline std::uint32_t near_bits(const TriangleLeaves&, const double* leaf,
                                                      std::uint32_t count, std::uint32_t asked,
                                                      const glm::dvec3& point, double distance) {
  const Vec3<D> p{D(point.x), D(point.y), D(point.z)};
  const D room(distance);
  const auto corner = [&](std::uint32_t k) {
    const double* row = leaf + 3 * k * count;
    return Vec3<D>{load<D>(row), load<D>(row + count), load<D>(row + 2 * count)};
  };
  const Vec3<D> v0 = corner(0), v1 = corner(1), v2 = corner(2);
  const auto outside = [&](const D& x, const D& a, const D& b, const D& c) __attribute__((always_inline)) {
    return x < lane_min<D>(a, lane_min<D>(b, c)) - room || x > lane_max<D>(a, lane_max<D>(b, c)) + room;
  };
  const Mask<D> in_box =
      !(outside(p.x, v0.x, v1.x, v2.x) || outside(p.y, v0.y, v1.y, v2.y) || outside(p.z, v0.z, v1.z, v2.z));
  if ((mask_bits<D>(in_box) & asked) == 0) return 0;

  const Vec3<D> e1 = v1 - v0, e2 = v2 - v0, q = p - v0, n = cross(e1, e2);
  const D area = size_of(e1) * size_of(e2), rounding(0x1p-48);
  const Mask<D> off_plane = lane_abs<D>(dot(q, n)) > D(2) * room * size_of(n) + rounding * size_of(q) * area;
  const auto beyond = [&](const Vec3<D>& a, const Vec3<D>& b) {
    const Vec3<D> edge = b - a, from_a = p - a;
    return dot(cross(edge, from_a), n) < -(D(2) * room + rounding * size_of(from_a)) * size_of(edge) * area;
  };
  return mask_bits<D>(in_box && !(off_plane || beyond(v0, v1) || beyond(v1, v2) || beyond(v2, v0)));
}

// Whether the point lies within twice the distance of a sphere's surface. (Nearness allows ten clearances and more; the
// height's own rounding is one.)
template <class D>
[[gnu::always_inline]] inline std::uint32_t near_bits(const SphereLeaves&, const double* leaf,
                                                      std::uint32_t count, std::uint32_t,
                                                      const glm::dvec3& point, double distance) {
  const Vec3<D> f{D(point.x) - load<D>(leaf), D(point.y) - load<D>(leaf + count),
                  D(point.z) - load<D>(leaf + 2 * count)};
  const D radius = load<D>(leaf + 3 * count), room(2 * distance), square = dot(f, f);
  const D least = lane_max<D>(radius - room, D(0)), most = radius + room;
  return mask_bits<D>(square >= least * least && square <= most * most);
}

}  // namespace sidelight::raytrace
