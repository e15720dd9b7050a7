// SPDX-License-Identifier: MIT
// The place of a hit: its point, its side, its barycentrics, for each kind of primitive.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/place.h"
#include "common/model/visibility.h"
#include "tests/support/approx.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"
#include "tests/support/wide.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

// From locate_triangle: E / sum is off by 3 u (quotient, sum of three), so the sum of all by 4 u and the
// rounding of this test; the point by 12 u reach along the normal, the clearance being 16; the ray's own
// error is not the point's.
TEST_CASE("barycentrics add up to 1 and the point lies on its triangle, whatever the triangle") {
  Random random(3);
  std::uint64_t off_sum = 0, off_plane = 0, off_ray = 0, outside = 0, wrong_side = 0, hits = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const double size = random.log_uniform(1e-3, 1e3);
    const glm::dvec3 center = random.in_box(random.log_uniform(1e-3, 1e6)),
                     origin = center + random.in_box(10 * size);
    const std::array<glm::dvec3, 3> v{center + random.in_box(size), center + random.in_box(size),
                                      center + random.in_box(size * random.log_uniform(1e-3, 1))};
    const double b0 = random.uniform(), b1 = random.uniform() * (1 - b0);
    const Ray ray{origin, b0 * v[0] + b1 * v[1] + (1 - b0 - b1) * v[2] - origin};
    const Scene scene = scene_of_triangle(v[0], v[1], v[2]);
    VisibilityCounts counts;
    const Hit hit = intersect(scene, 0, ray, kRayStart, counts);
    if (!hit.found()) continue;
    ++hits;
    const Place place = locate(scene, ray, hit, counts);
    const auto& b = place.barycentric;
    off_sum += !(std::abs(b[0] + b[1] + b[2] - 1) <= 8 * kU);
    for (const double weight : b) outside += !(weight >= 0 && weight <= 1);

    const QuadVec n = cross(quad(v[1]) - quad(v[0]), quad(v[2]) - quad(v[0]));
    const Quad height = dot(n, quad(place.point) - quad(v[0])) / length(n);
    off_plane += !(magnitude(height) <= 0.75 * place.clearance);
    // Across the plane: three weights off by 2^-19 of corners at most 4 sizes apart, and depth's 2^-18 along
    // the ray.
    const double along = hit.t * glm::length(ray.direction);
    off_ray += !(glm::length(origin + hit.t * ray.direction - place.point) <= 0x1p-16 * (size + along));
    wrong_side += place.entering != (dot(n, quad(origin) - quad(v[0])) > 0);
  }
  CHECK(hits > 0);
  CHECK(off_sum == 0);
  CHECK(outside == 0);
  CHECK(off_plane == 0);
  CHECK(off_ray == 0);
  CHECK(wrong_side == 0);
}

TEST_CASE("locate worked out by hand for each kind of primitive") {
  VisibilityCounts counts;
  const auto place_at = [&](const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction) {
    const Ray ray{origin, direction};
    return locate(scene, ray, intersect(scene, 0, ray, kRayStart, counts), counts);
  };
  const Place outside = place_at(scene_of(Sphere{{0, 0, 5}, 2, 0}), {0, 0, 0}, {0, 0, 1});
  CHECK(outside.point == glm::dvec3(0, 0, 3));
  CHECK(outside.outward == glm::dvec3(0, 0, -1));
  CHECK(outside.entering);
  const Place inside = place_at(scene_of(Sphere{{0, 0, 5}, 2, 0}), {0, 0, 5}, {0, 0, 1});
  CHECK(inside.point == glm::dvec3(0, 0, 7));
  CHECK(inside.outward == glm::dvec3(0, 0, 1));
  CHECK_FALSE(inside.entering);

  const Scene water = scene_of(Plane{{0, -1, 0}, {0, 1, 0}, 0});
  CHECK(place_at(water, {0, 0, 0}, {1, -0.5, 0}).point == glm::dvec3(2, -1, 0));
  CHECK(place_at(water, {0, 0, 0}, {1, -0.5, 0}).entering);
  CHECK_FALSE(place_at(water, {0, -2, 0}, {1, 0.5, 0}).entering);
  CHECK(place_at(water, {0, -2, 0}, {1, 0.5, 0}).outward == glm::dvec3(0, 1, 0));

  const Scene triangle = scene_of_triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  const Place front = place_at(triangle, {1, 2, 8}, {0, 0, -2});
  CHECK(front.point == glm::dvec3(1, 2, 0));
  CHECK(front.outward == glm::dvec3(0, 0, 1));
  CHECK(front.barycentric == std::array{0.25, 0.25, 0.5});
  CHECK(front.entering);
  CHECK_FALSE(place_at(triangle, {1, 2, -8}, {0, 0, 2}).entering);
}
