// SPDX-License-Identifier: MIT
// Where a ray met a surface: the point lies on it, rays that leave never meet it again (SEC-1) nor start behind another
// one, and they start near. And which points a solid contains.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/model/place.h"
#include "common/scene/shapes.h"
#include "tests/hardcases/result.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/support/wide.h"
#include "tests/support/worst.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr double kU = 0x1p-53;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

struct Departure {
  std::uint64_t rays = 0, hits = 0, again = 0, below = 0;
  Worst highest, mean;   // height of an origin above the surface, in units in the last place
};

// Rays at the body from 3 to 103 sizes away; from each hit, 64 outward rays. `height_above(p)` is the exact
// height of a point above the nearest surface, outside the body; `reach` is the body's largest coordinate,
// whose ulp is the unit.
template <class Height>
Departure depart(const Scene& scene, const glm::dvec3& center, double size, double reach,
                 const Height& height_above) {
  constexpr int kOutward = 64;
  Random random(42);
  SignCounts counts;
  Departure result;
  double sum = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_gate") / kOutward; left > 0; --left) {
    const glm::dvec3 eye = center + size * random.uniform(3, 103) * random.direction();
    const Ray ray = make_ray(eye, center + 0.5 * size * random.direction() - eye);
    const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
    if (!hit.found()) continue;
    ++result.hits;
    const Place place = locate(scene, ray, hit, counts);
    const glm::dvec3 facing = place.facing;
    const glm::dvec3 origin = start_of_leaving(scene, ray, hit, place, counts);
    for (int i = 0; i < kOutward; ++i)
      result.again +=
          nearest_of_all(scene, make_ray(origin, outward(facing, random)), kRayStart, counts).found();

    const double extent = std::max(reach, largest(origin));
    const double ulp = std::nextafter(extent, INFINITY) - extent;
    const double height = static_cast<double>(height_above(quad(origin))) / ulp;
    result.below += height < 0;
    result.highest.add(height);
    sum += height;
  }
  result.rays = kOutward * result.hits;
  result.mean.add(sum / static_cast<double>(result.hits));
  return result;
}

// Several configurations: counts add up, the worst heights are kept.
void add(Departure& all, const Departure& d) {
  CHECK(d.hits > 0);
  all.rays += d.rays;
  all.hits += d.hits;
  all.again += d.again;
  all.below += d.below;
  all.highest.add(d.highest);
  all.mean.add(d.mean);
}

// SEC-1: no ray returns, and the price is at most 64 units in the last place, 32 in the mean.
void report(const Departure& d, const std::string& body) {
  const HardCase leaving("SEC-1");
  leaving.none("rays that leave " + body + " and meet it again", d.again, d.rays);
  leaving.none("origins below " + body, d.below, d.hits);
  leaving.at_most("height of an origin over " + body + ", in ulp", d.highest, 64);
  leaving.at_most("mean height over " + body + ", in ulp", d.mean, 32);
}

constexpr double kPlaces[]{0, 1, 1e3, 1e5, 1e6, 8388607, 1e12};

// Whether a ray from the point crosses the mesh an odd number of times.
bool inside_by_parity(const Scene& scene, const glm::dvec3& point, const glm::dvec3& direction) {
  SignCounts counts;
  std::uint64_t crossings = 0;
  for (Hit hit = nearest_of_all(scene, {point, direction}, kRayStart, counts); hit.found();
       hit = nearest_of_all(scene, {point, direction}, hit, counts))
    ++crossings;
  return crossings % 2 == 1;
}

}  // namespace

TEST_CASE("rays that leave an octahedron never meet it again, wherever it is and however large") {
  Departure all;
  for (const double at : kPlaces)
    for (const double size : {1.0, 1024.0}) {
      CAPTURE(at);
      CAPTURE(size);
      const glm::dvec3 center(at);
      add(all, depart(scene_of(octahedron(center, size)), center, size, at + size, [&](const QuadVec& p) -> Quad {
            const QuadVec q = p - quad(center);
            return (magnitude(q.x) + magnitude(q.y) + magnitude(q.z) - size) / square_root(3);
          }));
    }
  report(all, "an octahedron");
}

TEST_CASE("rays that leave a sphere never meet it again, wherever it is and however large") {
  Departure all;
  for (const double at : kPlaces)
    for (const double radius : {1e-3, 1.0, 1e3}) {
      CAPTURE(at);
      CAPTURE(radius);
      const glm::dvec3 center(at);
      add(all, depart(scene_of(Sphere{center, radius, 0}), center, radius, at + radius,
                      [&](const QuadVec& p) -> Quad { return length(p - quad(center)) - radius; }));
    }
  report(all, "a sphere");
}

