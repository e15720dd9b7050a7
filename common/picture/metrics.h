// SPDX-License-Identifier: MIT
// How far two pictures of one size are apart, in linear float, summed in double. Non-finite values count by
// themselves and leave the other numbers to the finite ones.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace sidelight {

struct Metrics {
  struct Max {
    double value = 0;
    int x = 0, y = 0, channel = 0;   // the first pixel, row by row, that has it
  } max;                             // greatest |a - b|
  double mean = 0, rms = 0;          // of |a - b| and (a - b)² over pixels and channels
  std::optional<double> psnr;        // of the 8-bit sRGB pictures, peak 255; empty when they are identical
  std::uint64_t non_finite = 0;      // channel values that are not finite in either picture
};

// a.size() == b.size() == width * height.
Metrics measure(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, int width, int height);

}  // namespace sidelight
