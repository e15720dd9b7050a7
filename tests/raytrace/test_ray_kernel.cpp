// SPDX-License-Identifier: MIT
// The single-ray kernels: on every instruction set the answers of brute force in every bit, with the same counts,
// whatever the scene's size, place and shape.
#include <doctest/doctest.h>

#include "raytrace/kernels.h"
#include "tests/hardcases/result.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::Precision;
using raytrace::Prepared;

namespace {

// Where a scene's unit box stands in the world.
struct Placement {
  double size;
  glm::dvec3 at;
};
constexpr double kThird = 1.0 / 3;
const Placement kPlacements[]{{1, {0, 0, 0}},        {1, {0, 2, 0}},       {1e-3, {1e3, -1e3, kThird}},
                              {1, {1e6, 1e6, -1e6}}, {1e12, {0, 0, 1e12}}, {1e-25, {0, 0, 0}}};

// Triangles, needles and points among them, on a floor, with balls.
Scene random_scene(const Placement& placement, Random& random) {
  Scene scene = empty_scene();
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  const auto corner = [&](const glm::dvec3& p) { positions.push_back(placement.at + placement.size * p); };
  const auto face = [&] {
    const auto last = static_cast<std::uint32_t>(positions.size());
    faces.push_back({last - 3, last - 2, last - 1});
  };
  for (const double z : {-2.0, 2.0}) {
    corner({-2, -1, -2});
    corner({2, -1, -z});
    corner({z, -1, 2});
    face();
  }
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 p = random.in_box(1), along = random.direction();
    const double width = random.log_uniform(1e-6, 0.3);
    corner(p);
    corner(p + 0.3 * along);
    corner(i % 10 == 0 ? p + 0.1 * along : p + width * random.direction());
    face();
  }
  add_mesh(scene, mesh_of(positions, faces), {}, {});
  for (int i = 0; i < 40; ++i)
    add_sphere(
        scene,
        {placement.at + placement.size * random.in_box(1), placement.size * random.log_uniform(1e-4, 0.3), 0},
        {});
  return scene;
}

Ray random_ray(const Scene& scene, const Placement& placement, Random& random) {
  const glm::dvec3 from = random.in_box(random.uniform() < 0.5 ? 1 : 20);
  glm::dvec3 direction = random.in_box(1) - from;
  if (random.uniform() < 0.2) direction[static_cast<int>(random.below(3))] = 0;
  const glm::dvec3 origin = placement.at + placement.size * from;
  if (random.uniform() < 0.3) {  // at a corner
    const auto& v = scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))].vertex;
    return make_ray(origin, scene.positions[v[0]] - origin);
  }
  return make_ray(origin, random.log_uniform(1e-3, 1e3) * direction);
}

bool same(const VisibilityCounts& a, const VisibilityCounts& b) {
  return a.nodes == b.nodes && a.tests == b.tests && a.filtered == b.filtered && a.in_double == b.in_double &&
         a.exact == b.exact;
}

