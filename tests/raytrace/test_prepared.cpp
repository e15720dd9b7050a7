// SPDX-License-Identifier: MIT
// The tracer's questions: nearest(), blocker() and hits_between() answer as brute force does, bit for bit,
// ties and duplicates included (BVH-5).
#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "common/scene/shapes.h"
#include "raytrace/kernels.h"
#include "raytrace/prepared.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::Prepared;

namespace {

// BVH-5: coordinates on a grid of 2^-6, so that exact ties are common; 5 % of the triangles twice.
Scene scene_on_grid(Random& random, std::uint32_t most_triangles = 400) {
  const auto point = [&] { return 0x1p-6 * random.on_grid(64); };
  Scene scene = empty_scene();
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  const std::uint32_t triangles = 1 + random.below(most_triangles);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    const glm::dvec3 at = point();
    for (int k = 0; k < 3; ++k) positions.push_back(at + 0x1p-6 * random.on_grid(12));
    faces.push_back({first, first + 1, first + 2});
    if (random.below(20) == 0) faces.push_back(faces[random.below(static_cast<std::uint32_t>(faces.size()))]);
  }
  add_mesh(scene, mesh_of(positions, faces), {}, {});
  for (std::uint32_t left = random.below(50); left > 0; --left)
    add_sphere(scene, {point(), 0x1p-6 * (1 + random.below(16)), 0}, {});
  for (std::uint32_t left = random.below(4); left > 0; --left)
    add_plane(scene, {point(), {left == 1, left == 2, left == 3}, 0}, {});
  return scene;
}

// Half of them aimed at a vertex or at the middle of an edge, from the grid.
Ray ray_on_grid(const Scene& scene, Random& random) {
  const glm::dvec3 origin = 0x1p-6 * random.on_grid(96);
  glm::dvec3 direction = 0x1p-6 * random.on_grid(64);
  if (random.uniform() < 0.5) {
    const auto& v = scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))].vertex;
    direction = 0.5 * (scene.positions[v[0]] + scene.positions[v[random.below(2)]]) - origin;
  }
  if (direction == glm::dvec3(0)) direction = {0, 0, 1};
  return {origin, direction};
}

// A hit that intersect() gives for its primitive, or none.
bool is_hit_of(const Scene& scene, const Ray& ray, const Hit& hit) {
  VisibilityCounts counts;
  return !hit.found() || intersect(scene, hit.primitive, ray, kRayStart, counts) == hit;
}

}  // namespace

// BVH-5
TEST_CASE("nearest is nearest_of_all, bit for bit with ties and duplicates, and blocker agrees with it") {
  Random random(5);
  std::uint64_t differing = 0, wrong_blocker = 0, ties = 0;
  constexpr auto exact = raytrace::Precision::exact;
  const std::uint64_t scenes = 200, rays = 1 + tier_count("rays_per_gate") / (5 * scenes);
  for (std::uint64_t i = 0; i < scenes; ++i) {
    const Scene scene = scene_on_grid(random, i % 10 == 0 ? 2000 : 200);
    const Prepared prepared(scene);
    VisibilityCounts counts;
    for (std::uint64_t left = rays; left > 0; --left) {
      const Ray ray = ray_on_grid(scene, random);
      const Hit expected = nearest_of_all(scene, ray, kRayStart, counts);
      const Hit second = nearest_of_all(scene, ray, expected, counts);
      for (const Isa isa : kIsas) {
        if (!machine_has(isa)) continue;
        differing += nearest(prepared, ray, kRayStart, counts, exact, isa) != expected;
        differing += expected.found() && nearest(prepared, ray, expected, counts, exact, isa) != second;
      }
      ties += expected.found() && expected.t == second.t;
      const Hit in_the_sun = blocker(prepared, ray, nullptr, counts);
      wrong_blocker += in_the_sun.found() != expected.found() || !is_hit_of(scene, ray, in_the_sun);

      const glm::dvec3 light = ray.origin + ray.direction;  // exact, on the grid
      bool before = false;
      for (std::uint32_t p = 0; p < scene.primitive_object.size() && !before; ++p) {
        const Hit hit = intersect(scene, p, ray, kRayStart, counts);
        before = hit.found() && before_light(scene, hit, ray, light, counts);
      }
      const Hit in_the_light = blocker(prepared, ray, &light, counts);
      wrong_blocker += in_the_light.found() != before || !is_hit_of(scene, ray, in_the_light);
    }
  }
  const HardCase brute_force("BVH-5");
  brute_force.none("nearest hits unlike brute force in any bit", differing, scenes * rays);
  brute_force.none("blockers unlike brute force", wrong_blocker, 2 * scenes * rays);
  HardCase("TRI-10").none("rays where a blocker and the nearest hit disagree", wrong_blocker,
                          2 * scenes * rays);
  CHECK(ties > 0);
}

