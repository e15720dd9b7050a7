// SPDX-License-Identifier: MIT
// Of a hit that is called lone everything is true that is then not searched for: brute force finds no other surface that
// is crossed with it, none near to where rays leave, and that a ray into the surface passes it first and alone.
#include <doctest/doctest.h>

#include <algorithm>

#include "common/model/surface.h"
#include "raytrace/clearings.h"
#include "raytrace/lone_hit.h"
#include "tests/agreement/pictures.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::Clearings;
using raytrace::Lone;
using raytrace::Prepared;

namespace {

// Closed meshes and balls of glass, and next to their surfaces, at all distances down to rounding, sheets, balls and planes.
// `crowd`: points on surfaces, where these are.
Scene crowded_scene(Random& random, std::vector<glm::dvec3>& crowd) {
  Scene scene = empty_scene();
  scene.materials[0].refract = glm::dvec3(0.5);
  const double far = random.uniform() < 0.3 ? random.log_uniform(1, 1e6) : 0;
  for (int i = 0; i < 3; ++i) {
    PolygonMesh mesh = i == 0 ? octahedron({0, 0, 0}, 1) : star_sphere(8, 9, 0.3, random.bits());
    const glm::dvec3 at = far + random.in_box(2);
    for (glm::dvec3& p : mesh.positions) p = at + p;
    for (std::size_t k = 0; k < 3; ++k)
      crowd.push_back((mesh.positions[k] + mesh.positions[k + 1] + mesh.positions[k + 2]) / 3.0);
    crowd.push_back(mesh.positions[0]);
    add_mesh(scene, mesh, {}, {});
  }
  for (int i = 0; i < 4; ++i) {
    const Sphere ball{far + random.in_box(2), random.log_uniform(1e-3, 1), 0};
    crowd.push_back(ball.center + ball.radius * random.direction());
    add_sphere(scene, ball, {});
  }
  for (const glm::dvec3& on : crowd) {
    const glm::dvec3 aside = random.log_uniform(1e-16, 0.1) * random.direction();
    if (random.uniform() < 0.3) {
      const glm::dvec3 toward = random.log_uniform(1e-3, 0.3) * random.direction();
      add_sphere(scene, {on + aside + toward, glm::length(toward), 0}, {});
    } else {
      const glm::dvec3 p = on + aside;
      add_mesh(
          scene,
          mesh_of({p + 0.2 * random.direction(), p + 0.2 * random.direction(), p + 0.2 * random.direction()},
                  {{0, 1, 2}}),
          {}, {});
    }
  }
  if (random.uniform() < 0.5) add_plane(scene, {crowd[random.below(12)], random.direction(), 0}, {});
  return scene;
}

// All hits of all primitives but `own` at a depth up to `last`.
std::uint64_t others_up_to(const Scene& scene, const Ray& ray, std::uint32_t own, double last) {
  VisibilityCounts counts;
  std::uint64_t others = 0;
  for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive) {
    if (primitive == own) continue;
    const Hit hit = intersect(scene, primitive, ray, kRayStart, counts);
    others += hit.found() && hit.t <= last;
  }
  return others;
}

double distance_to_edge(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& point) {
  const double along = glm::dot(point - a, b - a) / glm::dot(b - a, b - a);
  return glm::distance(point, glm::mix(a, b, std::clamp(along, 0.0, 1.0)));
}

// Of the primitive from a point.
double distance_to(const Scene& scene, std::uint32_t primitive, const glm::dvec3& point) {
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  if (ref.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene.spheres[ref.index];
    return std::abs(glm::distance(point, sphere.center) - sphere.radius);
  }
  if (ref.kind == ObjectKind::plane)
    return std::abs(glm::dot(scene.planes[ref.index].normal, point - scene.planes[ref.index].point));
  const auto [v0, v1, v2] = corners(scene, scene.triangles[ref.index]);
  const glm::dvec3 n = glm::cross(v1 - v0, v2 - v0);
  const auto inside = [&](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::dot(glm::cross(b - a, point - a), n) >= 0;
  };
  if (inside(v0, v1) && inside(v1, v2) && inside(v2, v0))
    return std::abs(glm::dot(point - v0, glm::normalize(n)));
  return std::min(
      {distance_to_edge(v0, v1, point), distance_to_edge(v1, v2, point), distance_to_edge(v2, v0, point)});
}

// How many others have a point as near to the hit as none has where it is lone or clear.
std::uint64_t others_near(const Prepared& prepared, const Ray& ray, const Hit& hit) {
  const double room = raytrace::room_for(prepared.reach_from(ray.origin), hit.t * glm::length(ray.direction));
  std::uint64_t near = 0;
  for (std::uint32_t other = 0; other < prepared.scene.primitive_object.size(); ++other)
    near += other != hit.primitive &&
            distance_to(prepared.scene, other, ray.origin + hit.t * ray.direction) <= room;
  return near;
}

