// SPDX-License-Identifier: MIT
// Binning: which primitives may show in which tile. Ids only, one set of bins a thread, never merged or sorted: what
// a tile keeps depends on (depth, primitive), not on the order of arrival.
#pragma once

#include <cstdint>
#include <vector>

#include "common/picture/frame.h"
#include "common/scene/camera.h"
#include "common/scene/scene.h"
#include "raster/setup.h"

namespace sidelight::raster {

// The window cut into square tiles of pixels, row by row; those at the right and lower border may be smaller.
struct TileGrid {
  Rect window;
  int edge = 32;
  int columns() const { return (window.width() + edge - 1) / edge; }
  int rows() const { return (window.height() + edge - 1) / edge; }
  int count() const { return columns() * rows(); }
  Rect tile(int index) const;
};

using Bin = std::vector<std::uint32_t>;  // primitive numbers

class Bins {
 public:
  Bins(int threads, int tiles) : per_thread_(static_cast<std::size_t>(threads)) {
    for (std::vector<Bin>& bins : per_thread_) bins.resize(static_cast<std::size_t>(tiles));
  }

  Bin& bin(int thread, int tile) {
    return per_thread_[static_cast<std::size_t>(thread)][static_cast<std::size_t>(tile)];
  }
  template <class Visit>
  void for_each(int tile, const Visit& visit) const {
    for (const std::vector<Bin>& bins : per_thread_)
      for (const std::uint32_t primitive : bins[static_cast<std::size_t>(tile)]) visit(primitive);
  }

 private:
  std::vector<std::vector<Bin>> per_thread_;
};

// Puts every primitive of the scene into the bins of the tiles its box touches.
Bins bin_primitives(const Scene& scene, const Camera& camera, const TileGrid& grid, int threads);

}  // namespace sidelight::raster