TEST_CASE("hits_between is every hit in the interval, in order, those at its ends included") {
  Random random(6);
  std::uint64_t differing = 0, found = 0;
  for (int i = 0; i < 20; ++i) {
    const Scene scene = scene_on_grid(random);
    const Prepared prepared(scene);
    VisibilityCounts counts;
    for (int left = 20; left > 0; --left) {
      const Ray ray = ray_on_grid(scene, random);
      std::vector<Hit> all;
      for (Hit hit = nearest_of_all(scene, ray, kRayStart, counts); hit.found();
           hit = nearest_of_all(scene, ray, hit, counts))
        all.push_back(hit);
      if (all.size() < 2) continue;
      const std::size_t first = random.below(static_cast<std::uint32_t>(all.size()));
      const double last_t = all[first + random.below(static_cast<std::uint32_t>(all.size() - first))].t;
      std::vector<Hit> expected;
      for (std::size_t k = first; k < all.size() && all[k].t <= last_t; ++k) expected.push_back(all[k]);
      for (const Isa isa : kIsas)
        if (machine_has(isa))
          differing += hits_between(prepared, ray, all[first], last_t, counts, isa) != expected;
      found += expected.size();
    }
  }
  CHECK(differing == 0);
  CHECK(found > 0);
}

// Into corners of planes, a box, a faceted ball and a smooth one, with several walls near at once.
TEST_CASE("leaving_point is that of brute force where walls of every kind meet") {
  Random random(7);
  Scene scene = scene_of(star_sphere(8, 9, 0.3, 1));
  add_mesh(scene, make_box({2, 2, 2}), {}, {});
  add_plane(scene, {{0, -0.5, 0}, {0, 1, 0}, 0}, {});
  add_plane(scene, {{0.5, 0, 0}, {1, 0, 0}, 0}, {});
  add_sphere(scene, {{0.75, -0.75, 0}, 0.25, 0}, {});
  const Prepared prepared(scene);
  const auto vertices = static_cast<std::uint32_t>(scene.positions.size());
  const auto coordinate = [&] {
    return std::array{-1.0, -0.5, 0.5, 1.0, random.uniform(-1, 1)}[random.below(5)];
  };
  std::uint64_t differing = 0, moved = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 100; left > 0; --left) {
    const glm::dvec3 target = left % 2 == 0 ? scene.positions[random.below(vertices)]
                                            : glm::dvec3(coordinate(), coordinate(), coordinate());
    const glm::dvec3 eye = random.in_box(1);
    const Ray ray = make_ray(eye, target - eye);
    VisibilityCounts counts;
    for (Hit hit = nearest(prepared, ray, kRayStart, counts); hit.found();
         hit = nearest(prepared, ray, hit, counts)) {
      const Place place = locate(scene, ray, hit, counts);
      const glm::dvec3 from = start_of_leaving(scene, ray, hit, place, counts);
      moved += from != place.point + place.clearance * place.facing;
      for (const Isa isa : kIsas)
        differing += machine_has(isa) && leaving_point(prepared, ray, hit, place, counts, isa) != from;
    }
  }
  CHECK(differing == 0);
  CHECK(moved > 0);
}

