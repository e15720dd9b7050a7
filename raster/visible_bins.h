// SPDX-License-Identifier: MIT
// The first half of a frame: every vertex projected, every primitive set up once, and what may be seen put into the bins
// of its tiles. Each thread has bins of its own, never merged or sorted: what a tile shows depends on (depth, primitive).
#pragma once

#include <utility>
#include <vector>

#include "common/kept_memory.h"
#include "raster/kernels.h"
#include "raster/prepared.h"

namespace sidelight::raster {

class VisibleBins {
 public:
  VisibleBins(const Prepared& prepared, const Camera& camera, const TileGrid& grid, Isa isa, int threads);
  ~VisibleBins() { kept_.give_back(std::move(threads_)); }

  // Whether nothing may be seen in a tile.
  bool empty(int tile) const;
  // Of a tile that a large surface surely fills, before all else in its bins: that one. All its samples show it, and none
  // has to be drawn; they count as fragments all the same. kNone of other tiles.
  std::uint32_t wall(const SampleBox& samples, int tile, VisibilityCounts& counts) const;
  // Draws what the bins of a tile hold, all threads' alike.
  void draw(const TileView& view, int tile) const;

  const std::vector<ThreadBins>& threads() const { return threads_; }

 private:
  // Triangles of one mesh, or spheres and planes: what a thread sets up at a time.
  struct Batch {
    std::uint32_t first_triangle = 0, first_primitive = 0, size = 0;
  };
  struct Workshop;  // what one thread sets up in

  std::vector<Batch> batches() const;
  void load_chunk(const Corners3* corners, TriangleChunk& chunk) const;
  void set_up_triangles(const Batch& batch, Workshop& shop, ThreadBins& bins) const;
  void set_up_chunk(Workshop& shop, std::uint32_t first_triangle, std::uint32_t first_primitive,
                    ThreadBins& bins) const;
  void set_up_in_double(std::uint32_t triangle, std::uint32_t primitive, const SampleBox& box, bool small,
                        ThreadBins& bins) const;
  void set_up_other(std::uint32_t primitive, ThreadBins& bins) const;
  std::vector<const LargeSurface*> large_surfaces(int tile) const;
  void collect_fragments(const TinyFragments& tiny, std::uint32_t first_primitive, ThreadBins& bins) const;

  // put(bin) for the bin of each tile that a box touches.
  template <class Put>
  void for_each_bin(ThreadBins& bins, const SampleBox& box, const Put& put) const {
    const std::size_t first = tile_column(box.x0), last = tile_column(box.x1 - 1);
    for (std::size_t row = tile_row(box.y0); row <= tile_row(box.y1 - 1); row += tiles_in_row_)
      for (std::size_t column = first; column <= last; ++column) put(bins.tiles[row + column]);
  }
  // A sample's tile is the sum of the two.
  std::size_t tile_column(int X) const { return tile_columns_[static_cast<std::size_t>(X - window_.x0)]; }
  std::size_t tile_row(int Y) const { return tile_rows_[static_cast<std::size_t>(Y - window_.y0)]; }

  const Scene& scene_;
  const Corners3* corners_;
  KeptBins& kept_;
  const Camera& camera_;
  const Kernels& kernels_;
  ScreenSpace space_;
  RaySheet sheet_;
  SampleBox window_;
  // Of each column and row of the window's samples, so that nothing is divided: the column of tiles that it is in, and the
  // number of the first tile of its row.
  std::vector<std::uint32_t> tile_columns_, tile_rows_;
  std::size_t tiles_in_row_;
  KeptArray<ScreenVertex> vertices_;
  std::vector<ThreadBins> threads_;
};

}  // namespace sidelight::raster
