// SPDX-License-Identifier: MIT
// One scene of the z-buffers' race: llvmpipe and sidelight draw the same frames in turn, one core and several in turn
// as well, so that whatever else the machine does meets all of them alike.
#pragma once

#include <cstdint>
#include <vector>

#include "common/scene/scene.h"
#include "tests/bench/cost.h"
#include "tests/bench/program.h"

namespace sidelight::bench {

struct RasterPlan {
  std::vector<Size> sizes;
  std::vector<int> threads;  // each its own row, pinned to as many cores
  int frames = 31, warm_up = 3;
  bool judged = true;  // whether exact visibility looks at a frame of each size
};

// What one side shows, against exact visibility.
struct Judgement {
  std::uint64_t wrong = 0;  // pixels with a surface that exact arithmetic does not find there
  double depth_rms = 0;     // of the relative error of the others' depths
};

struct RasterRow {
  Size size;
  int threads = 0;
  CostSpread llvmpipe, sidelight;  // of a frame
};

struct RasterVerdict {
  Size size;
  std::uint64_t covered = 0;  // pixels
  Judgement llvmpipe, sidelight;
  // Of the pixels that both show rightly, those whose colours are more than 2/255 apart: that the work is the same.
  std::uint64_t colors_apart = 0;
};

struct RasterRace {
  std::size_t triangles = 0;
  std::vector<RasterRow> rows;          // by size, then threads
  std::vector<RasterVerdict> verdicts;  // by size; empty where nothing was judged
};

// Runs in processes of its own; no other thread may be running. Throws std::runtime_error where one of them fails.
RasterRace race(const Scene& scene, const RasterPlan& plan);

}  // namespace sidelight::bench
