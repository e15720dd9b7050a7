// SPDX-License-Identifier: MIT
#include "viewer/report/embedded_picture.h"

#include <algorithm>

namespace sidelight {
namespace {

constexpr std::size_t kMostPixels = std::size_t{1} << 22;

}  // namespace

int embedding_reduction(const Frame& frame) {
  int factor = 1;
  while (frame.pixels() / static_cast<std::size_t>(factor * factor) > kMostPixels) ++factor;
  return factor;
}

Image8 embedded_picture(std::span<const glm::vec3> picture, const Frame& frame) {
  const int factor = embedding_reduction(frame);
  if (factor == 1) return to_image8(picture, frame.width(), frame.height());
  const int width = std::max(1, frame.width() / factor), height = std::max(1, frame.height() / factor);
  std::vector<glm::vec3> reduced;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      PixelMean mean;
      int count = 0;
      for (int j = y * factor; j < std::min((y + 1) * factor, frame.height()); ++j)
        for (int i = x * factor; i < std::min((x + 1) * factor, frame.width()); ++i, ++count)
          mean.add(picture[frame.index(frame.window.x0 + i, frame.window.y0 + j)]);
      reduced.push_back(mean.mean(count));
    }
  }
  return to_image8(reduced, width, height);
}

}  // namespace sidelight
