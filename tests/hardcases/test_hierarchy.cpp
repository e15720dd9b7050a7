// SPDX-License-Identifier: MIT
// Hard cases of the hierarchy beside those of tests/raytrace: zeros with a sign (BVH-2), flat boxes (BVH-3), one bad
// primitive among good ones (BVH-7) and rays that are not finite (BVH-8).
#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <limits>

#include "common/scene/shapes.h"
#include "raytrace/prepared.h"
#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::Prepared;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// From inside and outside the box of half edge 1: along an axis, along a diagonal, next to parallel to two faces, at
// edges and corners, free.
Ray ray_at_box(Random& random) {
  const double far = random.uniform() < 0.5 ? 1 : 3;
  glm::dvec3 origin = random.in_box(far);
  if (random.uniform() < 0.5) origin = 0.25 * random.on_grid(static_cast<std::int64_t>(4 * far));
  const int axis = static_cast<int>(random.below(3));
  glm::dvec3 direction(0);
  switch (random.below(5)) {
    case 0:
      direction[axis] = random.uniform() < 0.5 ? 1 : -1;
      break;
    case 1:
      direction = {1, random.uniform() < 0.5 ? 1 : -1, random.uniform() < 0.5 ? 1 : -1};
      break;
    case 2:
      direction = random.direction();
      direction[axis] = 1e-7;
      break;
    case 3:
      direction = random.on_grid(1) - origin;
      break;
    default:
      direction = random.direction();
  }
  return direction == glm::dvec3(0) ? Ray{origin, {0, 0, 1}} : make_ray(origin, direction);
}

bool meets_anything(const Prepared& prepared, const Ray& ray, const Hit& after) {
  VisibilityCounts counts;
  const glm::dvec3 light = ray.origin + ray.direction;
  return raytrace::nearest(prepared, ray, after, counts).found() ||
         nearest_of_all(prepared.scene, ray, after, counts).found() ||
         raytrace::blocker(prepared, ray, nullptr, counts).found() ||
         raytrace::blocker(prepared, ray, &light, counts).found() ||
         !raytrace::hits_between(prepared, ray, {0, 0}, kInfinity, counts).empty();
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

// Each zero of a direction by itself and both, for every instruction set.
TEST_CASE("BVH-2: the sign of any zero in a direction changes no hit") {
  const Scene scene = scene_of(star_sphere(24, 24, 1, 2));
  const Prepared prepared(scene);
  VisibilityCounts counts;
  std::uint64_t differing = 0, hits = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = -32; i <= 32; ++i)
      for (int k = -32; k <= 32; ++k) {
        Ray ray{glm::dvec3(0), glm::dvec3(0)};
        ray.origin[axis] = 4;
        ray.origin[(axis + 1) % 3] = i / 32.0;
        ray.origin[(axis + 2) % 3] = k / 32.0;
        ray.direction[axis] = -1;
        const Hit hit = raytrace::nearest(prepared, ray, kRayStart, counts);
        hits += hit.found();
        for (const int negative : {1, 2, 3}) {
          if (negative & 1) ray.direction[(axis + 1) % 3] = -0.0;
          if (negative & 2) ray.direction[(axis + 2) % 3] = -0.0;
          for (const Isa isa : kIsas)
            differing += machine_has(isa) && raytrace::nearest(prepared, ray, kRayStart, counts,
                                                               raytrace::Precision::exact, isa) != hit;
          ray.direction[(axis + 1) % 3] = ray.direction[(axis + 2) % 3] = 0;
        }
      }
  HardCase("BVH-2").none("hits that one -0 or two change, with any instruction set", differing, hits);
}

// Of normals, the zeros keep their sign.
TEST_CASE("BVH-2: the sign of zeros in a scene changes no bit of a picture") {
  const auto signed_zeros = [](double zero) {
    const auto with = [zero](const glm::dvec3& v) {
      return glm::dvec3(v.x == 0 ? zero : v.x, v.y == 0 ? zero : v.y, v.z == 0 ? zero : v.z);
    };
    return moved(everything(), with, with);
  };
  const auto pictures = [](const Scene& scene) {
    std::array<Frame, 2> both{rastered(scene, relation_camera(scene)), traced(scene, relation_camera(scene))};
    for (Frame& frame : both)
      for (glm::vec3& normal : frame.normal) normal += glm::vec3(0);
    return both;
  };
  const Scene plus = signed_zeros(0.0), minus = signed_zeros(-0.0);
  std::uint64_t zeros = 0;
  for (const glm::dvec3& p : minus.positions)
    for (int axis = 0; axis < 3; ++axis) zeros += p[axis] == 0 && std::signbit(p[axis]);
  CHECK(zeros > 0);
  const auto a = pictures(plus), b = pictures(minus);
  CHECK(differences(a[0], b[0]) == "");
  CHECK(differences(a[1], b[1]) == "");
  HardCase("BVH-2").holds("a scene's zeros with the other sign give the same pictures",
                          differences(a[0], b[0]).empty() && differences(a[1], b[1]).empty());
}

