// SPDX-License-Identifier: MIT
#include "common/model/solid.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/visibility.h"

namespace sidelight {
namespace {

double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double numerator = glm::dot(a, glm::cross(b, c));
  const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2 * std::atan2(numerator, denominator);
}

}  // namespace

bool contains(const Scene& scene, const Object& solid, const glm::dvec3& point) {
  if (solid.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene.spheres[solid.first];
    const glm::dvec3 f = point - sphere.center;
    return glm::dot(f, f) < sphere.radius * sphere.radius;
  }
  if (solid.kind == ObjectKind::plane) {
    const Plane& plane = scene.planes[solid.first];
    return glm::dot(plane.normal, point - plane.point) < 0;
  }
  double angle = 0;
  for (std::uint32_t i = solid.first; i < solid.first + solid.count; ++i) {
    const auto [v0, v1, v2] = corners(scene, scene.triangles[i]);
    angle += solid_angle(v0 - point, v1 - point, v2 - point);
  }
  return angle > 6.283185307179586;  // half of the full 4 pi: inside a mesh wound outward
}

}  // namespace sidelight