bool is_blocked(const Scene& scene, const Ray& ray, const glm::dvec3* light) {
  VisibilityCounts counts;
  for (std::uint32_t p = 0; p < scene.primitive_object.size(); ++p) {
    const Hit hit = intersect(scene, p, ray, kRayStart, counts);
    if (hit.found() && (!light || before_light(scene, hit, ray, *light, counts))) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("BVH: nearest, blocker and leaving_point are those of brute force on every instruction set") {
  Random random(77);
  std::uint64_t differing = 0, uneven = 0, left = 0, asked = 0;
  const std::uint64_t rays = 1 + tier_count("rays_per_case") / 200;
  for (const Placement& placement : kPlacements) {
    const Scene scene = random_scene(placement, random);
    const Prepared prepared(scene);
    for (std::uint64_t i = 0; i < rays; ++i) {
      const Ray ray = random_ray(scene, placement, random);
      VisibilityCounts counts;
      const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
      const Place place = hit.found() ? locate(scene, ray, hit, counts) : Place{};
      const glm::dvec3 from = hit.found() ? start_of_leaving(scene, ray, hit, place, counts) : ray.origin;
      // What leaves there: towards a lamp, or to infinity.
      const glm::dvec3 lamp = placement.at + placement.size * random.in_box(3);
      const Ray leaving = make_ray(from, lamp - from);
      const glm::dvec3* light = i % 2 == 0 ? &lamp : nullptr;
      const bool blocked = is_blocked(scene, leaving, light);
      std::optional<std::pair<VisibilityCounts, Hit>> first;
      for (const Isa isa : kIsas) {
        if (!machine_has(isa)) continue;
        VisibilityCounts own;
        differing += nearest(prepared, ray, kRayStart, own, Precision::exact, isa) != hit;
        const Hit blocker =
            raytrace::blocker(prepared, leaving, light, own, kRayStart, Precision::exact, isa);
        differing += blocker.found() != blocked;
        if (hit.found()) differing += leaving_point(prepared, ray, hit, place, own, isa) != from;
        if (!first) first = {own, blocker};
        uneven += !same(first->first, own) || first->second != blocker;
        ++asked;
      }
      left += hit.found();
    }
  }
  CHECK(differing == 0);
  CHECK(uneven == 0);
  CHECK(left > asked / 20);
}

// Rays that go together and rays that do not, some of them with a past, some not finite; bundles that are not full.
TEST_CASE("BVH: what rays of a bundle meet they meet alone, on every instruction set") {
  Random random(80);
  std::uint64_t differing = 0, uneven = 0, found = 0, asked = 0;
  for (const Placement& placement : kPlacements) {
    const Scene scene = random_scene(placement, random);
    const Prepared prepared(scene);
    for (std::uint64_t left = 1 + tier_count("rays_per_case") / 2000; left > 0; --left) {
      std::vector<raytrace::RayQuestion> questions(1 + random.below(40));
      const Ray ray = random_ray(scene, placement, random);
      const double apart = random.log_uniform(1e-9, 10) * placement.size;
      const bool broken = random.uniform() < 0.1;
      for (auto& question : questions) {
        question.ray =
            make_ray(ray.origin + apart * random.in_box(1), ray.direction + apart * random.in_box(1));
        if (broken && random.uniform() < 0.2) question.ray.direction.x = std::nan("");
        VisibilityCounts counts;
        const Hit hit = nearest(prepared, question.ray, kRayStart, counts);
        question.after = random.uniform() < 0.3 && hit.found() ? hit : kRayStart;
        if (random.uniform() < 0.3) question.except = hit.primitive;
        if (random.uniform() < 0.3 && hit.found() && question.except != hit.primitive &&
            question.after == kRayStart)
          question.best = hit;
      }
      std::optional<VisibilityCounts> first;
      for (const Isa isa : kIsas) {
        if (!machine_has(isa)) continue;
        auto bundled = questions;
        VisibilityCounts counts, alone;
        nearest_beside(prepared, bundled, counts, isa);
        for (std::size_t i = 0; i < questions.size(); ++i) {
          const auto& [way, after, except, best] = questions[i];
          const Hit expected = nearest_beside(prepared, way, after, except, best, alone, isa);
          differing += bundled[i].best != expected;
          found += expected.found();
          ++asked;
        }
        if (!first) first = counts;
        uneven += !same(*first, counts);
      }
    }
  }
  CHECK(differing == 0);
  CHECK(uneven == 0);
  CHECK(found > asked / 5);
}

TEST_CASE("BVH: shadow rays of a bundle are blocked where they are alone, on every instruction set") {
  Random random(81);
  std::uint64_t differing = 0, uneven = 0, blocked = 0, asked = 0;
  for (const Placement& placement : kPlacements) {
    Scene scene = random_scene(placement, random);
    scene.materials.at(0).casts_shadow = &placement != &kPlacements[1];
    const Prepared prepared(scene);
    for (std::uint64_t left = 1 + tier_count("rays_per_case") / 2000; left > 0; --left) {
      std::vector<raytrace::ShadowQuestion> questions(1 + random.below(40));
      const Ray ray = random_ray(scene, placement, random);
      const glm::dvec3 light = ray.origin + random.log_uniform(0.1, 3) * ray.direction;
      const bool directional = random.uniform() < 0.3;
      const double apart = random.log_uniform(1e-9, 3) * placement.size;
      for (auto& question : questions) {
        const glm::dvec3 origin = ray.origin + apart * random.in_box(1);
        question.ray = make_ray(origin, directional ? ray.direction : light - origin);
        if (random.uniform() < 0.02) question.ray.direction.x = std::nan("");
      }
      std::optional<VisibilityCounts> first;
      for (const Isa isa : kIsas) {
        if (!machine_has(isa)) continue;
        auto bundled = questions;
        VisibilityCounts counts, alone;
        find_blocked(prepared, bundled, directional ? nullptr : &light, counts, isa);
        for (std::size_t i = 0; i < questions.size(); ++i) {
          const bool expected = blocker(prepared, questions[i].ray, directional ? nullptr : &light, alone,
                                        kRayStart, Precision::exact, isa)
                                    .found();
          differing += bundled[i].blocked != expected;
          blocked += expected;
          ++asked;
        }
        if (!first) first = counts;
        uneven += !same(*first, counts);
      }
    }
  }
  CHECK(differing == 0);
  CHECK(uneven == 0);
  CHECK(blocked > asked / 10);
}

// Balls whose near ends are at the light, just before it or just beyond it, at all distances down to rounding.
TEST_CASE("BVH: balls next to a light block the rays of a bundle that meet them before it") {
  Random random(82);
  std::uint64_t differing = 0, blocked = 0, asked = 0;
  for (std::uint64_t left = 50 + tier_count("rays_per_case") / 100; left > 0; --left) {
    Scene scene = empty_scene();
    const glm::dvec3 light = random.log_uniform(1e-3, 1e3) * random.direction(), to = random.direction();
    const double way = random.log_uniform(1e-2, 1e2);
    for (int i = 0; i < 4; ++i) {
      const double radius = way * random.log_uniform(1e-3, 10), gap = way * random.log_uniform(1e-17, 1e-3);
      add_sphere(scene, {light + (radius + (i % 2 == 0 ? gap : -gap)) * to, radius, 0}, {});
      if (random.uniform() < 0.7) break;
    }
    const Prepared prepared(scene);
    std::vector<raytrace::ShadowQuestion> questions(20);
    for (auto& question : questions) {
      const glm::dvec3 origin = light - way * (to + random.log_uniform(1e-9, 0.1) * random.direction());
      question.ray = make_ray(origin, light - origin);
    }
    for (const Isa isa : kIsas) {
      if (!machine_has(isa)) continue;
      auto bundled = questions;
      VisibilityCounts counts;
      find_blocked(prepared, bundled, &light, counts, isa);
      for (std::size_t i = 0; i < questions.size(); ++i) {
        const bool expected = is_blocked(scene, questions[i].ray, &light);
        differing += bundled[i].blocked != expected;
        blocked += expected;
        ++asked;
      }
    }
  }
  CHECK(differing == 0);
  CHECK(blocked > asked / 5);
  CHECK(blocked < asked - asked / 5);
}

TEST_CASE("BVH: a ray that starts in the plane of a floor does not meet it") {
  Random random(78);
  const Scene scene = random_scene(kPlacements[0], random);
  const Prepared prepared(scene);
  std::uint64_t differing = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{{random.uniform(-1, 1), -1, random.uniform(-1, 1)}, random.direction()};
    VisibilityCounts counts;
    const Hit expected = nearest_of_all(scene, ray, kRayStart, counts);
    for (const Isa isa : kIsas)
      differing +=
          machine_has(isa) && nearest(prepared, ray, kRayStart, counts, Precision::exact, isa) != expected;
  }
  CHECK(differing == 0);
}

// Seen from everywhere, nearly edge-on too, where the depth is an exact quotient.
TEST_CASE("met_triangle is intersect of a triangle that is met, whose plane is not behind") {
  Random random(79);
  std::uint64_t differing = 0, hits = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const double flat = random.log_uniform(1e-12, 1), far = random.log_uniform(1e-3, 1e6);
    const glm::dvec3 v0 = random.in_box(1), v1 = random.in_box(1), v2 = v0 + flat * random.in_box(1);
    const Scene scene = scene_of_triangle(v0, v1, v2);
    const double a = random.uniform(), b = random.uniform() * (1 - a);
    const glm::dvec3 target = v0 + a * (v1 - v0) + b * (v2 - v0);
    glm::dvec3 origin = far * random.direction();
    if (random.uniform() < 0.5)
      origin = target + far * (v1 - v0) + random.log_uniform(1e-14, 1) * random.direction();
    const Ray ray = make_ray(origin, target - origin);
    VisibilityCounts counts;
    const Hit hit = intersect(scene, 0, ray, kRayStart, counts);
    if (!hit.found()) continue;
    ++hits;
    differing += met_triangle(v0, v1, v2, 0, ray, kRayStart) != hit || plane_behind(v0, v1, v2, ray);
  }
  CHECK(differing == 0);
  CHECK(hits > 1000);
}
