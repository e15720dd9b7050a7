// SPDX-License-Identifier: MIT
#include "common/picture/metrics.h"

#include <cassert>
#include <cmath>

#include "common/picture/srgb.h"

namespace sidelight {
namespace {

// The sums over the channel values that are finite in both pictures.
struct Sums {
  double absolute = 0, square = 0;  // of a - b
  double square8 = 0;               // of the 8-bit sRGB codes' difference
  std::uint64_t count = 0;

  void add(float a, float b) {
    const double difference = static_cast<double>(a) - static_cast<double>(b);
    absolute += std::abs(difference);
    square += difference * difference;
    const double difference8 = encode_srgb8(a) - encode_srgb8(b);
    square8 += difference8 * difference8;
    ++count;
  }
  void add(const Sums& other) {
    absolute += other.absolute;
    square += other.square;
    square8 += other.square8;
    count += other.count;
  }
};

}  // namespace

Metrics measure(std::span<const glm::vec3> a, std::span<const glm::vec3> b, int width, int height) {
  assert(a.size() == b.size());
  assert(a.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Metrics metrics;
  Sums total;
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    // Row by row, so that no sum grows long: rounding grows as width + height, not as width * height.
    Sums row;
    for (int x = 0; x < width; ++x, ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const float from_a = a[i][channel], from_b = b[i][channel];
        if (!std::isfinite(from_a) || !std::isfinite(from_b)) {
          ++metrics.non_finite;
          continue;
        }
        row.add(from_a, from_b);
        const double difference = std::abs(static_cast<double>(from_a) - static_cast<double>(from_b));
        if (difference > metrics.max.value) metrics.max = {difference, x, y, channel, from_a, from_b};
      }
    }
    total.add(row);
  }

  if (total.count == 0) return metrics;
  const auto count = static_cast<double>(total.count);
  metrics.mean = total.absolute / count;
  metrics.rms = std::sqrt(total.square / count);
  if (total.square8 > 0) metrics.psnr = 10 * std::log10(255.0 * 255.0 * count / total.square8);
  return metrics;
}

}  // namespace sidelight
