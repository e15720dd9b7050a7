// SPDX-License-Identifier: MIT
// Where a ray met a surface: the point lies on it, rays that leave never meet it again (SEC-1) nor start behind another
// one, and they start near.
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

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

struct Departure {
  std::uint64_t rays = 0, hits = 0, again = 0, below = 0;
  Worst highest, mean;  // height of an origin above the surface, in units in the last place
};

// Rays at the body from 3 to 103 sizes away; from each hit, 64 outward rays. `height_above(p)` is the exact
// height of a point above the nearest surface, outside the body; `reach` is the body's largest coordinate,
// whose ulp is the unit.
template <class Height>
Departure depart(const Scene& scene, const glm::dvec3& center, double size, double reach,
                 const Height& height_above) {
  constexpr int kOutward = 64;
  Random random(42);
  VisibilityCounts counts;
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

}  // namespace

TEST_CASE("rays that leave an octahedron never meet it again, wherever it is and however large") {
  Departure all;
  for (const double at : kPlaces)
    for (const double size : {1.0, 1024.0}) {
      CAPTURE(at);
      CAPTURE(size);
      const glm::dvec3 center(at);
      add(all,
          depart(scene_of(octahedron(center, size)), center, size, at + size, [&](const QuadVec& p) -> Quad {
            const QuadVec q = p - quad(center);
            return (magnitude(q.x) + magnitude(q.y) + magnitude(q.z) - size) / square_root(Quad(3));
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
  VisibilityCounts counts;
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
  VisibilityCounts counts;
  std::uint64_t moved = 0, starts = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 20; left > 0; --left) {
    const double at = random.below(2) ? 0 : random.uniform();
    const glm::dvec3 eye = 3.0 * random.direction();
    const Ray ray = make_ray(eye, glm::dvec3(1 - at, at, 0) - eye);
    const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
    if (!hit.found()) continue;
    const Place place = locate(scene, ray, hit, counts);
    if (!place.entering) continue;  // of two triangles at one depth the lower number is seen: here a back
    ++starts;
    moved += start_of_leaving(scene, ray, hit, place, counts) != place.point + place.clearance * place.facing;
  }
  CHECK(starts > 0);
  CHECK(moved == 0);
}

// Between two planes at so small an angle that no few steps aside bring a point off both.
TEST_CASE("rays that leave a sharp corner start on the way that led into it") {
  Random random(46);
  VisibilityCounts counts;
  for (int left = 100; left > 0; --left) {
    const double slope = random.log_uniform(1e-4, 1e-1);
    const glm::dvec3 corner = random.in_box(1),
                     eye = corner + glm::dvec3(1, slope / 2, random.uniform(-1, 1));
    Scene scene = scene_of(Plane{corner, {0, 1, 0}, 0});
    add_plane(scene, {corner, glm::normalize(glm::dvec3(slope, -1, 0)), 0}, {});
    const Ray ray = make_ray(eye, corner - eye);
    const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
    REQUIRE(hit.found());
    const Place place = locate(scene, ray, hit, counts);
    const glm::dvec3 from = start_of_leaving(scene, ray, hit, place, counts);
    for (std::uint32_t plane = 0; plane < 2; ++plane)
      CHECK(side_of(scene, plane, from, counts) == side_of(scene, plane, eye, counts));
    const glm::dvec3 d = glm::normalize(ray.direction), off = from - corner;
    // Of coordinates of at most 1: the product t d, the point, on the plane and off it again, each rounded by 2^-53 at most;
    // sqrt(3) times that.
    CHECK(glm::length(off - glm::dot(off, d) * d) < 0x1p-50);
    // At a distance w it is more than w slope / 3 above both planes; that is beyond their clearance, below 2^-48, from w =
    // 3 2^-48 / slope on, and w is doubled until it is. With room for what the point is off by.
    CHECK(glm::length(off) < 0x1p-40 / slope);
  }
}

// A ray that has passed a sheet lies behind it, though it began before it.
TEST_CASE("a start lies on the side from which the ray arrives, also of a surface that it has passed") {
  Scene scene = scene_of(Plane{{0, 0, 0}, {1, 0, 0}, 0});
  add_plane(scene, {{0, 0, 0}, {0, 1, 0}, 0}, {});
  VisibilityCounts counts;
  // Through x = 0 at a height of 2^-52, and on to y = 0, next to where they cross.
  const Ray ray = make_ray({-0.5, 0.5 + 0x1p-52, 0}, {1, -1, 0});
  const Hit passed = intersect(scene, 0, ray, kRayStart, counts),
            hit = intersect(scene, 1, ray, passed, counts);
  REQUIRE(before(passed, hit));
  const Place place = locate(scene, ray, hit, counts);
  const glm::dvec3 from = start_of_leaving(scene, ray, hit, place, counts);
  CHECK(from.x > 0);
  CHECK(from.y > 0);
}
