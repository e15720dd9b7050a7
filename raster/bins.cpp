// SPDX-License-Identifier: MIT
#include "raster/bins.h"

#include <algorithm>

#include "common/parallel.h"

namespace sidelight::raster {

Rect TileGrid::tile(int index) const {
  const int x0 = window.x0 + index % columns() * edge, y0 = window.y0 + index / columns() * edge;
  return {x0, y0, std::min(x0 + edge, window.x1), std::min(y0 + edge, window.y1)};
}

Bins bin_primitives(const Scene& scene, const Camera& camera, const TileGrid& grid, int threads) {
  constexpr int kChunk = 1024;   // primitives handed to a thread at a time
  const int n = camera.n;
  const int primitives = static_cast<int>(scene.primitive_object.size());
  const SampleBox window = samples_of(grid.window, n);
  const int tile_samples = n * grid.edge;

  Bins bins(thread_count(threads), grid.count());
  parallel_for((primitives + kChunk - 1) / kChunk, threads, [&](int chunk, int thread) {
    const int end = std::min(primitives, (chunk + 1) * kChunk);
    for (int i = chunk * kChunk; i < end; ++i) {
      const auto primitive = static_cast<std::uint32_t>(i);
      const SampleBox box = intersection(box_of_primitive(scene, camera, primitive), window);
      if (box.empty()) continue;
      for (int row = (box.y0 - window.y0) / tile_samples; row <= (box.y1 - 1 - window.y0) / tile_samples; ++row)
        for (int column = (box.x0 - window.x0) / tile_samples; column <= (box.x1 - 1 - window.x0) / tile_samples;
             ++column)
          bins.bin(thread, row * grid.columns() + column).push_back(primitive);
    }
  });
  return bins;
}

}  // namespace sidelight::raster
