// SPDX-License-Identifier: MIT
// The first half of a frame: every vertex projected, every primitive set up once, and what may be seen put into the bins
// of its tiles. Each thread has bins of its own, never merged or sorted: what a tile shows depends on (depth, primitive).
#pragma once

#include <vector>

#include "common/kept_memory.h"
#include "raster/bins.h"
#include "raster/kernels.h"

namespace sidelight::raster {

// What one thread found for one tile.
struct TileBin {
  std::vector<SmallTriangle> front, back;
  std::vector<ScreenFragment> fragments;  // of tiny triangles
  std::vector<std::uint32_t> large;       // into ThreadBins::large
  std::vector<std::uint32_t> spheres;     // into ThreadBins::spheres
};

struct BoxedSphere {
  std::uint32_t primitive = kNone;
  SampleBox box;
};

struct ThreadBins {
  std::vector<TileBin> tiles;
  std::vector<LargeSurface> large;
  std::vector<BoxedSphere> spheres;
  SignCounts counts;
  double project_ms = 0, set_up_ms = 0;  // what the thread spent on it
};

class VisibleBins {
 public:
  // `corners`: Prepared::corners.
  VisibleBins(const Scene& scene, const Corners3* corners, const Camera& camera, const TileGrid& grid,
              Isa isa, int threads);

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
  void collect_fragments(const TinyFragments& tiny, std::uint32_t first_primitive, ThreadBins& bins) const;

  // put(bin) for the bin of each tile that a box touches.
  template <class Put>
  void for_each_bin(ThreadBins& bins, const SampleBox& box, const Put& put) const {
    for (int row = tile_row(box.y0); row <= tile_row(box.y1 - 1); ++row)
      for (int column = tile_column(box.x0); column <= tile_column(box.x1 - 1); ++column)
        put(bins.tiles[static_cast<std::size_t>(row * grid_.columns() + column)]);
  }
  int tile_column(int X) const { return tile_columns_[static_cast<std::size_t>(X - window_.x0)]; }
  int tile_row(int Y) const { return tile_rows_[static_cast<std::size_t>(Y - window_.y0)]; }

  const Scene& scene_;
  const Corners3* corners_;
  const Camera& camera_;
  const TileGrid& grid_;
  const Kernels& kernels_;
  ScreenSpace space_;
  RaySheet sheet_;
  SampleBox window_;
  std::vector<int> tile_columns_, tile_rows_;  // of each column and row of the window's samples: no division
  KeptArray<ScreenVertex> vertices_;
  std::vector<ThreadBins> threads_;
};

}  // namespace sidelight::raster
