// SPDX-License-Identifier: MIT
// How far a picture is from one that is nearer the truth, by every measure that a bench shows: metrics.h and more, of the
// whole picture and of what is covered by surfaces, where an empty background cannot flatter.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/picture/metrics.h"

namespace sidelight {

struct ErrorMeasure {
  Metrics metrics;    // max, mean, rms, psnr, non_finite
  double p999 = 0;    // the least that 99.9 % of |a - b| over channel values do not exceed
  double relmse = 0;  // mean of (a - b)² / (b² + 0.01), b the picture that is nearer the truth
  double depth = 0;   // greatest relative error of a sample's depth where both pictures see the same surface
};
struct PictureError {
  ErrorMeasure whole, covered;  // over all pixels, and over those where either picture meets something
};

// Of `picture` against `truth`, both width * height. covered[i] is not 0 where pixel i counts as covered. Values that
// are not finite in one or both are counted in metrics.non_finite and left out else. `depth` is left to the caller, who
// has the samples.
PictureError picture_error(std::span<const glm::vec3> picture, std::span<const glm::vec3> truth,
                           const std::vector<char>& covered, int width, int height);

}  // namespace sidelight
