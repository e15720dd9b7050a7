// SPDX-License-Identifier: MIT
// One tile's z-buffer: depth and primitive of the nearest surface at each of its samples, and nothing else.
#pragma once

#include <vector>

#include "common/model/visibility.h"
#include "common/scene/camera.h"
#include "raster/setup.h"

namespace sidelight::raster {

class DepthTile {
 public:
  // An empty z-buffer for the samples of `pixels`.
  DepthTile(const Camera& camera, const Rect& pixels);

  // Keeps the primitive wherever it is nearer than what the samples hold.
  void draw(const Scene& scene, std::uint32_t primitive, SignCounts& counts);

  // The nearest hit at lattice sample (X, Y) of the tile; not found() on background.
  const Hit& at(int X, int Y) const { return nearest_[index(X, Y)]; }

 private:
  std::size_t index(int X, int Y) const {
    return static_cast<std::size_t>(Y - samples_.y0) * columns_.size() + static_cast<std::size_t>(X - samples_.x0);
  }
  glm::dvec3 direction(int X, int Y) const {
    return (columns_[static_cast<std::size_t>(X - samples_.x0)] + rows_[static_cast<std::size_t>(Y - samples_.y0)]) +
           axis_;
  }
  void keep(int X, int Y, const Hit& hit) {
    Hit& nearest = nearest_[index(X, Y)];
    if (before(hit, nearest)) nearest = hit;
  }
  void draw_triangle(const Scene& scene, std::uint32_t primitive, const Triangle& triangle, const SampleBox& box,
                     SignCounts& counts);

  const Camera& camera_;
  SampleBox samples_;
  std::vector<glm::dvec3> columns_, rows_;   // the summands of Camera::direction
  glm::dvec3 axis_;
  std::vector<Hit> nearest_;
};

}  // namespace sidelight::raster
