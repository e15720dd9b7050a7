// SPDX-License-Identifier: MIT
// Which points a solid contains.
#include "common/model/solid.h"

#include <doctest/doctest.h>

#include "common/scene/shapes.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Whether a ray from the point crosses the mesh an odd number of times.
bool inside_by_parity(const Scene& scene, const glm::dvec3& point, const glm::dvec3& direction) {
  VisibilityCounts counts;
  std::uint64_t crossings = 0;
  for (Hit hit = nearest_of_all(scene, {point, direction}, kRayStart, counts); hit.found();
       hit = nearest_of_all(scene, {point, direction}, hit, counts))
    ++crossings;
  return crossings % 2 == 1;
}

}  // namespace

TEST_CASE("a sphere and a plane contain what lies behind their surface") {
  const Scene ball = scene_of(Sphere{{1, 2, 3}, 2, 0});
  CHECK(contains(ball, ball.objects[0], {1, 2, 4.999}));
  CHECK_FALSE(contains(ball, ball.objects[0], {1, 2, 5.001}));
  CHECK(contains(ball, ball.objects[0], {1, 2, 3}));
  const Scene water = scene_of(Plane{{0, 1, 0}, {0, 1, 0}, 0});
  CHECK(contains(water, water.objects[0], {1e6, 0.999, -1e6}));
  CHECK_FALSE(contains(water, water.objects[0], {1e6, 1.001, -1e6}));
}

TEST_CASE("a closed mesh contains a point iff a ray from it crosses the mesh an odd number of times") {
  const Scene box = scene_of(make_box({2, 4, 6})), torus = scene_of(make_torus(1, 0.4, 16, 8));
  const Scene star = scene_of(star_sphere(9, 8, 1, 3));
  Random random(5);
  std::uint64_t wrong = 0, inside = 0, tested = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 64; left > 0; --left)
    for (const Scene* scene : {&box, &torus, &star}) {
      const glm::dvec3 point = random.in_box(2);
      const bool expected = inside_by_parity(*scene, point, random.direction());
      wrong += contains(*scene, scene->objects[0], point) != expected;
      inside += expected;
      ++tested;
    }
  CHECK(wrong == 0);
  CHECK(inside > 0);
  CHECK(inside < tested);
  CHECK(contains(box, box.objects[0], {0.999, 1.999, -2.999}));
  CHECK_FALSE(contains(box, box.objects[0], {1.001, 0, 0}));
  CHECK_FALSE(contains(torus, torus.objects[0], {0, 0, 0}));  // the hole
  CHECK(contains(torus, torus.objects[0], {1, 0, 0}));        // the tube
}
