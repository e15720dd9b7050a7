// SPDX-License-Identifier: MIT
#include "raytrace/lone_hit.h"

#include <algorithm>
#include <cmath>

#include "raytrace/clearings.h"
#include "raytrace/kernels.h"

namespace sidelight::raytrace {
namespace {

// Of the cosine between a ray and the normal.
constexpr double kLeastCosine = 0x1p-10;

// Outward, of any length; zero where a sphere is so small that its far side might lie near.
glm::dvec3 outward_at(const Scene& scene, const PrimitiveRef& ref, const glm::dvec3& point, double room) {
  if (ref.kind == ObjectKind::plane) return scene.planes[ref.index].normal;
  if (ref.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene.spheres[ref.index];
    return sphere.radius * kLeastCosine > room ? point - sphere.center : glm::dvec3(0);
  }
  const auto [v0, v1, v2] = corners(scene, scene.triangles[ref.index]);
  return glm::cross(v1 - v0, v2 - v0);
}

// Whether anything else, but what `passes` says is not, may have a point in the cube around this one.
template <class Passes>
bool anything_near(const Prepared& prepared, const glm::dvec3& point, double room, std::uint32_t except,
                   Isa isa, const Passes& passes) {
  for (const std::uint32_t primitive : prepared.planes) {
    const Plane& plane = prepared.scene.planes[primitive_ref(prepared.scene, primitive).index];
    if (primitive != except && std::abs(glm::dot(plane.normal, point - plane.point)) <= 2 * room) return true;
  }
  bool any = false;
  auto found = [&](std::uint32_t primitive) { any |= !passes(primitive); };
  const NearQuestion question{point, room, except, visitor_of(found), &any};
  const Kernels& kernels = kernels_for(isa);
  if (!prepared.triangles.bvh.nodes.empty()) kernels.near_triangles(prepared.triangles, question);
  if (!any && !prepared.spheres.bvh.nodes.empty()) kernels.near_spheres(prepared.spheres, question);
  return any;
}

}  // namespace

// Within what distance of o + t d, along each axis, nothing else may be. With R the greatest coordinate and s = t |d|:
//   depths are off by 2^-18 (visibility.h), that of this hit and those of others:      2^-17 s
//   and roots of a sphere that is grazed by the square root of their rounding:         8 sqrt(u) R < 2^-23 R
//   surfaces count as crossed together up to 2^-46 s + 4 clearances / cosine, where rays start that leave is one
//   clearance / cosine before, and no clearance is above 28 u R + 20 u s:               2^-34 (R + s)
//   rays that leave are moved off what is within 10 (clearance + 32 u R) + 2^-20 s of the point (place.cpp).
// All of these together, and the rounding of the point itself, are less than
double room_for(double reach, double way) { return 0x1p-16 * way + 0x1p-20 * reach; }

bool is_clear(const Prepared& prepared, const Ray& ray, const Hit& hit, Clearings& clearings, Isa isa) {
  const double way = hit.t * glm::length(ray.direction);
  return clearings.contain(hit.primitive, ray.origin + hit.t * ray.direction,
                           room_for(prepared.reach_from(ray.origin), way), isa);
}

bool is_steep(const glm::dvec3& direction, const glm::dvec3& facing) {
  return std::abs(glm::dot(direction, facing)) >= kLeastCosine;
}

bool is_secluded(const Prepared& prepared, std::uint32_t sphere) {
  const Scene& scene = prepared.scene;
  const Sphere& ball = scene.spheres[primitive_ref(scene, sphere).index];
  const double radius = 1.25 * ball.radius;
  const auto is_far_ball = [&](std::uint32_t primitive) {
    const PrimitiveRef ref = primitive_ref(scene, primitive);
    if (ref.kind != ObjectKind::sphere) return false;
    const Sphere& other = scene.spheres[ref.index];
    return std::abs(glm::distance(other.center, ball.center) - other.radius) > radius;
  };
  return ball.radius * kLeastCosine > room_for(prepared.reach, 2 * ball.radius) &&
         !anything_near(prepared, ball.center, radius, sphere, best_isa(), is_far_ball);
}

Lone lone_hit(const Prepared& prepared, const Ray& ray, const Hit& hit, Isa isa, Clearings* clearings) {
  const PrimitiveRef ref = primitive_ref(prepared.scene, hit.primitive);
  const glm::dvec3 point = ray.origin + hit.t * ray.direction;
  const double length = glm::length(ray.direction);
  const double room = room_for(prepared.reach_from(ray.origin), hit.t * length);
  const glm::dvec3 outward = outward_at(prepared.scene, ref, point, room);
  const double along = glm::dot(ray.direction, outward);
  if (!(std::abs(along) > 2 * kLeastCosine * length * glm::length(outward))) return Lone::unknown;
  const bool alone = (ref.kind == ObjectKind::sphere && prepared.secluded[ref.index] != 0) ||
                     (clearings && clearings->contain(hit.primitive, point, room, isa));
  const auto none = [](std::uint32_t) { return false; };
  if (!alone && anything_near(prepared, point, room, hit.primitive, isa, none)) return Lone::unknown;
  return along < 0 ? Lone::entering : Lone::leaving;
}

}  // namespace sidelight::raytrace
