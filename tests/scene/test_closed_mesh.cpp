// SPDX-License-Identifier: MIT
// Which meshes are closed, which way they are turned, which of their triangles are degenerate, and what is solid.
#include "common/scene/closed_mesh.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/scene/built.h"

using namespace sidelight;
using namespace sidelight::test;
using glm::dmat3;
using glm::dvec3;

TEST_CASE("build: a closed mesh is turned outward, its triangles keep their numbers") {
  auto inward = kTetrahedron;
  for (auto& face : inward) std::swap(face[1], face[2]);
  PolygonMesh mesh = polygons_of(kCorners, inward);
  mesh.normals = kCorners;
  for (auto& corner : mesh.corners) corner.normal = corner.position;
  for (const double far : {0.0, 1e6, 1e12}) {
    CAPTURE(far);
    const Scene scene = built(mesh, {dmat3(1), dvec3(far)});
    CHECK(scene.objects[0].closed);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::array<std::uint32_t, 3> expected{kTetrahedron[i][0], kTetrahedron[i][1], kTetrahedron[i][2]};
      CHECK(scene.triangles[i].vertex == expected);
      CHECK(scene.triangles[i].normal == expected);
    }
  }
  inward.pop_back();  // open: as the file has it
  CHECK(built(polygons_of(kCorners, inward)).triangles[0].vertex == std::array<std::uint32_t, 3>{0, 1, 2});
}

TEST_CASE("build: closed means each directed edge once, with its reverse, by position") {
  CHECK(is_closed(kCorners, kTetrahedron));
  CHECK_FALSE(is_closed(kCorners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}));
  CHECK_FALSE(is_closed(kCorners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 3, 0}, {2, 3, 0}}));
  CHECK_FALSE(is_closed(kCorners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}));  // one face turned over
  auto twice = kTetrahedron;
  twice.insert(twice.end(), kTetrahedron.begin(), kTetrahedron.end());
  CHECK_FALSE(is_closed(kCorners, twice));
  CHECK_FALSE(is_closed({}, {}));

  // Each face with vertices of its own.
  std::vector<dvec3> own;
  std::vector<std::vector<std::uint32_t>> faces;
  for (const auto& face : kTetrahedron) {
    const auto first = static_cast<std::uint32_t>(own.size());
    faces.push_back({first, first + 1, first + 2});
    for (const std::uint32_t k : face) own.push_back(kCorners[k]);
  }
  CHECK(is_closed(own, faces));
  own[0].x = -0.0;
  CHECK(is_closed(own, faces));
  own[0].x = 1e-29;
  CHECK_FALSE(is_closed(own, faces));
}

TEST_CASE("build: degenerate triangles are flagged, and a mesh that closes with them is closed") {
  // (0 2 1) with its edge 0-1 divided at 4: a flat triangle joins the halves to the whole edge of (0 1 3).
  std::vector<dvec3> corners = kCorners;
  corners.push_back({0.5, 0, 0});
  corners.push_back({1, 0, 0});  // 5, the place of 1
  const std::vector<std::vector<std::uint32_t>> divided{{0, 2, 4}, {4, 2, 1}, {0, 4, 1},
                                                        {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const Scene scene = built(polygons_of(corners, divided));
  CHECK(scene.objects[0].closed);
  for (std::size_t i = 0; i < 6; ++i) CHECK(scene.triangles[i].degenerate == (i == 2));
  CHECK_FALSE(is_closed(corners, {{0, 2, 4}, {4, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));

  for (const auto& needle :
       std::vector<std::vector<std::uint32_t>>{{0, 1, 5}, {1, 5, 0}, {1, 1, 2}, {3, 3, 3}}) {
    auto faces = kTetrahedron;
    faces.push_back(needle);
    const Scene with = built(polygons_of(corners, faces));
    CHECK(with.objects[0].closed);
    CHECK(with.triangles[4].degenerate);
    CHECK(with.triangles.size() == 5);
  }
}

TEST_CASE("build: degeneracy is exact (TRI-4)") {
  std::uint64_t state = 9;
  const auto random = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 44);  // below 2^20
  };
  for (int i = 0; i < 3000; ++i) {
    const dvec3 a(random(), random(), random()), b(random(), random(), random());
    if (a == b) continue;
    const double k = i % 3 == 0 ? 2 : i % 3 == 1 ? 3 : -1;
    dvec3 c = a + k * (b - a);
    CHECK(built(polygons_of({a, b, c}, {{0, 1, 2}})).triangles[0].degenerate);
    c[i % 2] = std::nextafter(c[i % 2], std::numeric_limits<double>::infinity());
    // Off the line by one ulp, unless the line runs along that axis.
    const bool along = glm::length(b - a) == std::abs(b[i % 2] - a[i % 2]);
    CHECK(built(polygons_of({a, b, c}, {{0, 1, 2}})).triangles[0].degenerate == along);
  }
  const Scene pbrt = built(polygons_of({{-1113.45459, -79.049614, -56.2431908},
                                        {-1113.45459, -87.0922699, -56.2431908},
                                        {-1113.45459, -79.2090149, -56.2431908}},
                                       {{0, 1, 2}}));
  CHECK(pbrt.triangles[0].degenerate);
}

TEST_CASE("build: solids and their index of refraction") {
  Scene scene = scene_with({1.5, 1.33});
  add_sphere(scene, {{0, 0, 0}, 1, 0}, kHere);
  add_sphere(scene, {{0, 0, 0}, 1, 1}, kHere);
  add_plane(scene, {{0, 0, 0}, {0, 1, 0}, 2}, kHere);
  PolygonMesh mesh = polygons_of(kCorners, kTetrahedron);
  add_mesh(scene, mesh, {}, kHere);
  mesh.faces[1].material = 2;
  mesh.faces[2].material = 2;
  add_mesh(scene, mesh, {}, kHere);
  CHECK(scene.warnings.empty());
  mesh.faces[2].material = 1;
  add_mesh(scene, mesh, {}, kHere);
  mesh.faces.pop_back();
  add_mesh(scene, mesh, {}, kHere);

  const std::vector<bool> solid{false, true, true, false, true, true, false};
  const std::vector<double> ior{1, 1.5, 1.33, 1, 1.33, 1.33, 1};
  for (std::size_t i = 0; i < solid.size(); ++i) {
    CAPTURE(i);
    CHECK(scene.objects[i].solid == solid[i]);
    CHECK(scene.objects[i].ior == ior[i]);
  }
  REQUIRE(scene.warnings.size() == 2);
  CHECK(scene.warnings[0].find("s.toml:7:3: the mesh's materials have several indices of refraction") == 0);
  CHECK(scene.warnings[1].find("s.toml:7:3: the mesh refracts but is not closed") == 0);
  CHECK(scene.warnings[1].find("T = D") != std::string::npos);
}
