// SPDX-License-Identifier: MIT
// Small scenes put together by build.h, for its tests.
#pragma once

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

#include "common/scene/build.h"

namespace sidelight::test {

inline const SourceLocation kHere{"s.toml", 7, 3};

inline Scene scene_with(const std::vector<double>& refract_iors = {}) {
  Scene scene;
  add_material(scene, {});
  for (const double ior : refract_iors) {
    Material glass;
    glass.refract = glm::dvec3(0, 0, 0.5);
    glass.ior = ior;
    add_material(scene, glass);
  }
  return scene;
}

inline PolygonMesh polygons_of(std::vector<glm::dvec3> positions,
                               const std::vector<std::vector<std::uint32_t>>& faces) {
  PolygonMesh mesh;
  mesh.positions = std::move(positions);
  for (const auto& numbers : faces) {
    PolygonMesh::Face face;
    face.first = static_cast<std::uint32_t>(mesh.corners.size());
    face.count = static_cast<std::uint32_t>(numbers.size());
    for (const std::uint32_t number : numbers) mesh.corners.push_back({number, kNone});
    mesh.faces.push_back(face);
  }
  return mesh;
}

inline const std::vector<glm::dvec3> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const std::vector<std::vector<std::uint32_t>> kTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

inline Scene built(const PolygonMesh& mesh, const Transform& transform = {}) {
  Scene scene = scene_with();
  add_mesh(scene, mesh, transform, kHere);
  return scene;
}

inline bool is_closed(const std::vector<glm::dvec3>& positions,
                      const std::vector<std::vector<std::uint32_t>>& faces) {
  return built(polygons_of(positions, faces)).objects[0].closed;
}

inline double volume(const Scene& scene) {
  double sum = 0;
  for (const Triangle& t : scene.triangles)
    sum += glm::dot(scene.positions[t.vertex[0]],
                    glm::cross(scene.positions[t.vertex[1]], scene.positions[t.vertex[2]]));
  return sum / 6;
}

inline glm::dmat3 diagonal(double x, double y, double z) { return {x, 0, 0, 0, y, 0, 0, 0, z}; }

}  // namespace sidelight::test
