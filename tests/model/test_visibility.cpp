// SPDX-License-Identifier: MIT
// Rays and triangles: closed meshes do not leak, nothing is hit that exact arithmetic says is missed, and the
// conventions for degenerate triangles, rays in a triangle's plane and origins on it.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/visibility.h"
#include "common/scene/shapes.h"
#include "raytrace/prepared.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/scenes.h"
#include "tests/support/wide.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr Hit kMiss{};

// Whether 113-bit arithmetic also sees the ray meet the triangle; products of three doubles need up to 159
// bits, so within 2^-100 of the sum of magnitudes it gives the benefit of the doubt. All vertices are below
// `extent`.
bool may_meet(const Scene& scene, std::uint32_t triangle, const Ray& ray, double extent) {
  std::array<QuadVec, 3> a{};
  for (std::size_t k = 0; k < 3; ++k)
    a[k] = quad(scene.positions[scene.triangles[triangle].vertex[k]] - ray.origin);
  const QuadVec d = quad(ray.direction);
  const Quad doubt = Quad(0x1p-100) * extent * extent * length(d);
  const int side = sign_of(determinant(a[0], a[1], a[2]));
  bool agrees = side != 0;
  for (std::size_t k = 0; k < 3; ++k)
    agrees = agrees && side * determinant(d, a[(k + 1) % 3], a[(k + 2) % 3]) >= -doubt;
  return agrees;
}

// Rays from around the origin through `target(scene, random)`; through the hierarchy, as a renderer asks.
struct Leaks {
  std::uint64_t rays = 0, leaked = 0, phantom = 0;
};
template <class Target>
Leaks shoot_from_inside(const Target& target) {
  const Scene scene = scene_of(star_sphere(16, 16, 5, 12111));
  REQUIRE(scene.triangles.size() == 448);
  REQUIRE(scene.objects[0].closed);
  const raytrace::Prepared prepared(scene);
  Random random(17);
  VisibilityCounts counts;
  Leaks leaks;
  for (std::uint64_t left = tier_count("rays_per_gate"); left > 0; --left) {
    const glm::dvec3 origin = 0.5 * std::cbrt(random.uniform()) * random.direction();
    const Ray ray = make_ray(origin, target(scene, random) - origin);
    const Hit hit = raytrace::nearest(prepared, ray, kRayStart, counts);
    ++leaks.rays;
    leaks.leaked += !hit.found();
    leaks.phantom += hit.found() && !may_meet(scene, hit.primitive, ray, 8);
  }
  return leaks;
}

// A leak may be bought with a tolerance, and then something is hit that exact arithmetic says is missed: both count.
void report(const Leaks& leaks, const std::string& aimed) {
  const HardCase leak("TRI-1");
  leak.none("rays " + aimed + " that leak", leaks.leaked, leaks.rays);
  leak.none("triangles that rays " + aimed + " hit and exact arithmetic does not", leaks.phantom, leaks.rays);
}

Hit first_hit(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction,
              const Hit& after = kRayStart) {
  VisibilityCounts counts;
  return nearest_of_all(scene, make_ray(origin, direction), after, counts);
}

}  // namespace

// TRI-1: S(16, 16, 5, 12111), 448 triangles.
TEST_CASE("rays from inside a closed mesh never leak, in any direction") {
  const Leaks leaks =
      shoot_from_inside([](const Scene&, Random& random) { return 10.0 * random.direction(); });
  report(leaks, "in any direction");
}

TEST_CASE("rays aimed at the edges of a closed mesh never leak") {
  const Leaks leaks = shoot_from_inside([](const Scene& scene, Random& random) {
    const auto& v = scene.triangles[random.below(448)].vertex;
    const std::uint32_t k = random.below(3);
    const glm::dvec3 a = scene.positions[v[k]], b = scene.positions[v[(k + 1) % 3]];
    return a + random.uniform() * (b - a);
  });
  report(leaks, "at edges");
}

TEST_CASE("rays aimed at the vertices of a closed mesh never leak") {
  const Leaks leaks = shoot_from_inside([](const Scene& scene, Random& random) {
    return scene.positions[random.below(static_cast<std::uint32_t>(scene.positions.size()))];
  });
  report(leaks, "at vertices");
}

