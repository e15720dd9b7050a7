// SPDX-License-Identifier: MIT
// The questions of prepared.h, answered through the hierarchies. Which surface is met is decided by
// common/model/visibility.h alone; here only candidates are found.
#include "raytrace/prepared.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "common/model/visibility_float.h"
#include "raytrace/enclosed.h"
#include "raytrace/kernels.h"
#include "raytrace/lone_hit.h"

namespace sidelight::raytrace {
namespace {

bool is_finite(const Ray& ray) {
  const glm::dvec3 sum = glm::abs(ray.origin) + glm::abs(ray.direction);
  return std::isfinite(sum.x + sum.y + sum.z) && ray.direction != glm::dvec3(0);
}

// For a fault on purpose, whose hits no filter knows: all primitives whose boxes may be met at a depth <= limit, and all
// planes. visit(primitive, limit) returns the new limit, negative to stop.
template <class Visit>
void candidates(const Prepared& prepared, const Ray& ray, double limit, VisibilityCounts& counts, Isa isa,
                const Visit& visit) {
  if (!is_finite(ray)) return;  // it meets nothing, but no box would turn it away
  const auto keep = [&](std::uint32_t primitive, double current) {
    return limit = visit(primitive, current);
  };
  for (const std::uint32_t primitive : prepared.planes)
    if (keep(primitive, limit) < 0) return;
  counts.nodes += traverse(prepared.triangles.bvh, ray, limit, keep, isa);
  if (limit >= 0) counts.nodes += traverse(prepared.spheres.bvh, ray, limit, keep, isa);
}

// The same questions for a fault on purpose, whose hits no filter knows.
Hit nearest_in_float(const Prepared& prepared, const Ray& ray, const Hit& after, VisibilityCounts& counts,
                     Isa isa) {
  Hit best;
  candidates(prepared, ray, best.t, counts, isa, [&](std::uint32_t primitive, double) {
    const Hit hit = intersect_in_float(prepared.scene, primitive, ray, after, counts);
    if (hit.found() && before(hit, best)) best = hit;
    return best.t;
  });
  return best;
}

Hit blocker_in_float(const Prepared& prepared, const Ray& ray, const glm::dvec3* light, const Hit& start,
                     VisibilityCounts& counts, Isa isa) {
  Hit found;
  candidates(prepared, ray, light_depth(light), counts, isa, [&](std::uint32_t primitive, double current) {
    found = blocking_hit(prepared, primitive, ray, light, counts,
                         [&] { return intersect_in_float(prepared.scene, primitive, ray, start, counts); });
    return found.found() ? -1.0 : current;
  });
  return found;
}

// `own`, or the hit of a plane but `known` that comes before it.
Hit nearest_plane(const Prepared& prepared, const Ray& ray, const Hit& after, std::uint32_t known,
                  const Hit& own, VisibilityCounts& counts) {
  Hit best = own;
  for (const std::uint32_t primitive : prepared.planes) {
    if (primitive == known) continue;
    const Hit hit = intersect(prepared.scene, primitive, ray, after, counts);
    if (hit.found() && before(hit, best)) best = hit;
  }
  return best;
}

Hit blocking_plane(const Prepared& prepared, std::uint32_t plane, const Ray& ray, const glm::dvec3* light,
                   const Hit& start, VisibilityCounts& counts) {
  return blocking_hit(prepared, plane, ray, light, counts,
                      [&] { return intersect(prepared.scene, plane, ray, start, counts); });
}

}  // namespace

Prepared::Prepared(const Scene& s, const Needs& n, int threads)
    : scene(s),
      needs(n),
      tables(make_shading_tables(s, n)),
      tables_in_double(make_shading_tables<double>(s, n)),
      triangles(triangle_leaves(s, threads)),
      spheres(sphere_leaves(s, threads)) {
  for (const Material& material : scene.materials)
    all_cast_shadows = all_cast_shadows && material.casts_shadow;
  for (const Object& object : scene.objects)
    if (object.kind == ObjectKind::plane) planes.push_back(object.first_primitive);
  reach = std::max(triangles.bvh.reach, spheres.bvh.reach);
  for (const Plane& plane : scene.planes) reach = reach_from(plane.point);
  secluded.resize(scene.spheres.size());
  if (!scene.trace.refraction || !needs[Need::refraction]) return;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].solid) {
      solids.push_back(i);
      bounds.push_back(bounds_of(scene, scene.objects[i]));
      shuts_in.push_back(raytrace::shuts_in(scene, scene.objects[i]));
    }
  for (const std::uint32_t solid : solids)
    if (const Object& object = scene.objects[solid]; object.kind == ObjectKind::sphere)
      secluded[object.first] = is_secluded(*this, object.first_primitive);
}

