// SPDX-License-Identifier: MIT
// One tile's z-buffer, fast: 1/t in float and the primitive of the nearest surface at each sample, 8 bytes a sample. It
// holds the same primitives as DepthTile (tile.h), the readable twin: float comparisons decide only where their bounds
// prove the order of the exact depths, and all others compare those depths.
#pragma once

#include <cstdint>
#include <vector>

#include "common/model/ray_sheet.h"
#include "raster/screen.h"

namespace sidelight::raster {

// A triangle too large for float coordinates on the screen, or around the eye; or a plane.
struct LargeSurface {
  std::uint32_t primitive = kNone;
  float nearest = 0;    // about the greatest 1/t: what is drawn first hides what comes after
  SampleBox box;        // where it may be seen
  bool bounded = true;  // by edges; not a plane
  std::array<EdgeSheet, 3> edge;
  DepthSheet depth;
};

// A small triangle of a mesh: its numbers among all triangles and among all primitives.
struct SmallTriangle {
  std::uint32_t triangle = 0, primitive = kNone;
};
using Corners3 = std::array<std::uint32_t, 3>;  // of a triangle, into Scene::positions

// A sample that a tiny triangle covers.
struct ScreenFragment {
  int X = 0, Y = 0;
  float w = 0;  // 1/t within kDepthError; 0 where that is not sure
  std::uint32_t primitive = kNone;
};

// What a kernel sees of a tile. Its memory is blocks of kBlockColumns x kBlockRows samples from the tile's upper left, row by
// row; a block is stamps of kStamp x kStamp, again row by row, and so is a stamp of samples. A stamp is one vector, or a
// few whole ones: compact, so that most lanes are in a small triangle's box, and at the same place for all triangles, so
// that a store forwards to the next load.
struct TileView {
  static constexpr int kStamp = 4;
  static constexpr int kBlockColumns = 16, kBlockRows = 8, kBlock = kBlockColumns * kBlockRows;

  const Scene& scene;
  const Camera& camera;
  VisibilityCounts& counts;
  SampleBox box;
  int block_columns = 0;
  float* w = nullptr;                  // 0 on background, infinite beyond the tile
  std::uint32_t* primitive = nullptr;  // kNone on background
  float* farthest = nullptr;           // of each block: no sample is farther, by w

  int index(int X, int Y) const {
    const auto x = static_cast<unsigned>(X - box.x0), y = static_cast<unsigned>(Y - box.y0);
    const unsigned block = y / kBlockRows * static_cast<unsigned>(block_columns) + x / kBlockColumns;
    const unsigned stamp = y % kBlockRows / kStamp * (kBlockColumns / kStamp) + x % kBlockColumns / kStamp;
    return static_cast<int>(block * kBlock + (stamp * kStamp + y % kStamp) * kStamp + x % kStamp);
  }
};

// Asks visibility.h whether the primitive covers the sample and is the nearest there. `filtered`: how many signs were
// counted as decided by the filter in advance.
void draw_exactly(const TileView& tile, std::uint32_t primitive, int X, int Y, int filtered);
// The same for a primitive that is known to cover the sample: whether it is the nearest. Its w, or none above 0 where that
// is not sure. (What a sample holds is so a function of the primitive alone, whichever way it won: no count depends on order.)
void order_exactly(const TileView& tile, std::uint32_t primitive, int X, int Y, float w);

class VisibleTile {
 public:
  // Sets the tile to background. The vectors keep their memory from tile to tile.
  TileView clear(const Scene& scene, const Camera& camera, const SampleBox& samples,
                 VisibilityCounts& counts);

  // After all is drawn: the primitive of each sample, row by row.
  const std::uint32_t* primitives(const TileView& tile);

 private:
  std::vector<float> w_, farthest_;
  std::vector<std::uint32_t> primitive_, rows_;
};

void draw_fragments(const TileView& tile, const std::vector<ScreenFragment>& fragments);
void draw_sphere(const TileView& tile, std::uint32_t primitive, const SampleBox& box);

}  // namespace sidelight::raster
