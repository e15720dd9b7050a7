// SPDX-License-Identifier: MIT
#include "common/model/surface.h"

namespace sidelight {
namespace {

// The interpolated vertex normal times `turn` (1 or -1), unnormalised.
glm::dvec3 interpolated(const Scene& scene, const Triangle& triangle, const Place& place, double turn) {
  const auto corner = [&](std::size_t k) { return turn * scene.normals[triangle.normal[k]]; };
  const glm::dvec3 n0 = corner(0);
  return between(place, n0, corner(1) - n0, corner(2) - n0);
}

// N before it has unit length, of a triangle. (A flat one's is interpolated too, in lanes: no zero of it is negative.)
glm::dvec3 smooth_normal(const Scene& scene, const Triangle& triangle, const Place& place) {
  const glm::dvec3 flat = place.facing + glm::dvec3(0);
  if (triangle.normal[0] == kNone) return flat;
  const double side = glm::dot(interpolated(scene, triangle, place, 1), place.facing);
  return side == 0 ? flat : interpolated(scene, triangle, place, side < 0 ? -1 : 1);
}

}  // namespace

Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit, VisibilityCounts& counts) {
  Surface surface{locate(scene, ray, hit, counts)};
  surface.object = scene.primitive_object[hit.primitive];
  surface.material = primitive_material(scene, hit.primitive);
  surface.normal = surface.smooth = surface.facing;
  const PrimitiveRef ref = primitive_ref(scene, hit.primitive);
  if (ref.kind != ObjectKind::mesh) return surface;
  surface.smooth = smooth_normal(scene, scene.triangles[ref.index], surface);
  surface.normal = glm::normalize(surface.smooth);
  return surface;
}

}  // namespace sidelight
