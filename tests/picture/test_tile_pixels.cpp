// SPDX-License-Identifier: MIT
// A tile's rows, of which whole cache lines are streamed, are what PixelMean makes of each pixel, bit for bit: at every
// place in a line, at every width, with negative zeros, and without a touch on the pixels beside.
#include "common/picture/tile_pixels.h"

#include <doctest/doctest.h>

#include <bit>
#include <random>

using namespace sidelight;

namespace {

glm::vec3 some_color(std::mt19937& random) {
  const auto value = [&] { return random() % 8 == 0 ? -0.0f : static_cast<float>(random() % 1000) / 7.0f; };
  const float x = value(), y = value(), z = value();
  return {x, y, z};
}

bool same_bits(const glm::vec3& a, const glm::vec3& b) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

// The pixels of the frame that differ from what they should be.
int wrong_pixels(const Rect& pixels, int n, std::mt19937& random) {
  Frame frame = make_frame(90, 7, n, {});
  const glm::vec3 beside(3, 1, 2);
  frame.color.assign(frame.pixels(), beside);
  KeptArray<glm::vec3> expected = frame.color;
  std::vector<glm::vec3> samples(static_cast<std::size_t>(n * n * pixels.width() * pixels.height()));
  for (glm::vec3& sample : samples) sample = some_color(random);

  const TilePixels tile(pixels, n);
  tile.write_means(samples, frame, frame.color);
  tile.for_each_pixel(frame, [&](std::size_t pixel, std::size_t first) {
    PixelMean mean;
    tile.for_each_sample(first, [&](std::size_t sample) { mean.add(samples[sample]); });
    expected[pixel] = mean.mean(n * n);
  });
  int wrong = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) wrong += !same_bits(frame.color[i], expected[i]);
  return wrong;
}

}  // namespace

TEST_CASE("tile pixels: rows are the means of their samples, bit for bit, and nothing else is written") {
  std::mt19937 random(5);
  for (const int n : {1, 2, 3})
    for (int x0 = 0; x0 < 17; ++x0)
      for (const int width : {1, 2, 5, 6, 11, 16, 17, 32, 64, 73})
        CHECK(wrong_pixels({x0, 2, x0 + width, 5}, n, random) == 0);
}
