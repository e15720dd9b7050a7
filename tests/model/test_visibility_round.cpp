// SPDX-License-Identifier: MIT
// Rays and spheres, rays and planes, against the same rays in 113-bit arithmetic: far and huge spheres,
// tangents, origins inside and on the surface, the horizon of a plane.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/visibility.h"
#include "common/scene/camera.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/support/wide.h"
#include "tests/support/worst.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// The roots of |o + t d - c| = r in 113 bits: good to 1e-18 of t even from 1e7 radii away.
struct ExactRoots {
  Quad discriminant = 0;  // r² minus the square of the line's distance
  Quad low = 0, high = 0;

  bool met() const { return discriminant >= 0; }
};
ExactRoots exact_roots(const Sphere& sphere, const Ray& ray) {
  const QuadVec f = quad(ray.origin) - quad(sphere.center), d = quad(ray.direction);
  const Quad dd = dot(d, d), b = -dot(f, d), r = sphere.radius;
  const QuadVec nearest = f + (b / dd) * d;
  const Quad discriminant = r * r - dot(nearest, nearest);
  const Quad half_chord = square_root(discriminant / dd);
  return {discriminant, b / dd - half_chord, b / dd + half_chord};
}

Hit first_hit(const Scene& scene, const Ray& ray, const Hit& after = kRayStart) {
  VisibilityCounts counts;
  return intersect(scene, 0, ray, after, counts);
}

double relative_error(double t, const Quad& exact) {
  return static_cast<double>(magnitude((t - exact) / exact));
}

const Sphere kUnit{};  // around the origin

// The usual way, in floats: whether b² - ac is not negative.
bool unit_sphere_met_in_float(const Ray& ray) {
  const glm::vec3 f(ray.origin), d(ray.direction);
  const float b = glm::dot(f, d), c = glm::dot(f, f) - 1;
  return b * b - glm::dot(d, d) * c >= 0;
}

}  // namespace

// SPH-1
TEST_CASE("a sphere is never missed from up to 1e7 radii, and its depth rounds right to float") {
  Random random(9);
  const Scene scene = scene_of(kUnit);
  std::uint64_t missed = 0, missed_in_float = 0, rays = 0;  // the second: from 1e4 radii
  Worst worst;                                              // error of t in units of a float's eps, of t
  for (double distance = 10; distance <= 1e7; distance *= 10) {
    for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
      const glm::dvec3 origin = distance * random.direction();
      const Ray ray{origin, 0.999 * random.uniform() * across(origin, random) - origin};
      const Hit hit = first_hit(scene, ray);
      const ExactRoots roots = exact_roots(kUnit, ray);
      ++rays;
      missed += !roots.met() || !hit.found();
      missed_in_float += distance == 1e4 && !unit_sphere_met_in_float(ray);
      if (hit.found()) worst.add(relative_error(hit.t, roots.low) / kFloatEps);
    }
  }
  const HardCase far("SPH-1");
  far.none("misses from 10 to 1e7 radii", missed, rays);
  far.at_most("error of t in float eps", worst, 0.5);
  far.at_least("share that b^2 - a c in floats would miss from 1e4 radii",
               static_cast<double>(missed_in_float) / static_cast<double>(tier_count("rays_per_case")), 0.1);
}

// SPH-3
TEST_CASE("a huge sphere serves as the ground") {
  Random random(3);
  std::uint64_t missed = 0, rays = 0;
  Worst worst;
  for (const double radius : {1e2, 1e4, 1e6}) {
    const Sphere ground{{0, -radius, 0}, radius, 0};
    const Scene scene = scene_of(ground);
    for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
      const double away = random.uniform(1, 100), around = random.uniform(0, 6.28);
      const glm::dvec3 target{away * std::cos(around), std::sqrt(radius * radius - away * away) - radius,
                              away * std::sin(around)};
      const Ray ray{{0, 1.7, 0}, target - glm::dvec3(0, 1.7, 0)};
      const ExactRoots roots = exact_roots(ground, ray);
      if (roots.high - roots.low < 1e-5) continue;  // the horizon of a small world: see "grazing rays" below
      const Hit hit = first_hit(scene, ray);
      ++rays;
      missed += !hit.found();
      if (hit.found()) worst.add(relative_error(hit.t, roots.low) / kFloatEps);
    }
  }
  const HardCase ground("SPH-3");
  ground.none("misses of the ground, radius 1e2 to 1e6", missed, rays);
  ground.at_most("error of t in float eps", worst, 1);
}

