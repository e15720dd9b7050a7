// SPDX-License-Identifier: MIT
#include "common/picture/tile_pixels.h"

namespace sidelight {

void TilePixels::write_means(const Colors& samples, const Frame& frame, Colors& pixels) const {
  if (pixels.empty()) return;
  // The mean of one sample is the sample, but for the sign of a zero. A row of them is a row of floats.
  if (n_ == 1) {
    for (int y = pixels_.y0; y < pixels_.y1; ++y) {
      const float* from = &samples[row(y) * columns()].x;
      float* to = &pixels[frame.index(pixels_.x0, y)].x;
      for (std::size_t i = 0; i < 3 * width(); ++i) to[i] = 0.0f + from[i];
    }
    return;
  }
  for_each_pixel(frame, [&](std::size_t pixel, std::size_t first) {
    PixelMean mean;
    for_each_sample(first, [&](std::size_t sample) { mean.add(samples[sample]); });
    pixels[pixel] = mean.mean(static_cast<int>(n_ * n_));
  });
}

}  // namespace sidelight
