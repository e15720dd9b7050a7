// SPDX-License-Identifier: MIT
// Resolve: a tile's visible samples, shaded once each by the local model, and written as pixels.
#pragma once

#include <array>
#include <vector>

#include "common/picture/pixel.h"
#include "raster/prepared.h"
#include "raster/tile.h"

namespace sidelight::raster {

// The samples of one tile of pixels. Visible points are collected into batches, so that lanes are full.
class TileResolve {
 public:
  TileResolve(const Prepared& prepared, const Camera& camera, Isa isa, const Rect& pixels);

  // Shades what the z-buffer of the same tile holds: a DepthTile, or one with faults.
  template <class Tile>
  void shade(const Tile& tile, SignCounts& counts) {
    const int n = camera_.n;
    for (int Y = n * pixels_.y0; Y < n * pixels_.y1; ++Y)
      for (int X = n * pixels_.x0; X < n * pixels_.x1; ++X) {
        samples_[index(X, Y)].tests = tile.tests(X, Y);
        shade_sample(X, Y, tile.at(X, Y), counts);
      }
    flush();
  }

  // After shade(): the sample at (X, Y) of the tile, and the pixels' means into the frame.
  const Sample& sample(int X, int Y) const { return samples_[index(X, Y)]; }
  void write(Frame& frame) const;

 private:
  std::size_t index(int X, int Y) const {
    const int n = camera_.n;
    return static_cast<std::size_t>(Y - n * pixels_.y0) * static_cast<std::size_t>(n * pixels_.width()) +
           static_cast<std::size_t>(X - n * pixels_.x0);
  }
  void shade_sample(int X, int Y, const Hit& hit, SignCounts& counts);
  void flush();

  const Prepared& prepared_;
  const Camera& camera_;
  Isa isa_;
  Rect pixels_;
  std::vector<Sample> samples_;   // row by row on the lattice
  ShadingBatch batch_;
  std::array<Sample*, ShadingBatch::kCapacity> pending_{};   // where the batch's results go
};

}  // namespace sidelight::raster
