// SPDX-License-Identifier: MIT
// The tracer's questions about a scene, answered through the hierarchy. Which surface is met is decided by
// common/model/visibility.h alone; here only candidates are found.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "common/model/visibility_float.h"
#include "raytrace/prepared.h"

namespace sidelight::raytrace {
namespace {

Box box_of(const Scene& scene, const PrimitiveRef& ref) {
  Box box;
  if (ref.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene.spheres[ref.index];
    box.grow(sphere.center - sphere.radius);
    box.grow(sphere.center + sphere.radius);
  } else {
    for (const std::uint32_t v : scene.triangles[ref.index].vertex) box.grow(scene.positions[v]);
  }
  return box;
}

bool is_finite(const Ray& ray) {
  const glm::dvec3 sum = glm::abs(ray.origin) + glm::abs(ray.direction);
  return std::isfinite(sum.x + sum.y + sum.z);
}

bool casts_shadow(const Scene& scene, std::uint32_t primitive) {
  return scene.materials[primitive_material(scene, primitive)].casts_shadow;
}

// All primitives that may be met at a depth <= limit: visit(primitive, limit) returns the new limit, negative to stop.
template <class Visit>
void candidates(const Prepared& prepared, const Ray& ray, double limit, SignCounts& counts, const Visit& visit) {
  if (!is_finite(ray)) return;   // it meets nothing, but no box would turn it away
  for (const std::uint32_t primitive : prepared.planes) {
    limit = visit(primitive, limit);
    if (limit < 0) return;
  }
  counts.nodes += traverse(prepared.bvh, ray, limit, visit);
}

// intersect_one: intersect, or intersect_in_float.
template <auto intersect_one>
Hit nearest_by(const Prepared& prepared, const Ray& ray, const Hit& after, SignCounts& counts) {
  Hit best;
  candidates(prepared, ray, best.t, counts, [&](std::uint32_t primitive, double) {
    const Hit hit = intersect_one(prepared.scene, primitive, ray, after, counts);
    if (hit.found() && before(hit, best)) best = hit;
    return best.t;
  });
  return best;
}

template <auto intersect_one>
Hit blocker_by(const Prepared& prepared, const Ray& ray, const glm::dvec3* light, const Hit& start,
               SignCounts& counts) {
  Hit found;
  const double limit = light ? 1 : std::numeric_limits<double>::infinity();
  candidates(prepared, ray, limit, counts, [&](std::uint32_t primitive, double current) {
    if (!casts_shadow(prepared.scene, primitive)) return current;
    const Hit hit = intersect_one(prepared.scene, primitive, ray, start, counts);
    if (!hit.found() || (light && !before_light(prepared.scene, hit, ray, *light, counts))) return current;
    found = hit;
    return -1.0;
  });
  return found;
}

}  // namespace

Prepared::Prepared(const Scene& s, const Needs& n)
    : scene(s), needs(n), tables(make_shading_tables(s, n)), tables_in_double(make_shading_tables<double>(s, n)) {
  std::vector<Box> boxes;
  std::vector<std::uint32_t> items;
  for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive) {
    const PrimitiveRef ref = primitive_ref(scene, primitive);
    if (ref.kind == ObjectKind::plane) {
      planes.push_back(primitive);
    } else if (ref.kind == ObjectKind::sphere || !scene.triangles[ref.index].degenerate) {
      boxes.push_back(box_of(scene, ref));
      items.push_back(primitive);
    }
  }
  bvh = build_bvh(boxes, items);
  if (!scene.trace.refraction || !needs[Need::refraction]) return;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].solid) {
      solids.push_back(i);
      bounds.push_back(bounds_of(scene, scene.objects[i]));
    }
}

Hit nearest(const Prepared& prepared, const Ray& ray, const Hit& after, SignCounts& counts, Precision precision) {
  return precision == Precision::exact ? nearest_by<intersect>(prepared, ray, after, counts)
                                       : nearest_by<intersect_in_float>(prepared, ray, after, counts);
}

Hit blocker(const Prepared& prepared, const Ray& ray, const glm::dvec3* light, SignCounts& counts, const Hit& start,
            Precision precision) {
  return precision == Precision::exact ? blocker_by<intersect>(prepared, ray, light, start, counts)
                                       : blocker_by<intersect_in_float>(prepared, ray, light, start, counts);
}

glm::dvec3 leaving_point(const Prepared& prepared, const Ray& ray, const Hit& hit, const Place& place,
                         SignCounts& counts) {
  std::vector<std::uint32_t> near;   // empty, but at edges
  const auto add = [&](std::uint32_t primitive) {
    if (stands_near(prepared.scene, primitive, ray, hit, place, counts)) near.push_back(primitive);
  };
  for (const std::uint32_t primitive : prepared.planes) add(primitive);
  visit_near(prepared.bvh, place.point, nearness(ray, hit, place, prepared.bvh.reach), add);
  std::sort(near.begin(), near.end());
  return leaving_point(prepared.scene, ray, hit, place, near, counts);
}

std::vector<Hit> hits_between(const Prepared& prepared, const Ray& ray, const Hit& from, double last_t,
                              SignCounts& counts) {
  std::vector<Hit> hits;
  candidates(prepared, ray, last_t, counts, [&](std::uint32_t primitive, double limit) {
    Hit hit = intersect(prepared.scene, primitive, ray, kRayStart, counts);
    while (hit.found() && hit.t <= last_t) {   // a sphere may be met twice
      if (!before(hit, from)) hits.push_back(hit);
      hit = intersect(prepared.scene, primitive, ray, hit, counts);
    }
    return limit;
  });
  std::sort(hits.begin(), hits.end(), before);
  return hits;
}

}  // namespace sidelight::raytrace
