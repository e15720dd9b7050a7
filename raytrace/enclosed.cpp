// SPDX-License-Identifier: MIT
#include "raytrace/enclosed.h"

#include <algorithm>

namespace sidelight::raytrace {

bool shuts_in(const Scene& scene, const Object& solid) {
  if (solid.kind == ObjectKind::plane) return false;
  for (std::uint32_t i = 0; i < solid.count; ++i) {
    if (!casts_shadow(scene, solid.first_primitive + i)) return false;
    if (solid.kind == ObjectKind::mesh && scene.triangles[solid.first + i].degenerate) return false;
  }
  return true;
}

// Along the axis that tells them apart, what is within is at most 16/17 of the way to the light; depths of visibility.h
// are good to 2^-18.
bool is_outside(const Bounds& bounds, const Light& light) {
  if (light.directional) return true;
  const glm::dvec3 size = bounds.high - bounds.low;
  const double room = std::max({size.x, size.y, size.z}) / 16;
  for (int i = 0; i < 3; ++i)
    if (light.position[i] < bounds.low[i] - room || light.position[i] > bounds.high[i] + room) return true;
  return false;
}

std::uint32_t Enclosures::around(const glm::dvec3& from, const Media& media, bool lone) const {
  const std::uint32_t current = media.current();
  if (current == kNone) return kNone;
  const Object& object = prepared_.scene.objects[current];
  if (object.kind == ObjectKind::plane) return kNone;
  if (object.kind == ObjectKind::sphere) {
    // Beyond the rounding of sphere_roots(), which then finds one root on either side of the point.
    const Sphere& sphere = prepared_.scene.spheres[object.first];
    const glm::dvec3 f = from - sphere.center;
    if (!(glm::dot(f, f) < sphere.radius * sphere.radius * (1 - 0x1p-49))) return kNone;
  } else if (!lone || !media.certain()) {
    return kNone;
  }
  return static_cast<std::uint32_t>(prepared_.place_of(current));
}

}  // namespace sidelight::raytrace