// A ray into the surface from where rays start that leave.
void check_passes(const Prepared& prepared, const Place& place, const Hit& hit, Random& random) {
  const Scene& scene = prepared.scene;
  VisibilityCounts counts;
  const glm::dvec3 into = -outward(place.facing, random);
  if (!raytrace::is_steep(into, place.facing)) return;
  const Ray ray = make_ray(place.point + place.clearance * place.facing, into);
  const Hit passed = intersect(scene, hit.primitive, ray, kRayStart, counts);
  const Place there = passed.found() ? locate(scene, ray, passed, counts) : Place{};
  CHECK(others_up_to(scene, ray, hit.primitive, passed.found() ? there.together : place.clearance) == 0);
  if (!passed.found()) return;
  CHECK(there.entering == place.entering);
  const Hit again = intersect(scene, hit.primitive, ray, passed, counts);
  CHECK((!again.found() || again.t > there.together));
}

void check_lone(const Prepared& prepared, const Ray& ray, const Hit& hit, Lone lone, Random& random) {
  const Scene& scene = prepared.scene;
  VisibilityCounts counts;
  const Place place = locate(scene, ray, hit, counts);
  CHECK((lone == Lone::entering) == place.entering);
  const std::vector<Hit> together = hits_between(prepared, ray, hit, place.together, counts);
  CHECK(together == std::vector<Hit>{hit});
  std::uint64_t near = 0;
  for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive)
    near += stands_near(scene, primitive, ray, hit, place, counts);
  CHECK(near == 0);
  CHECK(others_near(prepared, ray, hit) == 0);
  check_passes(prepared, place, hit, random);
}

// Balls that touch each other, from outside and from inside, or nearly so, at all distances down to rounding; a few sheets
// and a plane. `touching`: where they do.
Scene touching_balls(Random& random, std::vector<glm::dvec3>& touching) {
  Scene scene = empty_scene();
  add_sphere(scene, {random.in_box(1), random.log_uniform(0.1, 1), 0}, {});
  const std::uint32_t balls = 2 + random.below(14);
  for (std::uint32_t i = 0; i < balls; ++i) {
    const Sphere ball = scene.spheres[random.below(1 + i)];
    const double radius = ball.radius * random.log_uniform(0.1, 10), gap = random.log_uniform(1e-16, 1e-2);
    const bool inside = random.uniform() < 0.2;
    const glm::dvec3 to = random.direction();
    touching.push_back(ball.center + ball.radius * to);
    const double apart = inside ? ball.radius - radius - gap : ball.radius + radius + gap;
    add_sphere(scene, {ball.center + (random.uniform() < 0.1 ? 0 : apart) * to, radius, 0}, {});
  }
  const glm::dvec3 p = touching[0];
  if (random.uniform() < 0.2) add_plane(scene, {p, random.direction(), 0}, {});
  if (random.uniform() < 0.2)
    add_mesh(scene, mesh_of({p, p + 0.2 * random.direction(), p + 0.2 * random.direction()}, {{0, 1, 2}}), {},
             {});
  return scene;
}

}  // namespace

TEST_CASE("lone hits: brute force finds nothing else there") {
  Random random(94);
  std::uint64_t hits = 0, lone_hits = 0, clear = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 2000; left > 0; --left) {
    std::vector<glm::dvec3> crowd;
    const Scene scene = crowded_scene(random, crowd);
    const Prepared prepared(scene);
    VisibilityCounts counts;
    Clearings clearings(prepared, 1);
    for (int i = 0; i < 100; ++i) {
      const auto& triangle =
          scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))];
      // At a triangle, or past its edge and vertices, as near as it comes, or where others are.
      const double a = random.uniform(), kind = random.uniform(), near = random.log_uniform(1e-17, 1);
      const double b = kind < 0.2 ? near : kind < 0.4 ? 1 - near : a;
      const std::uint32_t k = random.below(3);
      glm::dvec3 target = glm::mix(scene.positions[triangle.vertex[k]],
                                   glm::mix(scene.positions[triangle.vertex[(k + 1) % 3]],
                                            scene.positions[triangle.vertex[(k + 2) % 3]], a),
                                   b);
      if (kind > 0.8)
        target = crowd[random.below(static_cast<std::uint32_t>(crowd.size()))] + near * random.direction();
      const double way = kind < 0.3 ? 3.5 * prepared.reach : random.log_uniform(1e-3, 1e3);
      const glm::dvec3 from = target + way * random.direction();
      const Ray ray = make_ray(from, random.uniform() < 0.5 ? target - from : random.direction());
      for (Hit hit = nearest(prepared, ray, kRayStart, counts); hit.found();
           hit = nearest(prepared, ray, hit, counts)) {
        const Lone lone = lone_hit(prepared, ray, hit, best_isa(), &clearings);
        if (is_clear(prepared, ray, hit, clearings)) {
          ++clear;
          CHECK(others_near(prepared, ray, hit) == 0);
        }
        for (const Isa isa : kIsas) {
          if (!machine_has(isa)) continue;
          const Lone searched = lone_hit(prepared, ray, hit, isa);
          CHECK((searched == lone || searched == Lone::unknown));
          Clearings same(prepared, 1);
          CHECK(is_clear(prepared, ray, hit, same, isa) == is_clear(prepared, ray, hit, clearings));
        }
        ++hits;
        if (lone == Lone::unknown) continue;
        ++lone_hits;
        check_lone(prepared, ray, hit, lone, random);
      }
    }
  }
  CHECK(lone_hits > hits / 2);
  CHECK(clear > hits / 16);
}

