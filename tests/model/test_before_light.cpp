// SPDX-License-Identifier: MIT
// SHA-5: does a surface stand before, at or beyond the light? To the last bit for triangles, beyond a band of
// rounding for planes and spheres.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/visibility.h"
#include "tests/hardcases/result.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/support/wide.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Whether the only primitive of the scene blocks the way from `point` to `light`.
bool blocks(const Scene& scene, const glm::dvec3& point, const glm::dvec3& light) {
  VisibilityCounts counts;
  const Ray ray = make_ray(point, light - point);
  const Hit hit = intersect(scene, 0, ray, kRayStart, counts);
  return hit.found() && before_light(scene, hit, ray, light, counts);
}

Scene wall_at(double z) { return scene_of_triangle({-128, -128, z}, {384, -128, z}, {-128, 384, z}); }
Scene plane_at(double z) { return scene_of(Plane{{5, 7, z}, {0, 0, 1}, 0}); }
Scene ball_behind(double z) { return scene_of(Sphere{{0, 0, z + 1}, 1, 0}); }  // its pole at z

// The light is at (0, 0, base + 10), what may block it k units in the last place further up. From straight
// below and from the sides, near and far.
template <class Check>
void for_each_step(double base, const Check& check) {
  const double light = base + 10, ulp = std::nextafter(light, 1e9) - light;
  for (const glm::dvec3& point :
       {glm::dvec3(0, 0, base), glm::dvec3(3, -2, base), glm::dvec3(50, 30, base + 9)})
    for (const int k : {-64, -16, -4, -1, 0, 1, 4, 16, 64}) {
      CAPTURE(base);
      CAPTURE(k);
      check(k, light + k * ulp, point, glm::dvec3(0, 0, light));
    }
}

constexpr double kBases[]{0, 131072};  // 2^17: about 1e5

}  // namespace

TEST_CASE("a triangle blocks a light iff it is nearer, by one unit in the last place") {
  std::uint64_t wrong = 0, all = 0;
  for (const double base : kBases)
    for_each_step(base, [&](int k, double z, const glm::dvec3& point, const glm::dvec3& light) {
      ++all;
      wrong += blocks(wall_at(z), point, light) != (k < 0);
    });
  HardCase("SHA-5").none("triangles within 64 ulp of the light on the wrong side of it", wrong, all);
}

TEST_CASE("a plane or sphere blocks a light iff it is nearer, outside a band of 16 units in the last place") {
  std::uint64_t wrong = 0, all = 0;
  for (const double base : kBases)
    for_each_step(base, [&](int k, double z, const glm::dvec3& point, const glm::dvec3& light) {
      if (std::abs(k) <= 16) return;
      all += 2;
      wrong += blocks(plane_at(z), point, light) != (k < 0);
      wrong += blocks(ball_behind(z), point, light) != (k < 0);
    });
  HardCase("SHA-5").none("planes and spheres 64 ulp from the light on the wrong side of it", wrong, all);
}

TEST_CASE("what is clearly before or beyond the light is told so") {
  const glm::dvec3 point(1, 2, 0), light(0, 0, 10);
  for (const double base : {9.99, 5.0}) {
    CHECK(blocks(wall_at(base), point, light));
    CHECK(blocks(plane_at(base), point, light));
    CHECK(blocks(ball_behind(base), point, light));
  }
  CHECK_FALSE(blocks(wall_at(10.01), point, light));
  CHECK_FALSE(blocks(plane_at(10.01), point, light));
  CHECK_FALSE(blocks(ball_behind(10.01), point, light));
}

TEST_CASE("a light that lies on a surface is not behind it") {
  const glm::dvec3 point(1, 2, 0), light(0, 0, 10);
  const HardCase at("SHA-5");
  at.holds("a triangle through the light does not block it", !blocks(wall_at(10), point, light));
  at.holds("a plane through the light does not block it", !blocks(plane_at(10), point, light));
  at.holds(
      "a sphere through the light does not block it, from either side",
      !blocks(ball_behind(10), point, light) && !blocks(scene_of(Sphere{{0, 0, 8}, 2, 0}), {0, 0, 7}, light));
}

TEST_CASE("a light that lies on a surface as far as doubles let it is not behind it, wherever that is") {
  Random random(47);
  std::uint64_t blocked = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 10; left > 0; --left) {
    const glm::dvec3 at = random.in_box(10), normal = random.direction(), along = across(normal, random);
    const glm::dvec3 up = random.uniform(0.1, 10) * glm::normalize(normal + random.uniform() * along);
    const glm::dvec3 beside = at + random.uniform() * along, pole = at + random.uniform(0.1, 5) * normal;
    blocked += blocks(scene_of(Plane{at, normal, 0}), beside + up, beside);
    blocked += blocks(scene_of(Sphere{at, glm::distance(at, pole), 0}), pole + up, pole);
  }
  CHECK(blocked == 0);
}