TEST_CASE("on integers a triangle is hit exactly where 128-bit arithmetic says so") {
  // Coordinates below 2^20, and half of the rays through a point of an edge: a tie in one sign, exactly.
  Random random(2);
  std::uint64_t wrong = 0, hits = 0, on_edge = 0;
  Scene scene = scene_of_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    for (glm::dvec3& v : scene.positions) v = random.on_grid(1 << 20);
    const glm::dvec3 origin = random.on_grid(1 << 20);
    glm::dvec3 d = random.on_grid(1 << 20);
    const auto& p = scene.positions;
    if (random.uniform() < 0.5) d = (p[0] - origin) + static_cast<double>(random.below(9)) * (p[1] - origin);
    const std::array<IntVec, 3> a{integers(p[0] - origin), integers(p[1] - origin), integers(p[2] - origin)};
    const int side = sign_of(determinant(a[0], a[1], a[2]));
    int met = 0, touched = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int sign = side * sign_of(determinant(integers(d), a[(k + 1) % 3], a[(k + 2) % 3]));
      met += sign >= 0;
      touched += sign == 0;
    }
    const bool expected = side != 0 && met == 3 && touched < 3;
    wrong += first_hit(scene, origin, d).found() != expected;
    hits += expected;
    on_edge += expected && touched > 0;
  }
  HardCase("TRI-1").none("rays decided unlike 128-bit integers, half of them through an edge", wrong,
                         tier_count("rays_per_case"));
  CHECK(hits > 0);
  CHECK(on_edge > 0);
}

TEST_CASE("neighbours see the sign of a common edge alike, in every bit") {
  Random random(3);
  std::uint64_t unlike = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 o = random.in_box(1), p = random.in_box(1), q = random.in_box(1), r = random.in_box(1);
    const TriangleView here = view_triangle(o, p, q, r), there = view_triangle(o, q, p, random.in_box(1));
    unlike += here.edge[2] != -there.edge[2] || here.weight[2] != there.weight[2];
  }
  HardCase("TRI-3").none("common edges that neighbours see unlike in any bit", unlike,
                         tier_count("rays_per_case"));
}

// A flip (v1 and v2 change places) negates the normal and every sign exactly. A rotation takes the depth from
// another corner: the hit stays, the depth may move within its bound (test_visibility_depth.cpp).
TEST_CASE("flipping a triangle changes no bit of a hit, rotating it changes no hit") {
  Random random(4);
  std::uint64_t changed = 0, hits = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 p = random.in_box(1), q = random.in_box(1),
                     r = p + random.uniform() * (q - p) + random.in_box(1e-3);
    const glm::dvec3 origin = random.in_box(2), inside = (p + q + r) / 3.0 + random.in_box(1e-4);
    const Scene scene = scene_of_triangle(p, q, r);
    const Hit hit = first_hit(scene, origin, inside - origin);
    changed += first_hit(scene_of_triangle(p, r, q), origin, inside - origin) != hit;
    const Hit rotated = first_hit(scene_of_triangle(q, r, p), origin, inside - origin);
    changed += rotated.found() != hit.found();
    hits += hit.found();
  }
  CHECK(changed == 0);
  CHECK(hits > 0);
}

// TRI-4
TEST_CASE("degenerate triangles are never hit and keep their number") {
  const glm::dvec3 p{-1113.45459, -79.049614, -56.2431908}, q{p.x, -87.0922699, p.z},
      r{p.x, -79.2090149, p.z};
  CHECK_FALSE(first_hit(scene_of_triangle(p, q, r), {-1081.47925, 99.9999542, 87.7701111},
                        {-32.1072998, -183.355865, -144.607635})
                  .found());
  const glm::dvec3 away{0, 0, 0};
  CHECK_FALSE(first_hit(scene_of_triangle(p, p, q), away, p).found());
  CHECK_FALSE(first_hit(scene_of_triangle(p, p, p), away, p).found());

  // The one behind it is found, under its own number.
  const Scene both =
      scene_of(mesh_of({p, p, q, {1, 0, -9}, {-1, 0, -9}, {0, 1, -9}}, {{0, 1, 2}, {3, 4, 5}}));
  CHECK(first_hit(both, {0, 0.25, 0}, {0, 0, -1}) == Hit{9, 1});
}

TEST_CASE("collinear triples of integers are flagged, and missed even without their flag") {
  Random random(5);
  std::uint64_t hits = 0, unflagged = 0;
  const std::uint64_t some = tier_count("rays_per_case") / 8;
  for (std::uint64_t left = some; left > 0; --left) {
    const glm::dvec3 a = random.on_grid(1 << 20), b = random.on_grid(1 << 20),
                     origin = random.on_grid(1 << 20);
    const double k = std::array{2.0, 3.0, -1.0}[random.below(3)];
    Scene scene = scene_of_triangle(a, b, a + k * (b - a));
    unflagged += !scene.triangles[0].degenerate;
    scene.triangles[0].degenerate = false;
    const glm::dvec3 target =
        a + random.uniform() * (b - a);  // on the line to rounding: the signs must refuse
    hits += first_hit(scene, origin, target - origin).found() + first_hit(scene, origin, b - origin).found();
  }
  const HardCase degenerate("TRI-4");
  degenerate.none("hits of collinear triples without their flag", hits, 2 * some);
  degenerate.none("collinear triples that are not flagged", unflagged, some);
}

