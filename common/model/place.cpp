// SPDX-License-Identifier: MIT
#include "common/model/place.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "common/math/lane_ops.h"
#include "common/math/norms.h"

namespace sidelight {
namespace {

constexpr double kU = 0x1p-53;  // unit roundoff

// ---- The clearance of a surface, by kind ----

// point: 3 u r + u |c + r n|; the next ray's f: u (|c| + r); its |f|² - r²: 4 u r. Along the normal, with room:
double clearance_of(const Sphere& sphere, const glm::dvec3& outward) {
  return 16 * kU * (glm::dot(absolute(outward), absolute(sphere.center)) + sphere.radius);
}

// With q = |p - P0|, per component seen along the normal: n . (p - P0) is off by 4 u q when the point is put on the
// plane and when it is left again, the point by u |p| when it is put there and when it is moved off. With room:
double clearance_of(const Plane& plane, const glm::dvec3& p) {
  return kU * glm::dot(absolute(plane.normal), 10.0 * absolute(p - plane.point) + 3.0 * absolute(p));
}

// With V the largest vertex component: point 12 u V off its plane (edges 3 u of 2 V, sums 2 u of 3 V), moving it u V,
// the next ray's a_k 2 u V. Per component, seen along the normal:
double clearance_of(const Corners& corners, const glm::dvec3& outward) {
  const auto& [v0, v1, v2] = corners;
  const glm::dvec3 reach{std::max({std::abs(v0.x), std::abs(v1.x), std::abs(v2.x)}),
                         std::max({std::abs(v0.y), std::abs(v1.y), std::abs(v2.y)}),
                         std::max({std::abs(v0.z), std::abs(v1.z), std::abs(v2.z)})};
  return 16 * kU * glm::dot(absolute(outward), reach);
}

glm::dvec3 outward_of(const Corners& corners) {
  const glm::dvec3 n = glm::cross(corners.v1 - corners.v0, corners.v2 - corners.v0);
  return glm::normalize(n / max_norm(n));
}

// ---- locate, by kind ----

Place locate_sphere(const Sphere& sphere, const Ray& ray, const Hit& hit) {
  Place place;
  const glm::dvec3 f = (ray.origin - sphere.center) + hit.t * ray.direction;
  place.outward = glm::normalize(f);
  place.point = sphere.center + sphere.radius * place.outward;
  place.entering = hit.t == sphere_roots(sphere, ray).low;
  place.clearance = clearance_of(sphere, place.outward);
  return place;
}

Place locate_plane(const Plane& plane, const Ray& ray, const Hit& hit) {
  Place place;
  place.outward = plane.normal;
  const glm::dvec3 p = ray.origin + hit.t * ray.direction;
  place.point = p - glm::dot(plane.normal, p - plane.point) * plane.normal;
  place.entering = glm::dot(plane.normal, ray.direction) < 0;
  place.clearance = clearance_of(plane, p);
  return place;
}

Place locate_triangle(const Scene& scene, const Triangle& triangle, const Ray& ray,
                      VisibilityCounts& counts) {
  const Corners v = corners(scene, triangle);
  const TriangleView view = view_triangle(ray.origin, v.v0, v.v1, v.v2);
  const std::array<double, 3> e = edge_values(view, ray.direction);
  const double per_sum = 1 / std::abs(e[0] + e[1] + e[2]);

  Place place;
  for (std::size_t k = 0; k < 3; ++k) place.barycentric[k] = std::abs(e[k]) * per_sum;
  place.point = between(place, v.v0, v.v1 - v.v0, v.v2 - v.v0);
  place.outward = outward_of(v);
  place.entering = view_side(view, counts) < 0;
  place.clearance = clearance_of(v, place.outward);
  return place;
}

// ---- Rays that leave ----

// The plane that touches a surface next to a point near it.
struct Tangent {
  glm::dvec3 outward{0};
  double height = 0;    // of the point above it, outward
  double rounding = 0;  // of that height
  double clearance = 0;
};

Tangent tangent_at(const Scene& scene, std::uint32_t primitive, const glm::dvec3& point) {
  Tangent tangent;
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  if (ref.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene.spheres[ref.index];
    const double distance = glm::length(point - sphere.center);
    tangent.outward = distance > 0 ? (point - sphere.center) / distance : glm::dvec3(0);
    tangent.height = distance - sphere.radius;
    tangent.rounding = tangent.clearance = clearance_of(sphere, tangent.outward);
  } else if (ref.kind == ObjectKind::plane) {
    const Plane& plane = scene.planes[ref.index];
    tangent.outward = plane.normal;
    tangent.height = glm::dot(plane.normal, point - plane.point);
    tangent.rounding = tangent.clearance = clearance_of(plane, point);
  } else {
    const Corners v = corners(scene, scene.triangles[ref.index]);
    const TriangleView view = view_triangle(point, v.v0, v.v1, v.v2);
    const DepthPlane plane = depth_plane(view, v.v0, v.v1, v.v2);
    const double length = glm::length(plane.n);
    tangent.outward = outward_of(v);
    tangent.height = -plane.a0_n / length;
    tangent.rounding = 4 * kU * glm::dot(absolute(view.a[0]), plane.weight) / length;
    tangent.clearance = clearance_of(v, tangent.outward);
  }
  return tangent;
}

// How far the point may be off along the ray: as far as surfaces lie together, and never by more than the 2^-20 to
// which values of edges and depths are good.
double point_error(const Ray& ray, const Hit& hit, const Place& place) {
  return std::min(place.together - hit.t, 0x1p-20 * hit.t) * l1_norm(ray.direction);
}

// The unit of moves: the clearance, and not 0 as that is in a plane through the origin, since the arriving ray is known
// to u of its length at best.
double step_of(const Ray& ray, const Hit& hit, const Place& place) {
  return std::max(place.clearance, kU * hit.t * l1_norm(ray.direction));
}

// A start is moved aside a few times, and by up to kAside steps, so what lies within kNear of them matters.
constexpr int kMoves = 16;
constexpr double kAside = 8, kNear = 10;

// Whether the triangle's box, plane and edges may be as near as nearness() says: quick questions before the exact ones,
// which the other half of a quad would ask at every point. Each product is off by less than 2^-48 of the lengths in it.
bool may_be_near(const Scene& scene, std::uint32_t triangle, const Ray& ray, const Hit& hit,
                 const Place& place) {
  const auto& [v0, v1, v2] = corners(scene, scene.triangles[triangle]);
  const glm::dvec3 low = glm::min(v0, glm::min(v1, v2)), high = glm::max(v0, glm::max(v1, v2));
  const double room = nearness(ray, hit, place, max_norm(glm::max(-low, high)));
  for (int i = 0; i < 3; ++i)
    if (place.point[i] < low[i] - room || place.point[i] > high[i] + room) return false;
  const glm::dvec3 p = place.point - v0, e1 = v1 - v0, e2 = v2 - v0, n = glm::cross(e1, e2);
  const double area = l1_norm(e1) * l1_norm(e2);
  if (std::abs(glm::dot(p, n)) > 2 * room * l1_norm(n) + 0x1p-48 * l1_norm(p) * area) return false;
  const auto beyond = [&](const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 edge = b - a, q = place.point - a;
    return glm::dot(glm::cross(edge, q), n) < -(2 * room + 0x1p-48 * l1_norm(q)) * l1_norm(edge) * area;
  };
  return !beyond(v0, v1) && !beyond(v1, v2) && !beyond(v2, v0);
}

// Whether rays that leave a flat `hit` can meet the other at all: a triangle that lies behind it they cannot, so the
// edges of a convex body need nothing. Nor can they meet one in its plane, but for a refracted ray, which goes through: in a
// plane through the origin, where the clearance is 0, it would start in that plane and miss the floor under glass.
bool rises(const Scene& scene, std::uint32_t other, const Ray& ray, const Hit& hit,
           VisibilityCounts& counts) {
  const PrimitiveRef ref = primitive_ref(scene, other);
  if (ref.kind != ObjectKind::mesh || primitive_ref(scene, hit.primitive).kind == ObjectKind::sphere)
    return true;
  const int front = side_of(scene, hit.primitive, ray.origin, counts);
  const auto& vertex = scene.triangles[ref.index].vertex;
  const auto lies = [&](int side) {
    return [&, side](std::uint32_t v) {
      return side_of(scene, hit.primitive, scene.positions[v], counts) == side;
    };
  };
  if (std::any_of(vertex.begin(), vertex.end(), lies(front))) return true;
  return scene.primitive_object[other] != scene.primitive_object[hit.primitive] &&
         scene.materials[primitive_material(scene, hit.primitive)].refract != glm::dvec3(0) &&
         std::all_of(vertex.begin(), vertex.end(), lies(0));
}

// The side of the surface on which the ray travels just before `hit`: its origin's, unless it crossed it on the way, as
// rays do that pass a surface unnoticed.
int side_before(const Scene& scene, std::uint32_t primitive, const Ray& ray, const Hit& hit,
                VisibilityCounts& counts) {
  int side = side_of(scene, primitive, ray.origin, counts);
  Hit crossed = intersect(scene, primitive, ray, kRayStart, counts);
  for (; crossed.found() && before(crossed, hit); crossed = intersect(scene, primitive, ray, crossed, counts))
    side = -side;
  return side;
}

}  // namespace

Place locate(const Scene& scene, const Ray& ray, const Hit& hit, VisibilityCounts& counts) {
  const PrimitiveRef ref = primitive_ref(scene, hit.primitive);
  Place place;
  switch (ref.kind) {
    case ObjectKind::sphere:
      place = locate_sphere(scene.spheres[ref.index], ray, hit);
      break;
    case ObjectKind::plane:
      place = locate_plane(scene.planes[ref.index], ray, hit);
      break;
    case ObjectKind::mesh:
      place = locate_triangle(scene, scene.triangles[ref.index], ray, counts);
      break;
  }
  place.facing = place.entering ? place.outward : -place.outward;
  place.together = together_depth(ray, hit, place);
  return place;
}

glm::dvec3 between(const Place& place, const glm::dvec3& at0, const glm::dvec3& to1, const glm::dvec3& to2) {
  const auto [_, b1, b2] = place.barycentric;
  const auto component = [&](int i) { return fused<double>(b2, to2[i], fused<double>(b1, to1[i], at0[i])); };
  return {component(0), component(1), component(2)};
}

// Two surfaces whose points cannot be told apart: 2 clearances, seen along the ray, and the rounding of two depths.
double together_depth(const Ray& ray, const Hit& hit, const Place& place) {
  const double along = std::abs(glm::dot(ray.direction, place.facing));
  return hit.t + 0x1p-46 * hit.t + (along > 0 ? 4 * place.clearance / along : 0);
}

double nearness(const Ray& ray, const Hit& hit, const Place& place, double reach) {
  // 16 u sqrt(3) reach: no clearance is greater.
  return kNear * (step_of(ray, hit, place) + 32 * kU * reach) + point_error(ray, hit, place);
}

bool stands_near(const Scene& scene, std::uint32_t primitive, const Ray& ray, const Hit& hit,
                 const Place& place, VisibilityCounts& counts) {
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  if (primitive == hit.primitive) return false;
  if (ref.kind == ObjectKind::mesh &&
      (scene.triangles[ref.index].degenerate || !may_be_near(scene, ref.index, ray, hit, place)))
    return false;
  const Tangent other = tangent_at(scene, primitive, place.point);
  const double along = std::abs(glm::dot(glm::normalize(ray.direction), other.outward));
  return std::abs(other.height) <= kNear * (step_of(ray, hit, place) + other.clearance) + other.rounding +
                                       point_error(ray, hit, place) * along &&
         rises(scene, primitive, ray, hit, counts);
}

glm::dvec3 leaving_point(const Scene& scene, const Ray& ray, const Hit& hit, const Place& place,
                         std::span<const std::uint32_t> near, VisibilityCounts& counts) {
  if (near.empty()) return place.point + place.clearance * place.facing;
  std::vector<std::uint32_t> walls(near.begin(), near.end());
  walls.push_back(hit.primitive);
  const double step = step_of(ray, hit, place);
  double height = step;
  std::vector<int> sides;
  for (const std::uint32_t wall : walls) {
    sides.push_back(side_before(scene, wall, ray, hit, counts));
    height = std::max(height, tangent_at(scene, wall, place.point).clearance);
  }
  // The first wall on whose wrong side the point lies; walls.size() if all are right.
  const auto crossed = [&](const glm::dvec3& from) {
    std::size_t i = 0;
    while (i < walls.size() && (sides[i] == 0 || side_of(scene, walls[i], from, counts) == sides[i])) ++i;
    return i;
  };

  // Aside, along the own surface, to two steps above each wall. What moves it off one wall may move it to another one:
  // three walls at a right angle take two moves.
  const glm::dvec3 start = place.point + height * place.facing;
  glm::dvec3 from = start;
  for (int move = 0; move < kMoves && glm::length(from - start) <= kAside * step; ++move) {
    const std::size_t i = crossed(from);
    if (i == walls.size()) return from;
    const Tangent wall = tangent_at(scene, walls[i], from);
    const double side = sides[i];
    const glm::dvec3 aside = side * (wall.outward - glm::dot(wall.outward, place.facing) * place.facing);
    const double sine2 = glm::dot(aside, aside);  // of the angle between the two
    if (sine2 == 0) break;
    from += (std::max(0.0, -side * wall.height) + 2 * std::max(wall.clearance, step)) / sine2 * aside;
  }

  // The corner is too sharp for that. Back along the way it came, then, where all is free.
  const double length = hit.t * glm::length(ray.direction);
  const glm::dvec3 back = -glm::normalize(ray.direction);
  for (double way = step; way < length; way *= 2)
    if (crossed(place.point + way * back) == walls.size()) return place.point + way * back;
  return ray.origin;
}

}  // namespace sidelight
