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

Image8 reduced(std::span<const glm::vec3> linear, int width, int height, int factor) {
  const int across = std::max(1, width / factor), down = std::max(1, height / factor);
  std::vector<glm::vec3> means;
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x) {
      PixelMean mean;
      int count = 0;
      for (int j = y * factor; j < std::min((y + 1) * factor, height); ++j)
        for (int i = x * factor; i < std::min((x + 1) * factor, width); ++i, ++count)
          mean.add(linear[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(i)]);
      means.push_back(mean.mean(count));
    }
  return to_image8(means, across, down);
}

Image8 embedded_picture(std::span<const glm::vec3> picture, const Frame& frame) {
  return reduced(picture, frame.width(), frame.height(), embedding_reduction(frame));
}

}  // namespace sidelight