TEST_CASE("a sphere stands before a light on its far side, however small it is") {
  for (double radius = 64; radius >= 0x1p-20; radius /= 2) {
    CAPTURE(radius);
    const glm::dvec3 light(0, 0, 1024);
    const Scene scene = scene_of(Sphere{light - glm::dvec3(0, 0, radius), radius, 0});
    CHECK(blocks(scene, {0, 0, 0}, light));
    CHECK(blocks(scene, {radius / 4, radius / 8, 0}, light));
  }
}

TEST_CASE("on integers a triangle blocks exactly where point and light lie on opposite sides") {
  // The light within one unit of the plane of a triangle of size 2^20, the triangle around it.
  Random random(1);
  std::uint64_t wrong = 0, blocked = 0, at = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 point = random.on_grid(1 << 20), v0 = random.on_grid(1 << 20);
    const glm::dvec3 e1 = 8.0 * random.on_grid(1 << 17), e2 = 8.0 * random.on_grid(1 << 17);
    const glm::dvec3 light = v0 + 0.25 * e1 + 0.375 * e2 + random.on_grid(1);
    const std::array<IntVec, 3> a{integers(v0 - point), integers(v0 + e1 - point), integers(v0 + e2 - point)};
    const std::array<IntVec, 3> b{integers(v0 - light), integers(v0 + e1 - light), integers(v0 + e2 - light)};
    const int point_side = sign_of(determinant(a[0], a[1], a[2]));
    const int light_side = sign_of(determinant(b[0], b[1], b[2]));
    bool through = true;  // the ray goes through the triangle, or will
    for (std::size_t k = 0; k < 3; ++k)
      through =
          through &&
          point_side * sign_of(determinant(integers(light - point), a[(k + 1) % 3], a[(k + 2) % 3])) >= 0;
    const bool expected = through && light_side * point_side < 0;
    wrong += blocks(scene_of_triangle(v0, v0 + e1, v0 + e2), point, light) != expected;
    blocked += expected;
    at += light_side == 0;
  }
  HardCase("TRI-10").none("triangles within a unit of the segment's end decided unlike 128-bit integers",
                          wrong, tier_count("rays_per_case"));
  CHECK(blocked > 0);
  CHECK(at > 0);
}

TEST_CASE("a sphere blocks where 113-bit arithmetic finds a root between point and light") {
  // Lights inside, on and outside small spheres far away. Rays within 1e-7 of a tangent may go either way
  // (the squared distance is off by 8 u D/r of r², D/r <= 5e6), and so may roots within a thousandth of the
  // radius of the light: next to a tangent a root moves by the square root of that.
  Random random(2);
  std::uint64_t wrong = 0, blocked = 0, free = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const Sphere sphere{random.in_box(1), random.log_uniform(1e-6, 1), 0};
    const double height = random.uniform() < 0.5 ? 1 : random.uniform(0, 2);
    const glm::dvec3 light = sphere.center + height * sphere.radius * random.direction();
    const glm::dvec3 point = random.in_box(3);

    const QuadVec d = quad(light - point), f = quad(point) - quad(sphere.center);
    const Quad dd = dot(d, d), closest = -dot(f, d) / dd;
    const QuadVec nearest = f + closest * d;
    const Quad r = sphere.radius, discriminant = r * r - dot(nearest, nearest);
    const Quad half_chord = square_root(discriminant / dd), band = r / square_root(dd) / 1000;
    const auto root_before = [&](const Quad& end) {
      const Quad low = closest - half_chord, high = closest + half_chord;
      return (low > 0 && low < end) || (high > 0 && high < end);
    };
    const bool surely = discriminant > Quad(1e-7) * r * r && root_before(1 - band);
    const bool perhaps = discriminant > Quad(-1e-7) * r * r && root_before(1 + band);

    // From inside, intersect() gives the far root; from outside the near one: the first decides.
    const bool answer = blocks(scene_of(sphere), point, light);
    wrong += (surely && !answer) || (!perhaps && answer);
    blocked += surely;
    free += !perhaps;
  }
  HardCase("SHA-5").none("spheres at the light decided unlike 113-bit arithmetic", wrong,
                         tier_count("rays_per_case"));
  CHECK(blocked > 0);
  CHECK(free > 0);
}
