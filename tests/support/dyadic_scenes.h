// SPDX-License-Identifier: MIT
// Large meshes whose coordinates are multiples of 2^-20, so that 128-bit integers can judge their pictures
// (exact_picture.h), and cameras to see them by. Below 16 such a coordinate is a float too.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/scene/build.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace sidelight::test {

inline PolygonMesh placed(PolygonMesh mesh, const glm::dvec3& center, double radius) {
  for (glm::dvec3& p : mesh.positions) p = snapped(center + radius * p);
  return mesh;
}

inline PolygonMesh ground() {
  return mesh_of({{-12, 0, 12}, {12, 0, 12}, {12, 0, -12}, {-12, 0, -12}}, {{0, 1, 2}, {0, 2, 3}});
}

// Standing on the ground; some of them intersect.
inline std::vector<PolygonMesh> ten_spheres(std::uint32_t rows, std::uint32_t columns) {
  Random random(20);
  std::vector<PolygonMesh> spheres;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const double radius = snapped(random.uniform(0.4, 1.1));
    const glm::dvec3 center{random.uniform(-3, 3), radius, random.uniform(-3, 2)};
    spheres.push_back(placed(star_sphere(rows, columns, 0.05, 100 + i), center, radius));
  }
  return spheres;
}

// The largest side of its box becomes 2, and the box's middle stands over the ground's.
inline PolygonMesh fitted(PolygonMesh mesh) {
  glm::dvec3 low(INFINITY), high(-INFINITY);
  for (const glm::dvec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 sides = high - low;
  const double scale = 2 / std::max({sides.x, sides.y, sides.z});
  return placed(std::move(mesh), glm::dvec3{0, 1, 2} - scale * (low + high) / 2.0, scale);
}

// From a place on the same grid, in no special direction.
inline CameraSettings any_way() {
  CameraSettings settings;
  settings.eye = snapped(glm::dvec3(0.7, 2.6, 7.9));
  settings.look_at = {0.1, 0.6, 0.2};
  settings.view_height = 0.68;
  return settings;
}

}  // namespace sidelight::test