// SPH-4. The point nearest to the centre is off by 4 u D, D = 10, its square by 8 u D, r² and the sum by a
// few u: at most 128 u, which a ray of width 1e-6 falls into once in 10^8. The narrowest are for what loses more: b² - a c
// is off by some 400 u.
TEST_CASE("grazing rays hit and miss as the exact discriminant says") {
  constexpr double kBand = 64 * kEps;
  Random random(4);
  const Scene scene = scene_of(kUnit);
  std::uint64_t wrong = 0, hits = 0, misses = 0;
  for (const double width : {1e-2, 1e-4, 1e-6, 1e-10, 1e-13})
    for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
      const glm::dvec3 direction = random.direction();
      const double impact = 1 + width * random.uniform(-1, 1);
      const Ray ray{impact * across(direction, random) - 10.0 * direction, direction};
      const ExactRoots roots = exact_roots(kUnit, ray);
      wrong += first_hit(scene, ray).found() != roots.met() && magnitude(roots.discriminant) > kBand;
      ++(roots.met() ? hits : misses);
    }
  HardCase("SPH-4").none("rays within 1e-2 to 1e-13 of a tangent decided wrongly", wrong, hits + misses);
  CHECK(hits > 0);
  CHECK(misses > 0);
}

TEST_CASE("an exact tangent touches once, at its point") {
  const Scene scene = scene_of(kUnit);
  const Ray ray{{-4, 1, 0}, {1, 0, 0}};
  HardCase("SPH-4").holds("an exact tangent touches, once, at t = 4",
                          first_hit(scene, ray) == Hit{4, 0} && !first_hit(scene, ray, {4, 0}).found());
  CHECK_FALSE(first_hit(scene, {{-4, std::nextafter(1.0, 2.0), 0}, {1, 0, 0}}).found());
}

// SPH-5
TEST_CASE("from the centre the sphere is one radius away, whatever the direction's length") {
  Random random(5);
  Worst worst;  // in eps; d.d: 3 roundings of u, halved by the root; root, q and quotient: 1 u each
  for (std::uint64_t left = tier_count("rays_per_case") / 8; left > 0; --left) {
    const double radius = random.log_uniform(1e-3, 1e3);
    const Ray ray{{1, 2, 3}, random.direction()};
    const Hit hit = first_hit(scene_of(Sphere{{1, 2, 3}, radius, 0}), ray);
    const Quad exact = radius / length(quad(ray.direction));
    worst.add(relative_error(hit.t, exact) / kEps);
  }
  HardCase("SPH-5").at_most("error of t from the centre, in eps", worst, 2);
}

TEST_CASE("a ray that starts on a sphere leaves it, crosses it or touches it") {
  const Scene scene = scene_of(kUnit);
  const glm::dvec3 start{1, 0, 0};
  CHECK_FALSE(first_hit(scene, {start, {1, 0, 0}}).found());
  CHECK_FALSE(first_hit(scene, {start, {0.6, 0.8, 0}}).found());
  CHECK_FALSE(first_hit(scene, {start, {0, 1, 0}}).found());      // tangent, at t = 0
  CHECK(first_hit(scene, {start, {-1, 0, 0}}) == Hit{2, 0});      // t = 2 r cos
  CHECK(first_hit(scene, {start, {-3, 4, 0}}).t == 2 * 0.6 / 5);  // cos = 3/5, |d| = 5
}

// With h half the chord: r² - |nearest|² is off by 12 u r², so its root by 6 u r²/h; |f|² - r² by 5 u r² and
// divided by at least h; what remains are a few u of t and r. Hence 12 u (t + r)(1 + r/h), the last factor
// being the condition: SPH-5 names 16 eps (t + r) without it, which rays that all but graze the sphere from
// within cannot keep (4 of 10^6).
TEST_CASE("from inside, the far side is seen, and the ray's length scales its depth exactly") {
  Random random(6);
  const Scene scene = scene_of(kUnit);
  std::uint64_t wrong = 0, rescaled = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const Ray ray{std::cbrt(random.uniform()) * random.direction(), random.direction()};
    const ExactRoots roots = exact_roots(kUnit, ray);
    const Quad half_chord = (roots.high - roots.low) / 2;  // of a unit direction and a unit sphere
    const Hit hit = first_hit(scene, ray);
    wrong += !(magnitude(hit.t - roots.high) <= 6 * kEps * (roots.high + 1) * (1 + 1 / half_chord));
    const double scale = std::exp2(static_cast<double>(random.integer(20)));
    rescaled += first_hit(scene, {ray.origin, scale * ray.direction}).t * scale != hit.t;
  }
  const HardCase inside("SPH-5");
  inside.none("depths from inside beyond 6 eps (t + r)(1 + r/h)", wrong, tier_count("rays_per_case"));
  inside.none("depths that do not scale exactly with the ray's length", rescaled,
              tier_count("rays_per_case"));
}

