// SPDX-License-Identifier: MIT
// Hard cases of rays and planes beside those of tests/model: slopes down to nothing (PLN-1), normals of any length, or
// of none (PLN-3).
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "common/model/visibility.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/scenes.h"
#include "tests/support/worst.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

Hit first_hit(const Scene& scene, const Ray& ray) {
  VisibilityCounts counts;
  return intersect(scene, 0, ray, kRayStart, counts);
}

// A ball over a floor with this normal, lit and mirrored.
Scene ball_on(const glm::dvec3& normal) {
  Scene scene = empty_scene();
  scene.materials[0].reflect = glm::dvec3(0.25);
  scene.materials[0].specular = glm::dvec3(0.5);
  scene.lights.push_back(lamp({2, 5, 3}, 1));
  scene.camera.eye = {0.5, 2, 4};
  scene.camera.look_at = {0, 0, 0};
  add_plane(scene, {{0, -0.5, 0}, normal, 0}, {});
  add_sphere(scene, {{0, 0.5, 0}, 1, 0}, {});
  return scene;
}

}  // namespace

TEST_CASE("PLN-1: slopes of a ray over a plane, from 1 down to the least double and to none") {
  const Scene floor = scene_of(Plane{{0, 0, 0}, {0, 1, 0}, 0});
  std::uint64_t wrong = 0, all = 0;
  Worst error;  // of t, in eps
  for (const double slope : {1.0, 1e-8, 1e-20, 1e-38, 1e-45, 1e-90, 0.0})
    for (const double height : {1.0, 0.0, 1e3}) {
      const Hit down = first_hit(floor, make_ray({0, height, 0}, {1, -slope, 0}));
      const Hit up = first_hit(floor, make_ray({0, height, 0}, {1, slope, 0}));
      const bool met = slope > 0 && height > 0;
      wrong += down.found() != met || up.found();
      if (met) error.add(std::abs(down.t * slope / height - 1) / kEps);
      all += 2;
    }
  // No depth is infinite: one that would be is no hit.
  for (const double slope : {0x1p-1074, 1e-300})
    wrong += first_hit(floor, {{0, 1e15, 0}, {1, -slope, 0}}).found(), ++all;
  const HardCase slopes("PLN-1");
  slopes.none("hits of parallel, contained or leaving rays, or misses of others", wrong, all);
  slopes.at_most("error of t = -o.y/d.y in eps", error, 4);
}

TEST_CASE("PLN-3: a plane's normal scaled by 2^k changes no bit of a picture") {
  const glm::dvec3 normal(0.03, 1, -0.1);
  const Scene scene = ball_on(normal);
  const Camera camera = make_camera(scene.camera, 80, 60, 1);
  const Frame flat = test::rastered(scene, camera), deep = test::traced(scene, camera);
  std::uint64_t changed = 0, all = 0;
  for (int k = -40; k <= 40; k += 8) {
    const Scene scaled = ball_on(std::exp2(k) * normal);
    changed += test::differences(test::rastered(scaled, camera), flat) != "";
    changed += test::differences(test::traced(scaled, camera), deep) != "";
    all += 2;
  }
  HardCase("PLN-3").none("pictures that a normal's scale 2^-40 to 2^40 changes in any bit", changed, all);
}

// The exact depth is that of the integers of the normal. A stored component is off by 2 u beside a common factor, which
// cancels (scaled by f: u; divided by the length: u), a dot product of it by 3 u, the difference of points by u: 6 u of
// its sum of magnitudes, above and below, so 3 eps of the condition, if all roundings took one side. The catalogue's 2
// is kept.
TEST_CASE("PLN-3: a plane's depth does not depend on the length of its normal") {
  Random random(43);
  Worst error;  // in eps (|n||p - o|/|n.(p - o)| + |n||d|/|n.d|)
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    glm::dvec3 n = random.on_grid(1000);
    if (n == glm::dvec3(0)) n.x = 1;
    const glm::dvec3 point = random.in_box(10);
    const double factor = std::array{0.1, 3.0, 1e10, 1e-10, 1.0}[random.below(5)];
    const Ray ray{random.in_box(10), random.direction()};
    const Hit hit = first_hit(scene_of(Plane{point, factor * n, 0}), ray);
    if (!hit.found()) continue;
    const QuadVec q = quad(n), apart = quad(point) - quad(ray.origin), d = quad(ray.direction);
    const Quad above = dot(q, apart), below = dot(q, d), t = above / below;
    const Quad condition = length(q) * (length(apart) / magnitude(above) + length(d) / magnitude(below));
    error.add(magnitude((hit.t - t) / t) / (kEps * condition));
  }
  HardCase("PLN-3").at_most("error of t for normals times 0.1, 3, 1e10, 1e-10, in eps of its condition",
                            error, 2);

  std::uint64_t accepted = 0;
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& bad : {glm::dvec3(0), glm::dvec3(0, nan, 1), glm::dvec3(infinity, 0, 0)}) {
    try {
      scene_of(Plane{{0, 0, 0}, bad, 0});
      ++accepted;
    } catch (const InputError&) {
    }
  }
  HardCase("PLN-3").none("normals that are zero or not finite and are let in", accepted, 3);
}
