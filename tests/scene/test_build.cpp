// SPDX-License-Identifier: MIT
// add_sphere, add_plane and add_mesh: numbering, ranges, transforms, winding, closedness and media.
#include "common/scene/build.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "common/scene/shapes.h"
#include "common/scene/unit_vector.h"
#include "tests/hardcases/result.h"
#include "tests/scene/built.h"
#include "tests/support/random.h"
#include "tests/support/wide.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using glm::dmat3;
using glm::dvec3;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string mistake(const PolygonMesh& mesh, const Transform& transform = {}) {
  try {
    built(mesh, transform);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("build: objects and primitives are numbered in the order they are added") {
  Scene scene = scene_with();
  add_sphere(scene, {{1, 2, 3}, 4, 0}, kHere);
  add_mesh(scene, polygons_of(kCorners, kTetrahedron), {}, kHere);
  add_plane(scene, {{0, 0, 0}, {0, 2, 0}, 0}, {"s.toml", 9, 1});
  add_mesh(scene, make_box({1, 1, 1}), {}, kHere);
  add_sphere(scene, {{0, 0, 0}, 1, 0}, kHere);

  const std::vector<std::uint32_t> first{0, 1, 5, 6, 18}, count{1, 4, 1, 12, 1}, index{0, 0, 0, 4, 1};
  REQUIRE(scene.objects.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(scene.objects[i].first_primitive == first[i]);
    CHECK(scene.objects[i].count == count[i]);
    CHECK(scene.objects[i].first == index[i]);
  }
  REQUIRE(scene.primitive_object.size() == 19);
  CHECK(primitive_ref(scene, 10).index == 8);
  CHECK(scene.triangles[4].vertex[0] >= 4);  // the box's vertices come after the tetrahedron's
  CHECK(scene.objects[2].where.line == 9);
  CHECK(scene.planes[0].normal == dvec3(0, 1, 0));
}

TEST_CASE("build: positions and lengths below 1e-30 are 0, beyond 1e15 a mistake") {
  Scene scene = scene_with();
  add_sphere(scene, {{-0.0, 9e-31, 1e15}, 1e-30, 0}, kHere);
  CHECK(scene.spheres[0].center == dvec3(0, 0, 1e15));
  CHECK_FALSE(std::signbit(scene.spheres[0].center.x));
  for (const double radius : {0.0, -1.0, 9e-31, 1.1e15, kInfinity, std::nan("")})
    CHECK_THROWS_AS(add_sphere(scene, {{0, 0, 0}, radius, 0}, kHere), InputError);
  for (const double bad : {1.1e15, -kInfinity, std::nan("")}) {
    CHECK_THROWS_AS(add_sphere(scene, {{0, bad, 0}, 1, 0}, kHere), InputError);
    CHECK_THROWS_AS(add_plane(scene, {{0, 0, bad}, {0, 1, 0}, 0}, kHere), InputError);
    CHECK_THROWS_AS(built(polygons_of({{0, 0, 0}, {bad, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})), InputError);
  }
  CHECK(scene.objects.size() == 1);  // what is refused leaves nothing behind

  const PolygonMesh mesh = polygons_of({{0, 0, 0}, {1e14, 0, 0}, {0, 1e-31, 0}}, {{0, 1, 2}});
  CHECK(built(mesh).positions[2] == dvec3(0, 0, 0));
  CHECK(mistake(mesh, {diagonal(11, 1, 1), dvec3(0)}) ==
        "s.toml:7:3: vertex 2 (of the mesh, from 1) is 1.1e+15, expected at most 1e15 in magnitude");
  CHECK(mistake(mesh, {diagonal(std::nan(""), 1, 1), dvec3(0)}) != "");
}

TEST_CASE("build: plane normals of any length, and the same bits when scaled by powers of two") {
  const dvec3 normal(0.3, -1.7, 0.001);
  Scene scene = scene_with();
  for (const int k : {0, -900, -60, 1, 60, 900})
    add_plane(scene,
              {{0, 0, 0}, {std::ldexp(normal.x, k), std::ldexp(normal.y, k), std::ldexp(normal.z, k)}, 0},
              kHere);
  for (const Plane& plane : scene.planes) CHECK(plane.normal == scene.planes[0].normal);
  CHECK(glm::length(scene.planes[0].normal) == doctest::Approx(1).epsilon(1e-15));
  for (const dvec3& n : {dvec3(5e-324, 0, 0), dvec3(0, 1.7e308, 1.7e308), dvec3(-1e-320, 1e-320, 0)}) {
    add_plane(scene, {{0, 0, 0}, n, 0}, kHere);
    CHECK(glm::length(scene.planes.back().normal) == doctest::Approx(1).epsilon(1e-15));
  }
  for (const dvec3& n : {dvec3(0), dvec3(1, kInfinity, 0), dvec3(std::nan(""), 1, 0)})
    CHECK_THROWS_AS(add_plane(scene, {{0, 0, 0}, n, 0}, kHere), InputError);
}

TEST_CASE("build: vertex normals are unit, zero stays zero, scaling by 2^k changes no bit") {
  PolygonMesh mesh = polygons_of(kCorners, {{0, 1, 2}});
  const dvec3 n(0.1, 0.7, -3);
  for (const int k : {0, -60, 60, -1000, 1000})
    mesh.normals.push_back({std::ldexp(n.x, k), std::ldexp(n.y, k), std::ldexp(n.z, k)});
  mesh.normals.push_back(dvec3(0));
  for (std::uint32_t k = 0; k < 3; ++k) mesh.corners[k].normal = k + 3;
  Transform transform;
  transform.linear = {1, 2, 3, 0, 1, 4, 5, 6, 0};
  const Scene scene = built(mesh, transform);
  for (std::size_t i = 1; i < 5; ++i) CHECK(scene.normals[i] == scene.normals[0]);
  CHECK(glm::length(scene.normals[0]) == doctest::Approx(1).epsilon(1e-15));
  CHECK(scene.normals[5] == dvec3(0));
  CHECK(scene.triangles[0].normal == std::array<std::uint32_t, 3>{3, 4, 5});
  for (const int k : {-300, 40}) {
    Transform scaled = transform;
    scaled.linear *= std::ldexp(1.0, k);
    PolygonMesh far = mesh;
    for (dvec3& p : far.positions) p *= std::ldexp(1.0, -k);
    CHECK(built(far, scaled).normals == scene.normals);
  }
}

TEST_CASE("build: a second mesh has vertices and normals of its own") {
  PolygonMesh mesh = polygons_of(kCorners, {{0, 1, 2}});
  mesh.normals = {{0, 0, 1}};
  for (auto& corner : mesh.corners) corner.normal = 0;
  Scene scene = scene_with();
  add_mesh(scene, mesh, {}, kHere);
  mesh.normals = {{0, 1, 0}};
  add_mesh(scene, mesh, {dmat3(1), dvec3(5)}, kHere);
  CHECK(scene.triangles[1].vertex == std::array<std::uint32_t, 3>{4, 5, 6});
  CHECK(scene.positions[4] == dvec3(5));
  CHECK(scene.normals[scene.triangles[1].normal[2]] == dvec3(0, 1, 0));
}

// XFM-1. The normal n goes to n' = C n, C the cofactors of M, each a difference of two products: off by 2 u P, P the sum
// of their magnitudes. C n adds 3 u, the division by its length 1 u; scalings are by powers of two. So n'_i is off by
// at most 6 u (P |n|)_i and a little, and n' . M t, whose exact value is 0, by 8 u sum (P |n|)_i |M t|_i with room.
TEST_CASE("build: normals stay square to transformed tangents") {
  test::Random random(5);
  double worst = 0;
  std::uint64_t other_side = 0, count = 0;
  for (std::uint64_t left = test::tier_count("rays_per_case"); left > 0; --left, ++count) {
    const double stretch = random.log_uniform(1e-3, 1e3), angle = random.uniform(-3, 3);
    const dmat3 shear(1, 0.5, 0, 0, 1, 0, 0, 0, 1);
    const dmat3 turn(std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle));
    const dmat3 m = turn * shear * diagonal(1, count % 2 ? 1 : -1, stretch);
    const dvec3 n = random.direction();
    PolygonMesh mesh = polygons_of({}, {});
    mesh.normals = {n};
    const dvec3 mapped = built(mesh, {m, dvec3(0)}).normals[0];
    other_side += !(glm::dot(mapped, m * n) > 0);

    using test::quad, test::QuadVec, test::Quad;
    const QuadVec tangent = cross(quad(n), quad(random.direction()));  // square to n to 113 bits
    const QuadVec along = tangent.x * quad(m[0]) + tangent.y * quad(m[1]) + tangent.z * quad(m[2]);
    const auto products = [](const dvec3& a, const dvec3& b) {  // |.||.| + |.||.| of a x b, a column of P
      return dvec3(std::abs(a.y * b.z) + std::abs(a.z * b.y), std::abs(a.z * b.x) + std::abs(a.x * b.z),
                   std::abs(a.x * b.y) + std::abs(a.y * b.x));
    };
    const dvec3 reach = std::abs(n.x) * products(m[1], m[2]) + std::abs(n.y) * products(m[2], m[0]) +
                        std::abs(n.z) * products(m[0], m[1]);
    const dvec3 exact_length =
        n.x * glm::cross(m[1], m[2]) + n.y * glm::cross(m[2], m[0]) + n.z * glm::cross(m[0], m[1]);
    const QuadVec across{test::magnitude(along.x), test::magnitude(along.y), test::magnitude(along.z)};
    const double bound =
        8 * 0x1p-53 * static_cast<double>(dot(quad(reach), across)) / glm::length(exact_length);
    worst = std::max(worst, static_cast<double>(test::magnitude(dot(quad(mapped), along))) / bound);
  }
  const test::HardCase hard("XFM-1");
  hard.at_most("n' . M t, stretched by 1e-3 to 1e3 and sheared, in units of its bound", worst, 1);
  hard.none("normals that change their side", other_side, count);
}

TEST_CASE("build: singular maps squash normals without a NaN") {
  PolygonMesh mesh = polygons_of(kCorners, {{0, 1, 3}});
  mesh.normals = {{0, 1, 0}, {1, 0, 0}, {1, 1, 1}};
  const Scene flat = built(mesh, {diagonal(1, 0, 1), dvec3(0)});
  CHECK(flat.normals[0] == dvec3(0, 1, 0));
  CHECK(flat.normals[1] == dvec3(0));
  CHECK(flat.normals[2] == dvec3(0, 1, 0));
  const Scene point = built(mesh, {dmat3(0.0), dvec3(1, 2, 3)});
  CHECK(point.normals[0] == dvec3(0));
  CHECK(point.triangles[0].degenerate);
}

TEST_CASE("build: a mirror image keeps its outside") {
  // Open: the winding is reversed, so that the face's normal stays on its vertex normals' side.
  PolygonMesh sheet = polygons_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  sheet.normals = {{0, 0, 1}};
  for (auto& corner : sheet.corners) corner.normal = 0;
  std::uint64_t turned = 0;
  for (const dmat3& m : {diagonal(-1, 1, 1), diagonal(1, -1, 1), diagonal(1, 1, -1), diagonal(-1, -1, -1)}) {
    const Scene scene = built(sheet, {m, dvec3(0)});
    const Triangle& t = scene.triangles[0];
    const dvec3 n = glm::cross(scene.positions[t.vertex[1]] - scene.positions[t.vertex[0]],
                               scene.positions[t.vertex[2]] - scene.positions[t.vertex[0]]);
    CHECK(glm::dot(n, scene.normals[0]) > 0);
    CHECK(glm::dot(n, m * dvec3(0, 0, 1)) > 0);
    turned += !(glm::dot(n, scene.normals[0]) > 0);
  }
  test::HardCase("XFM-3").none("mirrored faces that turn away from their vertex normals", turned, 4);
  // Closed: the volume is positive either way.
  CHECK(volume(built(polygons_of(kCorners, kTetrahedron))) == doctest::Approx(1.0 / 6));
  CHECK(volume(built(polygons_of(kCorners, kTetrahedron), {diagonal(-1, 1, 1), dvec3(5)})) ==
        doctest::Approx(1.0 / 6));
}

TEST_CASE("build: counts beyond bounds are refused before memory is spent") {
  PolygonMesh mesh = polygons_of({{0, 0, 0}}, {});
  mesh.corners.resize(100'001);
  PolygonMesh::Face face;
  face.count = 100'001;
  mesh.faces = {face};
  CHECK(mistake(mesh) ==
        "s.toml:7:3: the squares of the faces' corner counts add up to 10000200001, expected at most 1e+10");
  mesh.faces.assign(336, face);
  CHECK(mistake(mesh) == "s.toml:7:3: the scene reaches 33599664 primitives, expected at most 33554432");
}

TEST_CASE("build: a mesh without faces is an object without primitives") {
  const Scene scene = built(polygons_of(kCorners, {}));
  CHECK(scene.objects[0].count == 0);
  CHECK_FALSE(scene.objects[0].closed);
  CHECK(scene.primitive_object.empty());
  REQUIRE(scene.warnings.size() == 1);
  CHECK(scene.warnings[0] == "s.toml:7:3: the mesh has no faces");
}
