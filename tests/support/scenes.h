// SPDX-License-Identifier: MIT
// Scenes and meshes that tests make in memory.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "common/scene/build.h"
#include "common/scene/camera.h"
#include "tests/support/random.h"

namespace sidelight::test {

using Face = std::array<std::uint32_t, 3>;

inline PolygonMesh mesh_of(const std::vector<glm::dvec3>& positions, const std::vector<Face>& faces) {
  PolygonMesh mesh;
  mesh.positions = positions;
  for (const Face& face : faces) {
    PolygonMesh::Face added;
    added.first = static_cast<std::uint32_t>(mesh.corners.size());
    added.count = 3;
    for (const std::uint32_t v : face) mesh.corners.push_back({v, kNone});
    mesh.faces.push_back(added);
  }
  return mesh;
}

// A scene with one grey material, number 0, and nothing in it.
inline Scene empty_scene() {
  Scene scene;
  Material grey;
  grey.name = "grey";
  grey.diffuse = glm::dvec3(0.5);
  add_material(scene, grey);
  return scene;
}
inline Scene scene_of(const PolygonMesh& mesh) {
  Scene scene = empty_scene();
  add_mesh(scene, mesh, {}, {});
  return scene;
}
inline Scene scene_of(const Sphere& sphere) {
  Scene scene = empty_scene();
  add_sphere(scene, sphere, {});
  return scene;
}
inline Scene scene_of(const Plane& plane) {
  Scene scene = empty_scene();
  add_plane(scene, plane, {});
  return scene;
}
inline Scene scene_of_triangle(const glm::dvec3& v0, const glm::dvec3& v1, const glm::dvec3& v2) {
  return scene_of(mesh_of({v0, v1, v2}, {{0, 1, 2}}));
}

inline Light lamp(const glm::dvec3& position, double intensity) {
  Light light;
  light.position = position;
  light.intensity = glm::dvec3(intensity);
  return light;
}
// `to_light` is unit.
inline Light sun(const glm::dvec3& to_light, double intensity) {
  Light light;
  light.directional = true;
  light.direction = -to_light;
  light.intensity = glm::dvec3(intensity);
  return light;
}

// S(rows, columns, amplitude, seed) of the hard cases: closed, star-shaped around the origin, wound
// outward.
inline PolygonMesh star_sphere(std::uint32_t rows, std::uint32_t columns, double amplitude,
                               std::uint64_t seed) {
  Random random(seed);
  std::vector<glm::dvec3> positions{{0, 0, 1}};
  for (std::uint32_t t = 1; t + 1 < rows; ++t)
    for (std::uint32_t p = 0; p < columns; ++p) {
      const double theta = std::numbers::pi * t / (rows - 1), phi = 2 * std::numbers::pi * p / columns;
      const double radius = 1 + amplitude * random.uniform();
      positions.push_back(radius * glm::dvec3(std::sin(theta) * std::cos(phi),
                                              std::sin(theta) * std::sin(phi), std::cos(theta)));
    }
  positions.push_back({0, 0, -1});

  const auto vertex = [&](std::uint32_t t, std::uint32_t p) { return 1 + (t - 1) * columns + p % columns; };
  const auto south = static_cast<std::uint32_t>(positions.size() - 1);
  std::vector<Face> faces;
  for (std::uint32_t p = 0; p < columns; ++p) {
    faces.push_back({0, vertex(1, p), vertex(1, p + 1)});
    for (std::uint32_t t = 1; t + 2 < rows; ++t) {
      faces.push_back({vertex(t, p), vertex(t + 1, p), vertex(t + 1, p + 1)});
      faces.push_back({vertex(t, p), vertex(t + 1, p + 1), vertex(t, p + 1)});
    }
    faces.push_back({south, vertex(rows - 2, p + 1), vertex(rows - 2, p)});
  }
  return mesh_of(positions, faces);
}

// At the origin, looking along -z: d = view_height ((2X + 1 - W), (H - 1 - 2Y), 0) - 2H z, exactly for a dyadic height.
inline Camera plain_camera(int width, int height, double view_height = 1) {
  CameraSettings settings;
  settings.view_height = view_height;
  return make_camera(settings, width, height, 1);
}

// To the nearest multiple of 2^-20, for oracles in integers.
inline double snapped(double x) { return std::round(x * 0x1p20) * 0x1p-20; }
inline glm::dvec3 snapped(const glm::dvec3& v) { return {snapped(v.x), snapped(v.y), snapped(v.z)}; }

// |x - cx| + |y - cy| + |z - cz| = size: convex, and exact where center +- size is.
inline PolygonMesh octahedron(const glm::dvec3& center, double size) {
  std::vector<glm::dvec3> positions;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-size, size}) {
      positions.push_back(center);
      positions.back()[axis] += side;
    }
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const Face face{i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2 & 1)};
    const bool mirrored =
        (i & 1) + (i >> 1 & 1) + (i >> 2 & 1) != 3 && (i & 1) + (i >> 1 & 1) + (i >> 2 & 1) != 1;
    faces.push_back(mirrored ? Face{face[0], face[2], face[1]} : face);
  }
  return mesh_of(positions, faces);
}

}  // namespace sidelight::test
