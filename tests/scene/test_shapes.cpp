// SPDX-License-Identifier: MIT
// Generated shapes against closed forms: closed, of the right volume and topology, wound and shaded outward.
#include "common/scene/shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <utility>

#include "tests/support/scenes.h"

using namespace sidelight;
using glm::dvec3;

namespace {

constexpr double kTau = 2 * std::numbers::pi;

struct Shape {
  const char* name;
  PolygonMesh mesh;
  double volume;
  int euler;  // vertices - edges + faces
  bool smooth;
};

// Area of a regular polygon of `n` corners at distance 1.
double polygon_area(int n) { return n / 2.0 * std::sin(kTau / n); }

// A torus of polygons is the difference of two solids whose level cuts are regular polygons, so Pappus's theorem holds
// with the polygon's 2 * polygon_area(n) for the circle's 2 pi.
double torus_volume(double major, double minor, int around, int tube) {
  return 2 * polygon_area(around) * major * polygon_area(tube) * minor * minor;
}

std::vector<Shape> shapes() {
  std::vector<Shape> all;
  all.push_back({"box", make_box({1, 2, 3}), 6, 2, false});
  all.push_back({"tiny box", make_box({1e-9, 1e-9, 1e-9}), 1e-27, 2, false});
  for (const int n : {3, 4, 5, 8, 12, 97}) {
    all.push_back({"cylinder", make_cylinder(1.5, 2, n), polygon_area(n) * 1.5 * 1.5 * 2, 2, true});
    all.push_back({"cone", make_cone(1.5, 2, n), polygon_area(n) * 1.5 * 1.5 * 2 / 3, 2, true});
    all.push_back({"torus", make_torus(1, 0.3, n, 7), torus_volume(1, 0.3, n, 7), 0, true});
    all.push_back({"torus", make_torus(1, 0.999, 5, n), torus_volume(1, 0.999, 5, n), 0, true});
  }
  return all;
}

dvec3 corner(const Scene& scene, const Triangle& t, std::size_t k) { return scene.positions[t.vertex[k]]; }

}  // namespace

TEST_CASE("shapes: closed, with the formula's volume, and wound outward") {
  for (const Shape& shape : shapes()) {
    CAPTURE(shape.name);
    const Scene scene = test::scene_of(shape.mesh);
    CHECK(scene.objects.at(0).closed);
    double volume = 0, size = 0;
    for (const Triangle& t : scene.triangles) {
      CHECK_FALSE(t.degenerate);
      const dvec3 a = corner(scene, t, 0), b = corner(scene, t, 1), c = corner(scene, t, 2);
      volume += glm::dot(a, glm::cross(b, c)) / 6;
      size += std::abs(glm::dot(a, glm::cross(b, c))) / 6;
    }
    // Positions are off by a few ulp (cos, sin, products): each factor of a term by 4 u, a term by 20 u with its own
    // roundings; then one rounding a sum. cross() may cancel, so twice that.
    const double roundings = 2 * (20 + static_cast<double>(scene.triangles.size()));
    CHECK(std::abs(volume - shape.volume) <= roundings * 0x1p-53 * size);
  }
}

TEST_CASE("shapes: as generated they are outward already") {
  for (const Shape& shape : shapes()) {
    CAPTURE(shape.name);
    // Were add_mesh to turn the mesh, its first triangle would not be the first face's.
    const Scene scene = test::scene_of(shape.mesh);
    const PolygonMesh::Face& face = shape.mesh.faces[0];
    CHECK(scene.triangles[0].vertex[1] == shape.mesh.corners[face.first + 1].position);
  }
}

TEST_CASE("shapes: Euler characteristic, and no vertex to spare") {
  for (const Shape& shape : shapes()) {
    CAPTURE(shape.name);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::set<std::uint32_t> used;
    for (const PolygonMesh::Face& face : shape.mesh.faces)
      for (std::uint32_t k = 0; k < face.count; ++k) {
        const std::uint32_t a = shape.mesh.corners[face.first + k].position;
        const std::uint32_t b = shape.mesh.corners[face.first + (k + 1) % face.count].position;
        edges.insert(std::minmax(a, b));
        used.insert(a);
      }
    CHECK(used.size() == shape.mesh.positions.size());
    CHECK(static_cast<int>(used.size()) - static_cast<int>(edges.size()) +
              static_cast<int>(shape.mesh.faces.size()) ==
          shape.euler);
  }
}

TEST_CASE("shapes: vertex normals are unit and on the outer side of their faces") {
  for (const Shape& shape : shapes()) {
    CAPTURE(shape.name);
    const Scene scene = test::scene_of(shape.mesh);
    std::size_t smooth = 0;
    for (const Triangle& t : scene.triangles) {
      if (t.normal[0] == kNone) continue;
      ++smooth;
      const dvec3 a = corner(scene, t, 0), b = corner(scene, t, 1), c = corner(scene, t, 2);
      for (const std::uint32_t n : t.normal) {
        CHECK(glm::length(scene.normals[n]) == doctest::Approx(1).epsilon(1e-15));
        CHECK(glm::dot(scene.normals[n], glm::cross(b - a, c - a)) > 0);
      }
    }
    CHECK((smooth > 0) == shape.smooth);
  }
}

TEST_CASE("shapes: quarter turns are exact") {
  for (const int n : {4, 8, 12, 64, 100}) {
    CAPTURE(n);
    const PolygonMesh mesh = make_cylinder(3, 1, n);
    const auto quarter = static_cast<std::size_t>(n / 4);
    CHECK(mesh.positions[0] == dvec3(3, 0, 0));
    CHECK(mesh.positions[quarter] == dvec3(0, 0, 3));
    CHECK(mesh.positions[2 * quarter] == dvec3(-3, 0, 0));
    CHECK(mesh.positions[3 * quarter] == dvec3(0, 0, -3));
    for (std::size_t i = 0; i < quarter; ++i) {
      const dvec3 p = mesh.positions[i];
      CHECK(mesh.positions[i + quarter] == dvec3(-p.z, 0, p.x));
      CHECK(mesh.positions[i + 2 * quarter] == dvec3(-p.x, 0, -p.z));
    }
  }
}

TEST_CASE("shapes: a cone's side normals are square to its side") {
  const Scene scene = test::scene_of(make_cone(2, 5, 16));
  for (const Triangle& t : scene.triangles) {
    if (t.normal[0] == kNone) continue;
    // Face corners are base, apex, base: the line to the apex lies in the cone's surface at the base corner.
    const dvec3 side = corner(scene, t, 1) - corner(scene, t, 0);
    CHECK(std::abs(glm::dot(side, scene.normals[t.normal[0]])) <= 1e-14);
  }
}
