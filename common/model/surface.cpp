// SPDX-License-Identifier: MIT
#include "common/model/surface.h"

namespace sidelight {
namespace {

// The interpolated vertex normal, unnormalised; zero for flat faces, spheres and planes.
glm::dvec3 interpolated_normal(const Scene& scene, std::uint32_t primitive, const Place& place) {
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  if (ref.kind != ObjectKind::mesh) return glm::dvec3(0);
  const Triangle& triangle = scene.triangles[ref.index];
  if (triangle.normal[0] == kNone) return glm::dvec3(0);
  const auto part = [&](std::size_t k) { return place.barycentric[k] * scene.normals[triangle.normal[k]]; };
  return (part(0) + part(1)) + part(2);
}

}  // namespace

Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit, SignCounts& counts) {
  const Place place = locate(scene, ray, hit, counts);
  Surface surface{place};
  surface.object = scene.primitive_object[hit.primitive];
  surface.material = primitive_material(scene, hit.primitive);

  const glm::dvec3 smooth = interpolated_normal(scene, hit.primitive, place);
  const double side = glm::dot(smooth, surface.facing);  // 0 for a zero normal too
  surface.normal = side == 0 ? surface.facing : glm::normalize(side < 0 ? -smooth : smooth);
  return surface;
}

}  // namespace sidelight