bool casts_shadow(const Scene& scene, std::uint32_t primitive) {
  return scene.materials[primitive_material(scene, primitive)].casts_shadow;
}

Hit nearest(const Prepared& prepared, const Ray& ray, const Hit& after, VisibilityCounts& counts,
            Precision precision, Isa isa) {
  if (precision == Precision::in_float) return nearest_in_float(prepared, ray, after, counts, isa);
  return nearest_beside(prepared, ray, after, kNone, {}, counts, isa);
}

Hit nearest_beside(const Prepared& prepared, const Ray& ray, const Hit& after, std::uint32_t known,
                   const Hit& own, VisibilityCounts& counts, Isa isa) {
  if (!is_finite(ray)) return own;
  Hit best = nearest_plane(prepared, ray, after, known, own, counts);
  kernels_for(isa).nearest(prepared, ray, after, known, best, counts);
  return best;
}

void nearest_beside(const Prepared& prepared, std::span<RayQuestion> questions, VisibilityCounts& counts,
                    Isa isa) {
  if (!prepared.planes.empty())
    for (auto& [ray, after, known, best] : questions)
      if (is_finite(ray)) best = nearest_plane(prepared, ray, after, known, best, counts);
  kernels_for(isa).nearest_of(prepared, questions, counts);
}

Hit blocker(const Prepared& prepared, const Ray& ray, const glm::dvec3* light, VisibilityCounts& counts,
            const Hit& start, Precision precision, Isa isa) {
  if (precision == Precision::in_float) return blocker_in_float(prepared, ray, light, start, counts, isa);
  if (!is_finite(ray)) return {};
  for (const std::uint32_t plane : prepared.planes)
    if (const Hit hit = blocking_plane(prepared, plane, ray, light, start, counts); hit.found()) return hit;
  return kernels_for(isa).blocker(prepared, ray, light, start, counts);
}

void find_blocked(const Prepared& prepared, std::span<ShadowQuestion> questions, const glm::dvec3* light,
                  VisibilityCounts& counts, Isa isa) {
  for (const std::uint32_t plane : prepared.planes)
    for (auto& [ray, blocked] : questions)
      if (!blocked && is_finite(ray))
        blocked = blocking_plane(prepared, plane, ray, light, kRayStart, counts).found();
  kernels_for(isa).blocked_of(prepared, questions, light, counts);
}

glm::dvec3 leaving_point(const Prepared& prepared, const Ray& ray, const Hit& hit, const Place& place,
                         VisibilityCounts& counts, Isa isa) {
  std::vector<std::uint32_t> near;  // empty, but at edges
  auto add = [&](std::uint32_t primitive) {
    if (stands_near(prepared.scene, primitive, ray, hit, place, counts)) near.push_back(primitive);
  };
  for (const std::uint32_t primitive : prepared.planes) add(primitive);
  const auto question = [&](const Bvh& bvh) {
    return NearQuestion{place.point, nearness(ray, hit, place, bvh.reach), hit.primitive, visitor_of(add)};
  };
  const Kernels& kernels = kernels_for(isa);
  if (!prepared.triangles.bvh.nodes.empty())
    kernels.near_triangles(prepared.triangles, question(prepared.triangles.bvh));
  if (!prepared.spheres.bvh.nodes.empty())
    kernels.near_spheres(prepared.spheres, question(prepared.spheres.bvh));
  std::sort(near.begin(), near.end());
  return leaving_point(prepared.scene, ray, hit, place, near, counts);
}

std::vector<Hit> hits_between(const Prepared& prepared, const Ray& ray, const Hit& from, double last_t,
                              VisibilityCounts& counts, Isa isa) {
  std::vector<Hit> hits;
  if (!is_finite(ray)) return hits;
  auto add = [&](std::uint32_t primitive) {
    const bool twice = primitive_ref(prepared.scene, primitive).kind == ObjectKind::sphere;
    Hit hit = intersect(prepared.scene, primitive, ray, kRayStart, counts);
    while (hit.found() && hit.t <= last_t) {
      if (!before(hit, from)) hits.push_back(hit);
      hit = twice ? intersect(prepared.scene, primitive, ray, hit, counts) : Hit{};
    }
  };
  for (const std::uint32_t primitive : prepared.planes) add(primitive);
  kernels_for(isa).candidates(prepared, ray, from.t, last_t, counts, visitor_of(add));
  std::sort(hits.begin(), hits.end(), before);
  return hits;
}

}  // namespace sidelight::raytrace