// TRI-6
TEST_CASE("a ray in the plane of a triangle misses it") {
  const Scene unit = scene_of_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  CHECK_FALSE(first_hit(unit, {-1, 0.5, 0}, {1, 0, 0}).found());
  CHECK_FALSE(first_hit(unit, {-1, 0, 0}, {1, 0, 0}).found());  // along an edge

  Random random(6);
  std::uint64_t hits = 0;
  Scene scene = unit;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 v0 = random.on_grid(1 << 16), e1 = random.on_grid(1 << 16), e2 = random.on_grid(1 << 16);
    scene.positions = {v0, v0 + e1, v0 + e2};
    const auto in_plane = [&] {
      return static_cast<double>(random.integer(9)) * e1 + static_cast<double>(random.integer(9)) * e2;
    };
    hits += first_hit(scene, v0 + in_plane(), in_plane()).found();
  }
  HardCase("TRI-6").none("hits of rays in a triangle's plane", hits, tier_count("rays_per_case"));
}

TEST_CASE("a ray within a face of a cube or along its edge enters through the neighbours") {
  const Scene cube = scene_of(make_box({1, 1, 1}));  // from -1/2 to 1/2
  const HardCase graze("TRI-6");
  graze.holds("a ray in a face of a cube enters and leaves through the neighbours, exactly",
              first_hit(cube, {-2.5, 0.25, 0.5}, {1, 0, 0}).t == 2 &&
                  first_hit(cube, {-2.5, 0.25, 0.5}, {1, 0, 0}, {2, kNone}).t == 3);
  graze.holds("a ray along an edge of a cube does so too, exactly",
              first_hit(cube, {-2.5, 0.5, 0.5}, {1, 0, 0}).t == 2 &&
                  first_hit(cube, {-2.5, 0.5, 0.5}, {1, 0, 0}, {2, kNone}).t == 3);
  // To the edge x = -1/2, z = 1/2, and on out of the face.
  graze.holds("a ray that touches an edge of a cube hits it",
              first_hit(cube, {-1.5, 0.25, -0.5}, {1, 0, 1}).t == 1);
  CHECK_FALSE(first_hit(cube, {-2.5, 0.75, 0.5}, {1, 0, 0}).found());
}

// TRI-10: hits lie in the open interval after the ray's start.
TEST_CASE("a ray that starts on a triangle does not hit it") {
  Random random(7);
  std::uint64_t hits = 0, rays = 0;
  Scene scene = scene_of_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 v0 = random.on_grid(1 << 16), e1 = 4.0 * random.on_grid(1 << 16),
                     e2 = 4.0 * random.on_grid(1 << 16);
    scene.positions = {v0, v0 + e1, v0 + e2};
    const glm::dvec3 inside = v0 + 0.25 * e1 + 0.5 * e2, normal = glm::cross(e1, e2);
    for (const glm::dvec3& d : {normal, -normal, random.direction(), e1, e1 + 1e-9 * normal}) {
      hits += d != glm::dvec3(0) && first_hit(scene, inside, d).found();
      ++rays;
    }
  }
  HardCase("TRI-10").none("hits of the triangle that a ray starts on", hits, rays);
}

TEST_CASE("hits come one after another, by depth and then by number") {
  // Two at depth 2 (numbers 0 and 2), one at depth 1.
  const auto at = [](double z) { return std::vector<glm::dvec3>{{-1, -1, z}, {3, -1, z}, {-1, 3, z}}; };
  std::vector<glm::dvec3> positions = at(-2);
  for (const double z : {-1.0, -2.0})
    for (const glm::dvec3& p : at(z)) positions.push_back(p);
  const Scene scene = scene_of(mesh_of(positions, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}));
  const auto after = [&](const Hit& hit) { return first_hit(scene, {0, 0, 0}, {0, 0, -1}, hit); };
  CHECK(after(kRayStart) == Hit{1, 1});
  CHECK(after({1, 1}) == Hit{2, 0});
  CHECK(after({2, 0}) == Hit{2, 2});
  CHECK(after({2, 2}) == kMiss);
  CHECK(after({1, 0}) == Hit{1, 1});
  CHECK(after({2, kNone}) == kMiss);
}