TEST_CASE("rays that leave a plane never meet it again, wherever it is") {
  Departure all;
  for (const double at : kPlaces)
    for (const glm::dvec3& normal :
         {glm::dvec3(0, 1, 0), glm::dvec3(1, 2, 2) / 3.0, glm::dvec3(0.36, -0.48, 0.8)}) {
      CAPTURE(at);
      const glm::dvec3 center(at);
      const Scene scene = scene_of(Plane{center, normal, 0});
      add(all, depart(scene, center, 1, at, [&](const QuadVec& p) -> Quad {
            const QuadVec n = quad(scene.planes[0].normal);  // rounded: taken as it is
            return magnitude(dot(n, p - quad(center)) / length(n));
          }));
    }
  report(all, "a plane");
}

// Inside a box: the start lies inside, strictly, and near the point: in clearances, one up, and aside from each of two
// walls two and the rounding of the point, one.
TEST_CASE("rays that leave an edge or a corner of a room start inside, a few clearances from it") {
  const PolygonMesh box = make_box({2, 2, 2});
  const Scene scene = scene_of(box);
  Random random(44);
  SignCounts counts;
  std::uint64_t outside = 0, moved = 0, starts = 0;
  Worst distance;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 20; left > 0; --left, ++starts) {
    // Towards an edge, or a corner where the last coordinate is 1 too.
    glm::dvec3 target{random.below(2) ? 1 : -1, 1, random.below(2) ? 1 : random.uniform(-1, 1)};
    for (std::uint32_t turn = random.below(3); turn > 0; --turn) target = {target.y, target.z, target.x};
    const glm::dvec3 eye = random.in_box(1);
    const Ray ray = make_ray(eye, target - eye);
    const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
    const Place place = locate(scene, ray, hit, counts);
    const glm::dvec3 from = start_of_leaving(scene, ray, hit, place, counts);
    outside += !(largest(from) < 1);
    moved += from != place.point + place.clearance * place.facing;
    distance.add(glm::length(from - place.point) / place.clearance);
  }
  CHECK(starts > 0);
  CHECK(moved > starts / 4);
  CHECK(outside == 0);
  CHECK(distance <= std::sqrt(1.0 + 3 * 3 + 3 * 3));
}

// From outside, the same edges need nothing: no ray that leaves one face can meet the other.
TEST_CASE("rays that leave an edge of a convex body start one clearance above it") {
  const Scene scene = scene_of(octahedron({0, 0, 0}, 1));
  Random random(45);
  SignCounts counts;
  std::uint64_t moved = 0, starts = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 20; left > 0; --left) {
    const double at = random.below(2) ? 0 : random.uniform();
    const glm::dvec3 eye = 3.0 * random.direction();
    const Ray ray = make_ray(eye, glm::dvec3(1 - at, at, 0) - eye);
    const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
    if (!hit.found()) continue;
    const Place place = locate(scene, ray, hit, counts);
    if (!place.entering) continue;   // of two triangles at one depth the lower number is seen: here a back
    ++starts;
    moved += start_of_leaving(scene, ray, hit, place, counts) != place.point + place.clearance * place.facing;
  }
  CHECK(starts > 0);
  CHECK(moved == 0);
}

// A ray that has passed a sheet lies behind it, though it began before it.
TEST_CASE("a start lies on the side from which the ray arrives, also of a surface that it has passed") {
  Scene scene = scene_of(Plane{{0, 0, 0}, {1, 0, 0}, 0});
  add_plane(scene, {{0, 0, 0}, {0, 1, 0}, 0}, {});
  SignCounts counts;
  // Through x = 0 at a height of 2^-52, and on to y = 0, next to where they cross.
  const Ray ray = make_ray({-0.5, 0.5 + 0x1p-52, 0}, {1, -1, 0});
  const Hit passed = intersect(scene, 0, ray, kRayStart, counts), hit = intersect(scene, 1, ray, passed, counts);
  REQUIRE(before(passed, hit));
  const Place place = locate(scene, ray, hit, counts);
  const glm::dvec3 from = start_of_leaving(scene, ray, hit, place, counts);
  CHECK(from.x > 0);
  CHECK(from.y > 0);
}

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
    SignCounts counts;
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
  SignCounts counts;
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
