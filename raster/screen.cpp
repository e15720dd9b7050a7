// SPDX-License-Identifier: MIT
#include "raster/screen.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace sidelight::raster {

// The lattice's edges lie at most 2^29 units from the centre, so that an equal stretch to every side has a place too and
// differences of places fit 32 bits. 19 bits at most: a small triangle's extent, 2^24 units, is then at least 32 samples.
ScreenSpace::ScreenSpace(const Camera& camera)
    : eye(camera.eye),
      right(camera.right),
      up(camera.up),
      forward(camera.forward),
      columns(camera.columns()),
      rows(camera.rows()),
      bits(19),
      center_x(columns / 2),
      center_y(rows / 2),
      scale(camera.depth_scale() / glm::dot(camera.up, camera.up)),
      depth_scale(camera.depth_scale()),
      lens(camera.depth_scale() / glm::length(camera.up)) {
  while (bits > 0 && std::max(columns, rows) > 1 << (30 - bits)) --bits;
  half_unit = std::ldexp(0.5, bits);
  offset_x = half_unit * (columns - 1 - 2 * center_x);
  offset_y = half_unit * (rows - 1 - 2 * center_y);
}

ScreenVertex project(const ScreenSpace& space, const glm::dvec3& vertex) {
  ScreenVertex placed;
  project_lanes<double>(space, vertex.x, vertex.y, vertex.z, &placed);
  return placed;
}

}  // namespace sidelight::raster
