// SPDX-License-Identifier: MIT
// What set-up leaves for the tiles (visible_bins.h): a thread's bins, of each tile one.
#pragma once

#include <algorithm>
#include <mutex>
#include <vector>

#include "raster/visible_tile.h"

namespace sidelight::raster {

// What one thread found for one tile.
struct TileBin {
  std::vector<SmallTriangle> front, back;
  float nearest_back = 0;                 // the greatest 1/t of a corner of those
  std::vector<ScreenFragment> fragments;  // of tiny triangles
  std::vector<std::uint32_t> large;       // into ThreadBins::large
  std::vector<std::uint32_t> spheres;     // into ThreadBins::spheres

  void clear() {
    front.clear();
    back.clear();
    nearest_back = 0;
    fragments.clear();
    large.clear();
    spheres.clear();
  }
  void add_back(const SmallTriangle& triangle, float nearest) {
    back.push_back(triangle);
    nearest_back = std::max(nearest_back, nearest);
  }
  bool empty() const {
    return front.empty() && back.empty() && fragments.empty() && large.empty() && spheres.empty();
  }
};

struct BoxedSphere {
  std::uint32_t primitive = kNone;
  SampleBox box;
};

struct ThreadBins {
  std::vector<TileBin> tiles;
  std::vector<LargeSurface> large;
  std::vector<BoxedSphere> spheres;
  VisibilityCounts counts;
  double project_ms = 0, set_up_ms = 0;  // what the thread spent on it

  // Empties them, for so many tiles.
  void begin(int size) {
    tiles.resize(static_cast<std::size_t>(size));
    for (TileBin& tile : tiles) tile.clear();
    large.clear();
    spheres.clear();
    counts = {};
    project_ms = set_up_ms = 0;
  }
};

// The bins of one frame, emptied for the next one, which needs about the same: their memory need not be got, and grown
// into, anew. From any thread.
class KeptBins {
 public:
  // One for each thread.
  std::vector<ThreadBins> take(int threads, int tiles) {
    std::vector<ThreadBins> bins;
    {
      const std::lock_guard lock(mutex_);
      bins.swap(bins_);
    }
    bins.resize(static_cast<std::size_t>(threads));
    for (ThreadBins& of_thread : bins) of_thread.begin(tiles);
    return bins;
  }
  void give_back(std::vector<ThreadBins>&& bins) {
    const std::lock_guard lock(mutex_);
    bins_.swap(bins);
  }

 private:
  std::mutex mutex_;
  std::vector<ThreadBins> bins_;
};

}  // namespace sidelight::raster