TEST_CASE("lone hits: where a ball is clear brute force finds nothing near") {
  Random random(95);
  std::uint64_t hits = 0, clear = 0;
  for (std::uint64_t left = 20 + tier_count("rays_per_case") / 1000; left > 0; --left) {
    std::vector<glm::dvec3> touching;
    Scene scene = touching_balls(random, touching);
    scene.materials[0].reflect = glm::dvec3(0.5);
    const Prepared prepared(scene);
    VisibilityCounts counts;
    Clearings clearings(prepared, 1);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 at = touching[random.below(static_cast<std::uint32_t>(touching.size()))];
      const glm::dvec3 target = at + random.log_uniform(1e-8, 1) * random.direction();
      const double way = random.uniform() < 0.1 ? 300 : random.log_uniform(1e-2, 3);
      const glm::dvec3 from = target + prepared.reach * way * random.direction();
      const Ray ray = make_ray(from, target - from);
      const Hit hit = nearest(prepared, ray, kRayStart, counts);
      if (!hit.found() || primitive_ref(scene, hit.primitive).kind != ObjectKind::sphere) continue;
      ++hits;
      if (!is_clear(prepared, ray, hit, clearings)) continue;
      ++clear;
      const Place place = locate(scene, ray, hit, counts);
      std::uint64_t near = 0;
      for (std::uint32_t other = 0; other < scene.primitive_object.size(); ++other)
        near += other != hit.primitive && stands_near(scene, other, ray, hit, place, counts);
      CHECK(near == 0);
      CHECK(others_near(prepared, ray, hit) == 0);
    }
  }
  CHECK(clear > hits / 3);
  CHECK(clear < hits);
}

TEST_CASE("lone hits: inside a secluded ball brute force finds its far side") {
  Random random(96);
  std::uint64_t secluded = 0;
  for (std::uint64_t left = 20 + tier_count("rays_per_case") / 1000; left > 0; --left) {
    std::vector<glm::dvec3> crowd;
    const Scene scene = crowded_scene(random, crowd);
    const Prepared prepared(scene);
    for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
      if (!prepared.secluded[i]) continue;
      ++secluded;
      const Sphere& ball = scene.spheres[i];
      VisibilityCounts counts;
      for (int k = 0; k < 10; ++k) {
        const Ray ray =
            make_ray(ball.center + ball.radius * random.uniform() * random.direction(), random.direction());
        const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
        const PrimitiveRef met = primitive_ref(scene, hit.primitive);
        CHECK((met.kind == ObjectKind::sphere && met.index == i));
      }
    }
  }
  CHECK(secluded > 20);
}

// A ball in a ball of the same glass is passed, and behind it rays leave where two mirrors meet.
TEST_CASE("lone hits: that a surface was passed says nothing of what is met behind it") {
  Random random(99);
  for (int left = 10; left > 0; --left) {
    Scene scene = empty_scene();
    scene.materials[0].refract = glm::dvec3(0.9);
    Material mirror;
    mirror.name = "mirror";
    mirror.ambient = mirror.reflect = glm::dvec3(0.8);
    add_material(scene, mirror);
    scene.ambient = glm::dvec3(1);
    add_sphere(scene, {{0, 0, -2}, 0.5, 0}, {});
    add_sphere(scene, {{0, 0, -3}, 2.5, 0}, {});
    const double left_z = -4 + random.uniform(0.2, 2), right_z = -4 + random.uniform(0.2, 2);
    PolygonMesh corner = mesh_of(
        {{0, -1, -4}, {0, 1, -4}, {-1, 1, left_z}, {-1, -1, left_z}, {1, 1, right_z}, {1, -1, right_z}},
        {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {0, 5, 4}});
    for (PolygonMesh::Face& face : corner.faces) face.material = 1;
    add_mesh(scene, corner, {}, {});
    const auto prepared = raytrace::prepare(scene);
    const Camera camera = plain_camera(37, 29, 0.3);
    const Frame recursion = raytrace::render_recursively(*prepared, camera, {});
    CHECK(differences(raytrace::render(*prepared, camera, {}), recursion) == "");
  }
}