TEST_CASE("BVH-3: flat boxes are met as brute force meets their triangles") {
  const Scene box = scene_of(make_box({2, 2, 2}));  // twelve triangles with flat boxes
  const Prepared prepared(box);
  Random random(31);
  VisibilityCounts counts;
  std::uint64_t differing = 0, leaked = 0, inside = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const Ray ray = ray_at_box(random);
    const Hit hit = raytrace::nearest(prepared, ray, kRayStart, counts);
    differing += hit != nearest_of_all(box, ray, kRayStart, counts);
    if (!(std::max({std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)}) < 1)) continue;
    ++inside;
    leaked += !hit.found();
  }
  const HardCase flat("BVH-3");
  flat.none("hits unlike brute force in any bit", differing, tier_count("rays_per_case"));
  flat.none("rays that leave a closed box of quads", leaked, inside);
}

TEST_CASE("BVH-7: a bad primitive is refused by its number") {
  const PolygonMesh star = star_sphere(24, 24, 0.2, 2);
  std::uint64_t accepted = 0, all = 0;
  for (const double bad : {kNaN, kInfinity, -kInfinity, 3e38, 1.1e15}) {
    PolygonMesh mesh = star;
    mesh.positions[100].y = bad;
    std::string message;
    try {
      scene_of(mesh);
    } catch (const InputError& error) {
      message = error.what();
    }
    accepted += message.find("vertex 101") == std::string::npos;
    Scene scene = empty_scene();
    const auto refused = [&](const auto& add) {
      try {
        add();
      } catch (const InputError&) {
        return true;
      }
      return false;
    };
    accepted += !refused([&] { add_sphere(scene, {{0, bad, 0}, 1, 0}, {}); });
    accepted += !refused([&] { add_sphere(scene, {{0, 0, 0}, bad, 0}, {}); });
    accepted += !refused([&] { add_plane(scene, {{bad, 0, 0}, {0, 1, 0}, 0}, {}); });
    all += 4;
  }
  HardCase("BVH-7").none("primitives with NaN, infinity or 3e38 that are not refused", accepted, all);
}

// The largest and the smallest that are let in, beside a mesh of size 1.
TEST_CASE("BVH-7: the largest primitive that is let in hides no other") {
  const Scene without = scene_of(star_sphere(24, 24, 0.2, 2));
  Scene with = without;
  add_mesh(with, mesh_of({{-1e15, -3, -1e15}, {1e15, -3, -1e15}, {0, -3, 1e15}}, {{0, 1, 2}}), {}, {});
  add_sphere(with, {{0, -1e15, 0}, 0.9e15, 0}, {});
  add_sphere(with, {{0, 3, 0}, 1e-30, 0}, {});
  const Prepared good(without), bad(with);
  Random random(37);
  VisibilityCounts counts;
  std::uint64_t changed = 0, hits = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 8; left > 0; --left) {
    const glm::dvec3 origin = 2.5 * random.direction();
    const Ray ray = make_ray(origin, random.in_box(1) - origin);
    const Hit hit = raytrace::nearest(good, ray, kRayStart, counts);
    const Hit among = raytrace::nearest(bad, ray, kRayStart, counts);
    changed += hit.found() ? among != hit : among != nearest_of_all(with, ray, kRayStart, counts);
    hits += hit.found();
  }
  HardCase("BVH-7").none("hits that primitives of size 1e15 and 1e-30 change", changed, hits);
}

TEST_CASE("BVH-8: rays that are not finite meet nothing, soon") {
  Scene scene = scene_of(star_sphere(24, 24, 0.2, 2));
  add_sphere(scene, {{0, 0, 0}, 2, 0}, {});
  add_plane(scene, {{0, -1, 0}, {0, 1, 0}, 0}, {});
  const Prepared prepared(scene);
  Random random(41);
  VisibilityCounts counts;
  std::vector<Ray> bad, good;
  for (int i = 0; i < 1000; ++i) {
    const Ray ray{random.in_box(0.5), random.direction()};
    good.push_back(ray);
    for (const double value : {kNaN, kInfinity, -kInfinity})
      for (int where = 1; where < 4; ++where) {  // origin, direction, both
        Ray spoilt = ray;
        if (where & 1) spoilt.origin[static_cast<int>(random.below(3))] = value;
        if (where & 2) spoilt.direction[static_cast<int>(random.below(3))] = value;
        bad.push_back(spoilt);
      }
    bad.push_back({ray.origin, glm::dvec3(0)});
    bad.push_back({glm::dvec3(kNaN), glm::dvec3(kNaN)});
  }
  std::uint64_t hits = 0, after_nan = 0;
  for (const Ray& ray : bad) hits += meets_anything(prepared, ray, kRayStart);
  for (const Ray& ray : good) after_nan += raytrace::nearest(prepared, ray, {kNaN, 0}, counts).found();
  const HardCase not_finite("BVH-8");
  not_finite.none("hits of rays with NaN, infinity or no direction", hits, bad.size());
  not_finite.none("hits after a start at NaN", after_nan, good.size());
  const auto time_a_ray = [&](const std::vector<Ray>& rays) {
    return seconds_of([&] {
             for (const Ray& ray : rays) raytrace::nearest(prepared, ray, kRayStart, counts);
           }) /
           static_cast<double>(rays.size());
  };
  time_a_ray(good);
  not_finite.at_most("time of such a ray over that of a finite one", time_a_ray(bad) / time_a_ray(good), 2.5);
}
