// SPDX-License-Identifier: MIT
// Hard cases of rays and triangles beside those of tests/model: the same bits in every build (TRI-3), triangles without
// area in a picture and in a closed mesh (TRI-4), accuracy (TRI-7) and range (TRI-9).
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "common/scene/shapes.h"
#include "raytrace/prepared.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/scenes.h"
#include "tests/support/worst.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

const glm::dvec3& corner(const Scene& scene, std::uint32_t triangle, std::size_t k) {
  return scene.positions[scene.triangles[triangle].vertex[k]];
}

// FNV-1a, a word at a time.
std::uint64_t hashed(std::uint64_t hash, std::uint64_t word) { return (hash ^ word) * 0x100000001B3; }

// A torus that is lit and mirrored, over a floor.
Scene torus_over_floor() {
  Scene scene = empty_scene();
  scene.materials[0].reflect = glm::dvec3(0.25);
  scene.ambient = glm::dvec3(0.1);
  scene.materials[0].ambient = glm::dvec3(0.5);
  scene.lights.push_back(lamp({2, 5, 3}, 1));
  scene.camera.eye = {0.5, 2, 4};
  scene.camera.look_at = {0, 0, 0};
  add_mesh(scene, make_torus(1, 0.4, 24, 12), {}, {});
  add_plane(scene, {{0, -0.5, 0}, {0, 1, 0}, 0}, {});
  return scene;
}

// What is exact about a ray that meets a triangle, from the doubles of the vertices: nothing is rounded before.
struct ExactHit {
  Quad t = 0;
  std::array<Quad, 3> barycentric{};
  double unit_of_t =
      0;  // eps (t + (M/|d|) |n||d|/|n.d|), M the largest coordinate of a vertex seen from the origin
};
ExactHit exact_hit(const Scene& scene, std::uint32_t triangle, const Ray& ray) {
  std::array<QuadVec, 3> a{};
  Quad reach = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = quad(corner(scene, triangle, k)) - quad(ray.origin);
    for (const Quad& c : {a[k].x, a[k].y, a[k].z}) reach = std::max(reach, magnitude(c));
  }
  const QuadVec d = quad(ray.direction), n = cross(a[1] - a[0], a[2] - a[0]);
  ExactHit hit;
  const Quad sum = dot(d, n);
  hit.t = dot(a[0], n) / sum;
  for (std::size_t k = 0; k < 3; ++k)
    hit.barycentric[k] = determinant(d, a[(k + 1) % 3], a[(k + 2) % 3]) / sum;
  hit.unit_of_t = kEps * static_cast<double>(hit.t + reach * length(n) / magnitude(sum));
  return hit;
}

}  // namespace

// Integers, so that no library's sine stands between two builds. What the builds and instruction sets must agree on are
// constants: the primitive and every bit of the depth of 1e4, 1e5 and 1e6 rays, half of them at edges and vertices.
TEST_CASE("TRI-3: every build finds the same hits, bit for bit") {
  Random random(11);
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const glm::dvec3 at = random.on_grid(1 << 10);
    for (int k = 0; k < 3; ++k) positions.push_back(at + random.on_grid(1 << 8));
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Scene scene = scene_of(mesh_of(positions, faces));
  const raytrace::Prepared prepared(scene);
  VisibilityCounts counts;
  const std::map<std::uint64_t, std::uint64_t> known{
      {10'000, 4958428640033256205}, {100'000, 11929378520111815067u}, {1'000'000, 6909359709400670917}};
  std::uint64_t hash = 0xCBF29CE484222325, hits = 0, unlike = 0, compared = 0;
  const std::uint64_t rays = std::min<std::uint64_t>(tier_count("rays_per_case"), 1'000'000);
  for (std::uint64_t i = 0; i < rays; ++i) {
    const glm::dvec3 origin = random.on_grid(1 << 11);
    glm::dvec3 target = random.on_grid(1 << 10);
    if (i % 2 == 0) {
      const std::uint32_t at = random.below(900), next = 3 * (at / 3) + (at + 1) % 3;
      target = positions[at] + 0.25 * random.below(4) * (positions[next] - positions[at]);
    }
    const Hit hit = raytrace::nearest(prepared, {origin, target - origin}, kRayStart, counts);
    hash = hashed(hashed(hash, hit.primitive), std::bit_cast<std::uint64_t>(hit.t));
    hits += hit.found();
    const auto here = known.find(i + 1);
    if (here == known.end()) continue;
    ++compared;
    unlike += hash != here->second;
    CAPTURE(i + 1);
    CAPTURE(hash);
    CHECK(hash == here->second);
  }
  CHECK(hits > rays / 2);
  HardCase("TRI-3").none("hashes of the first 1e4, 1e5 and 1e6 hits unlike those of every other build",
                         unlike, compared);
}

