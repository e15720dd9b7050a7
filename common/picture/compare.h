// SPDX-License-Identifier: MIT
// The account of the difference between the z-buffer's picture and the tracer's, the ledger:
//   traced = R - S + M + G     (R: z-buffer; S, M, G: the tracer's shadow, reflection and refraction layers),
// checked per pixel and channel, and a map that names each pixel's main cause.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/picture/frame.h"
#include "common/picture/metrics.h"

namespace sidelight {

struct Cause {
  std::uint64_t pixels = 0;  // with a non-zero term in any channel; a pixel may count for several causes
  double energy = 0;  // mean of |term| over all pixels and channels (terms that are not finite left out)
};

struct Comparison {
  int width = 0, height = 0;                // of the part compared: the crop, if there is one
  std::uint64_t covered = 0;                // pixels with at least one hit sample (in either picture)
  std::uint64_t visibility_mismatches = 0;  // samples whose object, primitive or depth differ in any bit
  std::uint64_t unexplained = 0;   // pixels the ledger does not account for, or with a value not finite
  double ledger_max_residual = 0;  // max |traced - (R - S + M + G)| / (R + S + M + G); 0/0 = 0, x/0 = inf
  std::uint64_t spoiled = 0;       // pixels changed by faults on purpose, which are in neither count
  Cause shadow, reflection, refraction;
  Metrics metrics;  // traced against rastered; its maximum in picture coordinates
  // First offenders (row by row) for the message, picture coordinates; -1 if none.
  int mismatch_x = -1, mismatch_y = -1, unexplained_x = -1, unexplained_y = -1;

  bool agrees() const { return visibility_mismatches == 0 && unexplained == 0 && spoiled == 0; }
};

// Both frames of one size, window and sample count, with keep_samples; `traced` with the three ledger layers.
// `lights` is the number of lights of the scene: the tolerance is (2 lights + 12) 2^-24 (R + S + M + G),
// derived in compare.cpp, and none in a channel where S = M = G = 0: there traced must be R in every bit.
// `spoiled`: one a pixel, not 0 where a fault on purpose changes it (faults.h); empty without faults.
Comparison compare(const Frame& rastered, const Frame& traced, std::size_t lights,
                   const std::vector<char>& spoiled = {});

// hue = the cause whose term has the greatest luminance, brightness = |traced - R|: its luminance, at most 1,
// so that an 8-bit picture keeps the hue. Black where the pictures are equal; white where they differ without
// a cause or a value is not finite, however small the difference: that is a fault to be seen. `traced` with
// the ledger layers.
std::vector<glm::vec3> cause_map(const Frame& rastered, const Frame& traced);
inline constexpr std::array<Layer, 3> kCauseLayers{Layer::shadow, Layer::reflection, Layer::refraction};
// In their order; hues in linear RGB.
inline constexpr std::array<const char*, 3> kCauseNames{"shadow", "reflection", "refraction"};
extern const std::array<glm::vec3, 3> kCauseHues;

// The z-buffer's picture becoming the tracer's: R, R - S, R - S + M and R - S + M + G. `traced` with the ledger layers.
std::array<KeptArray<glm::vec3>, 4> ledger_sums(const Frame& rastered, const Frame& traced);

// |traced - rastered|, for difference.png.
std::vector<glm::vec3> absolute_difference(const Frame& rastered, const Frame& traced);

}  // namespace sidelight