TEST_CASE("a sphere behind the origin is not seen, both sides of one in front are") {
  const Scene scene = scene_of(kUnit);
  CHECK_FALSE(first_hit(scene, {{0, 0, 3}, {0, 0, 1}}).found());
  const Ray ray{{0, 0, 3}, {0, 0, -1}};
  CHECK(first_hit(scene, ray) == Hit{2, 0});
  CHECK(first_hit(scene, ray, {2, 0}) == Hit{4, 0});
  CHECK_FALSE(first_hit(scene, ray, {4, 0}).found());
}

// PLN-1
TEST_CASE("a plane is met at -o.y/d.y, and not at all by rays that are parallel, in it or leaving it") {
  const Scene scene = scene_of(Plane{{0, 0, 0}, {0, 1, 0}, 0});
  for (const double slope : {0.0, -0.0, 1e-45, 1e-8, 1.0})
    CHECK_FALSE(first_hit(scene, {{0, 1, 0}, {1, slope, 0}}).found());
  for (const double slope : {-1.0, -1e-8, -1e-20, -1e-38, -1e-45, -1e-90}) {
    const Hit hit = first_hit(scene, {{0, 1, 0}, {1, slope, 0}});
    CHECK(hit.found());
    CHECK(std::abs(hit.t * -slope - 1) <= 4 * kEps);
  }
  for (const double slope : {-1.0, -0.0, 0.0, 1.0})
    CHECK_FALSE(first_hit(scene, {{5, 0, 5}, {1, slope, 0}}).found());
  // 1e15 / 1e-300 is beyond double; make_ray's zeroes keep such slopes out, and no hit is ever at infinity
  CHECK_FALSE(first_hit(scene, {{0, 1e15, 0}, {1, -1e-300, 0}}).found());
}

TEST_CASE("the depth of any plane is within four roundings of its condition number") {
  Random random(7);
  std::uint64_t wrong = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const Plane plane{random.in_box(10), random.direction(), 0};
    const Scene scene = scene_of(plane);
    const Ray ray{random.in_box(10), random.direction()};
    const QuadVec n = quad(scene.planes[0].normal);
    const QuadVec apart = quad(plane.point) - quad(ray.origin);
    const Quad above = dot(n, apart), below = dot(n, quad(ray.direction));
    const Hit hit = first_hit(scene, ray);
    wrong += hit.found() != (above / below > 0);
    if (!hit.found()) continue;
    // Each dot product: 3 u of the sum of magnitudes, at most |n||.|; the difference and the quotient u each.
    const Quad condition = length(apart) / magnitude(above) + length(quad(ray.direction)) / magnitude(below);
    wrong += !(magnitude(hit.t - above / below) <= 4 * kEps / 2 * (condition + 1) * hit.t);
  }
  HardCase("PLN-1").none("depths or misses of any plane beyond 2 eps of its condition", wrong,
                         tier_count("rays_per_case"));
}

TEST_CASE("a horizon between two rows of pixels is sharp") {
  const Scene scene = scene_of(Plane{{0, 0, 0}, {0, 1, 0}, 0});
  CameraSettings settings;
  settings.eye = {0, 1, 0};
  settings.look_at = {0, 1, -1};
  const Camera camera = make_camera(settings, 640, 512, 1);
  std::uint64_t wrong = 0;
  for (int Y = 0; Y < camera.rows(); ++Y)
    for (int X = 0; X < camera.columns(); ++X)
      wrong += first_hit(scene, {camera.eye, camera.direction(X, Y)}).found() != (Y >= camera.rows() / 2);
  HardCase("PLN-1").none("pixels on the wrong side of the horizon", wrong, 640 * 512);
}