TEST_CASE("TRI-4: triangles without area change no bit of a picture") {
  const Scene without = torus_over_floor();
  Scene with = torus_over_floor();
  const glm::dvec3 p(0, 0.25, 1), q(1, 0.75, 0.5);
  add_mesh(with, mesh_of({p, q, p + 2.0 * (q - p)}, {{0, 0, 1}, {0, 0, 0}, {0, 1, 2}, {2, 1, 0}}), {}, {});
  for (const Triangle& t : std::span(with.triangles).last(4)) CHECK(t.degenerate);
  const Camera camera = make_camera(without.camera, 160, 120, 1);
  const HardCase picture("TRI-4");
  picture.holds("the z-buffer's picture with and without them is the same",
                test::differences(test::rastered(with, camera), test::rastered(without, camera)) == "");
  const Frame deep = test::traced(with, camera);
  picture.holds("the tracer's picture with and without them is the same",
                test::differences(deep, test::traced(without, camera)) == "");
  picture.holds("no number in it is not finite", first_non_finite(deep).empty());
  // The sliver of the catalogue, which rounding may give an area.
  const glm::dvec3 v{-1113.45459, -79.049614, -56.2431908};
  const Scene sliver = scene_of_triangle(v, {v.x, -87.0922699, v.z}, {v.x, -79.2090149, v.z});
  VisibilityCounts counts;
  const Ray at_it{{-1081.47925, 99.9999542, 87.7701111}, {-32.1072998, -183.355865, -144.607635}};
  picture.holds("the sliver of three collinear points is not hit",
                !nearest_of_all(sliver, at_it, kRayStart, counts).found());
}

// A box whose edge a b is one edge on one side and two on the other, m its middle; the triangle b a m, without area,
// closes it. From a grid all differences are exact, so a m and m b lie on a b and nothing leaks between them.
TEST_CASE("TRI-4: a mesh that triangles without area close does not leak beside them") {
  constexpr double kHalf = 1024;
  PolygonMesh box = make_box(glm::dvec3(2 * kHalf));
  std::vector<glm::dvec3> positions = box.positions;
  std::vector<Face> faces;
  for (const PolygonMesh::Face& face : box.faces)
    for (std::uint32_t k = 2; k < face.count; ++k) {
      const auto at = [&](std::uint32_t i) { return box.corners[face.first + i].position; };
      faces.push_back({at(0), at(k - 1), at(k)});
    }
  const std::uint32_t a = faces[0][0], b = faces[0][1], m = static_cast<std::uint32_t>(positions.size());
  positions.push_back(0.5 * (positions[a] + positions[b]));
  const Face split = faces[0];
  faces[0] = {a, m, split[2]};
  faces.push_back({m, b, split[2]});
  faces.push_back({a, b, m});
  const Scene scene = scene_of(mesh_of(positions, faces));
  REQUIRE(scene.objects[0].closed);
  REQUIRE(scene.triangles.back().degenerate);
  const raytrace::Prepared prepared(scene);
  Random random(13);
  VisibilityCounts counts;
  std::uint64_t leaked = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 origin = random.on_grid(1000);
    const glm::dvec3 target = positions[a] + random.below(1025) / 1024.0 * (positions[b] - positions[a]);
    leaked += !raytrace::nearest(prepared, {origin, target - origin}, kRayStart, counts).found();
  }
  HardCase("TRI-4").none("rays that leak between an edge and its two halves", leaked,
                         tier_count("rays_per_case"));
}

TEST_CASE("TRI-7: t, u and v on the unit triangle") {
  Random random(17);
  const Scene scene = scene_of_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  VisibilityCounts counts;
  Worst worst;
  for (int i = 0; i < 256; ++i) {
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Ray ray{{0, 0, -1}, {u, v, 1}};
    const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
    REQUIRE(hit.found());
    const Place place = locate(scene, ray, hit, counts);
    for (const double error : {hit.t - 1, place.barycentric[1] - u, place.barycentric[2] - v})
      worst.add(std::abs(error) / kEps);
  }
  HardCase("TRI-7").at_most("error of t, u, v on the unit triangle in ulp", worst, 16);
}

