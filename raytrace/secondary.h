// SPDX-License-Identifier: MIT
// A ray on its way, and the rays that leave a surface: towards its mirror image, through it, and towards the lights. What
// the recursion (whitted.h) sends one by one and the waves (wave.h) level by level is said here, once.
#pragma once

#include <algorithm>

#include "common/model/explanation.h"
#include "raytrace/media.h"
#include "raytrace/prepared.h"

namespace sidelight::raytrace {

// A ray with what the recursion needs to know about its past.
struct Path {
  Ray ray;
  RayKind kind = RayKind::eye;
  Hit start = kRayStart;  // hits up to here lie behind it already
  Media media;            // where it travels
  int depth = 1;          // rays along the path, this one included
  double weight = 1;      // product of the largest channels of c2, c3 along the path
};

inline double largest(const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); }

inline bool is_mirrored(RayKind kind) {
  return kind == RayKind::mirrored || kind == RayKind::internally_reflected;
}

// A ray and the c2 or c3 by which what it brings back is counted; 0: there is no such ray.
struct Departure {
  Path path;
  glm::dvec3 c{0};
};
struct Departures {
  Departure mirrored, refracted;
};

// c2 and c3 of a material, as the scene's switches leave them.
inline glm::dvec3 reflect_of(const Scene& scene, const Material& material) {
  return scene.trace.reflection ? material.reflect : glm::dvec3(0);
}
inline glm::dvec3 refract_of(const Scene& scene, const Material& material) {
  return scene.trace.refraction ? material.refract : glm::dvec3(0);
}

// What a ray brings back is counted by c; its largest channel is what the ray weighs, 0: there is none.
struct Share {
  glm::vec3 c{0};
  double largest = 0;
};
// Of the rays that leave a material: mirrored, transmitted, and the one for both where reflection is total.
struct Shares {
  Share mirrored, transmitted, total;
};
Shares shares_of(const Scene& scene, const Material& material);

// The secondary rays that `path` gives rise to where it met `hit`, at `surface`; they start at `from`
// (leaving_point). Of the surface object, material, normal, facing, entering and together are read. Depth and weight are
// still those of `path`.
Departures departures(const Prepared& prepared, const Path& path, const Hit& hit, const Surface& surface,
                      const glm::dvec3& from, VisibilityCounts& counts);

// eta of Snell's law.
inline double relative_ior(const Scene& scene, const Media& before, const Media& behind) {
  return before.ior(scene) / behind.ior(scene);
}

// Whether a ray is sent that would be the next one on a path of this depth, its own weight taken in.
inline bool is_sent(const Scene& scene, int depth, double weight) {
  return depth < scene.trace.depth && !(weight < scene.trace.contribution_cut);
}

// Takes c into the ray's weight, and the ray a step deeper if it is sent; false where it is too deep or weighs too
// little.
bool send(const Scene& scene, const glm::dvec3& c, Path& path);

// w(r) = 1 / max(1, q0 + q1 r + q2 r²) from `start` to `hit`; a ray that meets nothing has r -> infinity.
double distance_weight(const Attenuation& q, const Ray& ray, const Hit& start, const Hit& hit);

// From `origin` to the light: up to t = 1 of a point light.
inline Ray ray_to_light(const glm::dvec3& origin, const Light& light) {
  return make_ray(origin, light.directional ? -light.direction : light.position - origin);
}

}  // namespace sidelight::raytrace