TEST_CASE("what casts no shadow blocks nothing") {
  Scene scene = scene_of(Sphere{{0, 0, -5}, 1, 0});
  scene.materials[0].casts_shadow = false;
  const Prepared prepared(scene);
  const Ray ray{{0, 0, 0}, {0, 0, -1}};
  VisibilityCounts counts;
  CHECK_FALSE(blocker(prepared, ray, nullptr, counts).found());
  scene.materials[0].casts_shadow = true;
  CHECK(blocker(prepared, ray, nullptr, counts) == Hit{4, 0});
}

TEST_CASE("an empty scene, and one of planes or degenerate triangles alone, is traversed too") {
  VisibilityCounts counts;
  const Ray down{{0, 1, 0}, {0, -1, 0}};
  const Scene nothing = empty_scene(), flat = scene_of_triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  const Scene floor = scene_of(Plane{{0, 0, 0}, {0, 1, 0}, 0});
  for (const Scene* scene : {&nothing, &flat}) {
    CHECK_FALSE(nearest(Prepared(*scene), down, kRayStart, counts).found());
    CHECK_FALSE(blocker(Prepared(*scene), down, nullptr, counts).found());
    CHECK(hits_between(Prepared(*scene), down, {0.5, 0}, std::numeric_limits<double>::infinity(), counts)
              .empty());
  }
  CHECK(nearest(Prepared(floor), down, kRayStart, counts) == Hit{1, 0});
}

// The float filter decides all signs of a triangle that is clearly met, those of its edges where it is clearly missed; a
// ball has none. A packet asks for a group of sixteen rays, and no side.
TEST_CASE("what is asked is counted: a triangle and its signs, a ball") {
  const Scene flat = scene_of_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
              ball = scene_of(Sphere{{0, 0, 0}, 1, 0});
  const auto check = [](const VisibilityCounts& counts, std::uint64_t tests, std::uint64_t filtered) {
    CHECK(counts.tests == tests);
    CHECK(counts.filtered == filtered);
    CHECK(counts.exact == 0);
  };
  const auto ask = [&](const Scene& scene, const glm::dvec3& target, bool met, std::uint64_t filtered) {
    CAPTURE(met);
    const Prepared prepared(scene);
    const glm::dvec3 eye{0.25, 0.25, 3};
    for (const Isa isa : kIsas) {
      if (!machine_has(isa)) continue;
      std::array<raytrace::RayQuestion, 1> questions;
      questions[0].ray = make_ray(eye, target - eye);
      questions[0].after = kRayStart;
      VisibilityCounts alone, bundled;
      CHECK(nearest(prepared, questions[0].ray, kRayStart, alone, raytrace::Precision::exact, isa).found() ==
            met);
      nearest_beside(prepared, questions, bundled, isa);
      check(alone, 1, filtered);
      check(bundled, 1, filtered);
    }
  };
  ask(flat, {0.2, 0.2, 0}, true, 4);
  ask(flat, {0.9, 0.9, 0}, false, 3);
  ask(ball, {0.2, 0.2, 0}, true, 0);
  ask(ball, {0.99, 0.99, 0}, false, 0);

  CameraSettings camera;
  camera.eye = {0.25, 0.25, 3};
  camera.look_at = {0.25, 0.25, 0};
  camera.view_height = 0.01;
  check(traced(flat, make_camera(camera, 1, 1, 1)).stats.visibility, 16, 3 * 16);
  Scene glass = empty_scene();
  glass.materials[0].refract = glm::dvec3(0.5);
  add_sphere(glass, {{0, 0, 0}, 1, 0}, {});
  glass.trace.depth = 2;  // the second ray meets the ball's far side
  check(traced(glass, make_camera(camera, 1, 1, 1)).stats.visibility, 16 + 1, 0);
}
