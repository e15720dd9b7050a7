// SPDX-License-Identifier: MIT
#include "raytrace/secondary.h"

#include <optional>

#include "common/model/optics.h"

namespace sidelight::raytrace {

Shares shares_of(const Scene& scene, const Material& material) {
  const auto share = [](const glm::dvec3& c) { return Share{glm::vec3(c), largest(c)}; };
  const glm::dvec3 c2 = reflect_of(scene, material), c3 = refract_of(scene, material);
  return {share(c2), share(c3), share(c2 + c3)};
}

Departures departures(const Prepared& prepared, const Path& path, const Hit& hit, const Surface& surface,
                      const glm::dvec3& from, VisibilityCounts& counts) {
  const Scene& scene = prepared.scene;
  const Material& material = scene.materials[surface.material];
  const glm::dvec3 c2 = reflect_of(scene, material), c3 = refract_of(scene, material);
  Departures out;
  if (largest(c2) == 0 && largest(c3) == 0) return out;

  const glm::dvec3 d = glm::normalize(path.ray.direction);
  Path& mirrored = out.mirrored.path;
  mirrored = path;
  mirrored.kind = RayKind::mirrored;
  mirrored.ray = make_ray(from, reflect_direction(d, surface.normal, surface.facing));
  mirrored.start = kRayStart;
  out.mirrored.c = c2;
  if (largest(c3) == 0) return out;

  Path& refracted = out.refracted.path;
  refracted = path;
  if (!scene.objects[surface.object].solid) {
    // A sheet without an inside: straight on, along the same ray.
    refracted.kind = RayKind::straight;
    refracted.start = hit;
  } else {
    refracted.kind = RayKind::refracted;
    refracted.media = media_behind(prepared, path.ray, hit, surface, path.media, counts);
    const double eta = relative_ior(scene, path.media, refracted.media);
    const std::optional<glm::dvec3> t = refract_direction(d, surface.normal, surface.facing, eta);
    if (!t) {  // total internal reflection: one ray carries both weights
      mirrored.kind = RayKind::internally_reflected;
      out.mirrored.c = c2 + c3;
      return out;
    }
    // It starts before the surface too, meets it again and passes it, since by then it is in the medium behind; and no
    // other surface that touches this one is jumped over.
    refracted.ray = make_ray(from, *t);
    refracted.start = kRayStart;
  }
  out.refracted.c = c3;
  return out;
}

bool send(const Scene& scene, const glm::dvec3& c, Path& path) {
  path.weight *= largest(c);
  if (!is_sent(scene, path.depth, path.weight)) return false;
  ++path.depth;
  return true;
}

double distance_weight(const Attenuation& q, const Ray& ray, const Hit& start, const Hit& hit) {
  if (!hit.found()) return q.q1 > 0 || q.q2 > 0 ? 0 : 1 / std::max(1.0, q.q0);
  const double r = (hit.t - start.t) * glm::length(ray.direction);
  return 1 / std::max(1.0, q.q0 + q.q1 * r + q.q2 * r * r);
}

}  // namespace sidelight::raytrace
