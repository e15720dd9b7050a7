// SPDX-License-Identifier: MIT
// How far two pictures of one size are apart, in linear float, summed in double. Channel values that are not
// finite in one or both pictures are counted by themselves; the other numbers are over the rest.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sidelight {

struct Metrics {
  struct Max {
    double value = 0;
    int x = 0, y = 0, channel = 0;  // the first that has it: row by row, then R, G, B
    float a = 0, b = 0;             // what the two pictures have there
  } max;                            // greatest |a - b|; x and y count from the arrays' first pixel
  double mean = 0;                  // of |a - b| over pixels and channels
  double rms = 0;                   // root of the mean of (a - b)² over pixels and channels
  std::optional<double> psnr;  // of the 8-bit sRGB pictures, in dB, peak 255; empty when those are identical
  std::uint64_t non_finite = 0;  // channel values that are not finite in one or both pictures
};

// a.size() == b.size() == width * height. Symmetric in a and b, but that they change places in `max`.
Metrics measure(std::span<const glm::vec3> a, std::span<const glm::vec3> b, int width, int height);

}  // namespace sidelight
