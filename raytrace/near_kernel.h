// SPDX-License-Identifier: MIT
// Which primitives of a leaf may stand near a point in the sense of stands_near() (place.h): filters over lanes D of
// doubles. They ask its quick questions with a distance that is at least its own, nearness() of the whole hierarchy, so
// what they drop it would drop; what is left is asked there. Included by the kernels (kernels_in_lanes.h) and by
// ball_clearings.cpp only.
#pragma once

#include "common/math/lane_ops.h"
#include "common/math/vec.h"
#include "raytrace/leaves.h"

namespace sidelight::raytrace {

// may_be_near() of place.cpp: box, plane and edges. A bit each for the lanes from `leaf` on; `asked` are those that matter.
template <class D>
[[gnu::always_inline]] inline std::uint32_t near_bits(const TriangleLeaves&, const double* leaf,
                                                      std::uint32_t count, std::uint32_t asked,
                                                      const glm::dvec3& point, double distance) {
  const Vec3<D> p = wide<D>(point);
  const D room(distance);
  const Vec3<D> v0 = load_corner<D>(leaf, count, 0), v1 = load_corner<D>(leaf, count, 1),
                v2 = load_corner<D>(leaf, count, 2);
  const auto outside = [&](const D& x, const D& a, const D& b, const D& c) __attribute__((always_inline)) {
    return x < lane_min<D>(a, lane_min<D>(b, c)) - room || x > lane_max<D>(a, lane_max<D>(b, c)) + room;
  };
  const Mask<D> in_box =
      !(outside(p.x, v0.x, v1.x, v2.x) || outside(p.y, v0.y, v1.y, v2.y) || outside(p.z, v0.z, v1.z, v2.z));
  if ((mask_bits<D>(in_box) & asked) == 0) return 0;

  const Vec3<D> e1 = v1 - v0, e2 = v2 - v0, q = p - v0, n = cross(e1, e2);
  const D area = l1_norm(e1) * l1_norm(e2), rounding(0x1p-48);
  const Mask<D> off_plane = lane_abs<D>(dot(q, n)) > D(2) * room * l1_norm(n) + rounding * l1_norm(q) * area;
  const auto beyond = [&](const Vec3<D>& a, const Vec3<D>& b) {
    const Vec3<D> edge = b - a, from_a = p - a;
    return dot(cross(edge, from_a), n) < -(D(2) * room + rounding * l1_norm(from_a)) * l1_norm(edge) * area;
  };
  return mask_bits<D>(in_box && !(off_plane || beyond(v0, v1) || beyond(v1, v2) || beyond(v2, v0)));
}

// Whether a point, seen from the center of a sphere, lies within twice the distance of its surface. (Nearness allows ten
// clearances and more; the height's own rounding is one.)
template <class D>
[[gnu::always_inline]] inline Mask<D> is_near_sphere(const Vec3<D>& from_center, const D& radius,
                                                     double distance) {
  const D room(2 * distance), square = dot(from_center, from_center);
  const D least = lane_max<D>(radius - room, D(0)), most = radius + room;
  return square >= least * least && square <= most * most;
}

template <class D>
[[gnu::always_inline]] inline std::uint32_t near_bits(const SphereLeaves&, const double* leaf,
                                                      std::uint32_t count, std::uint32_t,
                                                      const glm::dvec3& point, double distance) {
  const Vec3<D> from_center = wide<D>(point) - load_corner<D>(leaf, count);
  return mask_bits<D>(is_near_sphere<D>(from_center, load<D>(leaf + 3 * count), distance));
}

// How far a triangle T must be inset to keep away from others. Of T's points with barycentric weights of at least m, along
// an axis a,
//   a . p >= low + m gain, low the least of its three corners' a . v, gain = sum - 3 low
// and another triangle's a . o <= high. Where the difference is more than the room, the two are apart: the least such m
// of some axes. What is on T's far side of an edge is told by the edge's normal, what shares an edge or a corner and rises
// from there by its own normal, what lies above or below by T's. Any axis will do, so its own rounding is none; that of
// products and of corners relative to T's is below 2^-46 of what is near, and the room is greater than that by far.
template <class D>
class InsetFilter {
 public:
  InsetFilter(const Corners& own, double room) : origin_(own.v0), room_(room) {
    const std::array<glm::dvec3, 3> v{glm::dvec3(0), own.v1 - own.v0, own.v2 - own.v0};
    low_ = glm::min(own.v0, glm::min(own.v1, own.v2)) - 2 * room;
    high_ = glm::max(own.v0, glm::max(own.v1, own.v2)) + 2 * room;
    const glm::dvec3 n = glm::cross(v[1], v[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      own_[k] = wide<D>(v[k]);
      axes_[k] = glm::cross(n, v[(k + 1) % 3] - v[k]);
    }
    axes_[3] = n;
    axes_[4] = -n;
  }

  // The box in which others matter.
  const glm::dvec3& low() const { return low_; }
  const glm::dvec3& high() const { return high_; }

  // For each of the triangles from `leaf` on, 1 where none is enough.
  D operator()(const double* leaf, std::uint32_t count) const {
    const auto corner = [&](std::uint32_t k) { return load_corner<D>(leaf, count, k) - wide<D>(origin_); };
    const Vec3<D> v0 = corner(0), v1 = corner(1), v2 = corner(2);
    const auto along = [&](const Vec3<D>& axis) __attribute__((always_inline)) {
      const D a = dot(axis, own_[0]), b = dot(axis, own_[1]), c = dot(axis, own_[2]);
      const D high = lane_max<D>(dot(axis, v0), lane_max<D>(dot(axis, v1), dot(axis, v2)));
      const D low = lane_min<D>(a, lane_min<D>(b, c)), gain = ((a + b) + c) - D(3) * low;
      const D need = D(room_) * l1_norm(axis) - (low - high);
      const Mask<D> enough = gain > D(3) * need;
      return select<D>(need < D(0), D(0), select<D>(enough, need / select<D>(enough, gain, D(1)), D(1)));
    };
    const Vec3<D> n = cross(v1 - v0, v2 - v0);
    D inset = lane_min<D>(along(n), along(-n));
    for (const glm::dvec3& axis : axes_) inset = lane_min<D>(inset, along(wide<D>(axis)));
    return inset;
  }

 private:
  glm::dvec3 origin_, low_, high_;
  double room_;
  std::array<Vec3<D>, 3> own_;
  std::array<glm::dvec3, 5> axes_;
};

}  // namespace sidelight::raytrace
