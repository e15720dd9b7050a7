// SPDX-License-Identifier: MIT
#include "common/model/visibility_float.h"

#include <algorithm>
#include <cmath>

#include "common/model/place.h"

namespace sidelight {
namespace {

using glm::vec3;

// Whether shading may use the place: it extrapolates from the triangle, here by at most 10^6 of its sizes, which keeps
// every square in float.
bool placeable(const Place& place) {
  return std::all_of(place.barycentric.begin(), place.barycentric.end(),
                     [](double b) { return std::abs(b) < 1e6; });
}

}  // namespace

Hit intersect_in_float(const Scene& scene, std::uint32_t primitive, const Ray& ray, const Hit& after,
                       VisibilityCounts& counts) {
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  if (ref.kind != ObjectKind::mesh) return intersect(scene, primitive, ray, after, counts);
  ++counts.tests;
  const Triangle& triangle = scene.triangles[ref.index];
  if (triangle.degenerate) return {};

  const vec3 origin(ray.origin), d(ray.direction);
  const auto corner = [&](std::size_t k) { return vec3(scene.positions[triangle.vertex[k]]) - origin; };
  const vec3 a0 = corner(0), a1 = corner(1), a2 = corner(2);
  const vec3 n = glm::cross(a1 - a0, a2 - a0);
  const float side = glm::dot(a0, n);
  const float e0 = glm::dot(d, glm::cross(a1, a2)), e1 = glm::dot(d, glm::cross(a2, a0)),
              e2 = glm::dot(d, glm::cross(a0, a1));
  const bool front = e0 <= 0 && e1 <= 0 && e2 <= 0 && side < 0,
             back = e0 >= 0 && e1 >= 0 && e2 >= 0 && side > 0;
  if (!front && !back) return {};

  const Hit hit{double{side / glm::dot(d, n)}, primitive};
  if (!std::isfinite(hit.t) || !before(after, hit)) return {};
  return placeable(locate(scene, ray, hit, counts)) ? hit : Hit{};
}

}  // namespace sidelight