// Every other ray at an edge. The point is v0 + b1 e1 + b2 e2, for which the catalogue's gamma(7) (|b0 v0| + |b1 v1| +
// |b2 v2|), the bound of a weighted sum, does not hold where b0 is small and v0 is not. With V the largest of the
// three in a component: an edge is at most 2 V and rounded by u, its product by u, and b1 + b2 <= 1: 4 u V; the two
// sums 2 u V; 1 u V for the second order and b's own rounding.
TEST_CASE("TRI-7: t, barycentrics and point on a star, at any scale and place") {
  Random random(19);
  VisibilityCounts counts;
  std::uint64_t outside = 0, hits = 0;
  Worst t_error, b_sum, point_error;
  const std::uint64_t each = 1 + tier_count("rays_per_case") / 20;
  for (const int k : {-20, -10, 0, 10, 20})
    for (const double offset : {0.0, 1.0, 1e3, 1e5}) {
      PolygonMesh mesh = star_sphere(16, 16, 0.3, 3);
      for (glm::dvec3& p : mesh.positions) p = std::exp2(k) * p + offset;
      const Scene scene = scene_of(mesh);
      for (std::uint64_t left = each; left > 0; --left) {
        const std::uint32_t triangle = random.below(448);
        const auto v = [&](std::size_t i) { return corner(scene, triangle, i); };
        const double b1 = random.uniform(), b2 = left % 2 ? 0 : random.uniform() * (1 - b1);
        const glm::dvec3 origin = 3 * std::exp2(k) * random.direction() + offset;
        const Ray ray = make_ray(origin, v(0) + b1 * (v(1) - v(0)) + b2 * (v(2) - v(0)) - origin);
        const Hit hit = intersect(scene, triangle, ray, kRayStart, counts);
        if (!hit.found()) continue;
        ++hits;
        const ExactHit exact = exact_hit(scene, triangle, ray);
        t_error.add(magnitude(hit.t - exact.t) / exact.unit_of_t);
        const Place place = locate(scene, ray, hit, counts);
        const auto& b = place.barycentric;
        b_sum.add(magnitude(Quad(b[0]) + b[1] + b[2] - 1) / kEps);
        for (const double weight : b) outside += !(weight >= 0 && weight <= 1 + 2 * kEps);
        const QuadVec sum =
            quad(v(0)) + Quad(b[1]) * (quad(v(1)) - quad(v(0))) + Quad(b[2]) * (quad(v(2)) - quad(v(0)));
        const QuadVec off = quad(place.point) - sum;
        for (int axis = 0; axis < 3; ++axis) {
          const Quad error = axis == 0 ? off.x : axis == 1 ? off.y : off.z;
          const double reach = std::max({std::abs(v(0)[axis]), std::abs(v(1)[axis]), std::abs(v(2)[axis])});
          if (reach > 0) point_error.add(magnitude(error) / (7 * 0x1p-53 * reach));
        }
      }
    }
  const HardCase accuracy("TRI-7");
  accuracy.at_most("error of t in eps (t + (M/|d|) |n||d|/|n.d|)", t_error, 4);
  accuracy.none("barycentrics outside 0 to 1 + 2 eps", outside, 3 * hits);
  accuracy.at_most("sum of barycentrics off 1, in eps", b_sum, 4);
  accuracy.at_most("error of the point in 7 u of its largest vertex", point_error, 1);
}

// Positions reach from 1e-30 to 1e15: 2^-99 to 2^49.
TEST_CASE("TRI-9: scaling by powers of two changes no hit, no barycentric and no bit of t") {
  PolygonMesh star = star_sphere(16, 16, 0.3, 3);
  for (glm::dvec3& p : star.positions)
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(p[axis]) < 1e-12)
        p[axis] = 0;  // the cosine of a right angle, which would leave the range first
  const auto scaled = [&](int k) {
    PolygonMesh mesh = star;
    for (glm::dvec3& p : mesh.positions) p *= std::exp2(k);
    return scene_of(mesh);
  };
  struct Seen {
    Hit hit;
    std::array<double, 3> barycentric{};
    bool operator==(const Seen&) const = default;
  };
  const std::uint64_t rays = 1 + tier_count("rays_per_case") / 32;
  const auto shoot = [&](int k) {
    const Scene scene = scaled(k);
    const raytrace::Prepared prepared(scene);
    Random random(23);
    VisibilityCounts counts;
    std::vector<Seen> all;
    for (std::uint64_t left = rays; left > 0; --left) {
      const glm::dvec3 origin = 3.0 * random.direction(), d = random.in_box(1.3) - origin;
      const Ray ray{std::exp2(k) * origin, std::exp2(k) * d};
      const Hit hit = raytrace::nearest(prepared, ray, kRayStart, counts);
      all.push_back(
          {hit, hit.found() ? locate(scene, ray, hit, counts).barycentric : std::array<double, 3>{}});
    }
    return all;
  };
  const std::vector<Seen> expected = shoot(0);
  std::uint64_t changed = 0, compared = 0;
  for (int k = -60; k <= 45; k += 5) {
    const std::vector<Seen> all = shoot(k);
    for (std::size_t i = 0; i < all.size(); ++i) changed += all[i] != expected[i];
    compared += all.size();
  }
  const HardCase range("TRI-9");
  range.none("hits, t or barycentrics that change with a star's scale, 2^-60 to 2^45", changed, compared);
  std::uint64_t silent = 0;
  for (const int k : {50, 55, 60}) {
    std::string message;
    try {
      scaled(k);
    } catch (const InputError& error) {
      message = error.what();
    }
    silent += message.find("at most 1e15 in magnitude") == std::string::npos;
  }
  range.none("scales from 2^50 to 2^60 that are not refused with the range named", silent, 3);
}
