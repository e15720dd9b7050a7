// SPDX-License-Identifier: MIT
#include "common/picture/tile_pixels.h"

#include <algorithm>

#include "common/math/four.h"

namespace sidelight {
namespace {

// The mean of one sample is the sample, but for the sign of a zero. A row of them is a row of floats, whose whole cache
// lines go past the caches: nobody reads them soon, and they need not be fetched to be written.
void write_row(const float* from, float* to, std::size_t size) {
  constexpr std::size_t kLine = 16;
  const std::size_t odd = reinterpret_cast<std::uintptr_t>(to) / sizeof(float) % kLine;
  std::size_t i = 0;
  for (const std::size_t first = std::min((kLine - odd) % kLine, size); i < first; ++i)
    to[i] = 0.0f + from[i];
  for (; i + kLine <= size; i += kLine)
    for (std::size_t k = 0; k < kLine; k += 4)
      stream_four(FourFloats{} + load_four<FourFloats>(from + i + k), to + i + k);
  for (; i < size; ++i) to[i] = 0.0f + from[i];
}

}  // namespace

void TilePixels::write_means(Colors samples, const Frame& frame, KeptArray<glm::vec3>& pixels,
                             const std::vector<bool>& streamed) const {
  if (pixels.empty()) return;
  if (n_ == 1) {
    for (int y = pixels_.y0; y < pixels_.y1; ++y)
      if (streamed.empty() || !streamed[row(y)])
        write_row(&samples[row(y) * columns()].x, &pixels[frame.index(pixels_.x0, y)].x, 3 * width());
    return end_streams();
  }
  for_each_pixel(frame, [&](std::size_t pixel, std::size_t first) {
    PixelMean mean;
    for_each_sample(first, [&](std::size_t sample) { mean.add(samples[sample]); });
    pixels[pixel] = mean.mean(static_cast<int>(n_ * n_));
  });
}

}  // namespace sidelight
