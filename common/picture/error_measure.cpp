// SPDX-License-Identifier: MIT
#include "common/picture/error_measure.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sidelight {
namespace {

// What metrics.h does not have, over the channel values that are finite in both pictures.
void add_distribution(std::span<const glm::vec3> picture, std::span<const glm::vec3> truth,
                      ErrorMeasure& out) {
  std::vector<double> differences;
  differences.reserve(3 * picture.size());
  double sum = 0;
  for (std::size_t i = 0; i < picture.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double a = picture[i][c], b = truth[i][c];
      if (!std::isfinite(a) || !std::isfinite(b)) continue;
      differences.push_back(std::abs(a - b));
      sum += (a - b) * (a - b) / (b * b + 0.01);
    }
  if (differences.empty()) return;
  out.relmse = sum / static_cast<double>(differences.size());
  // ceil(0.999 n) - 1, in whole numbers
  const std::size_t rank = (999 * differences.size() + 999) / 1000 - 1;
  const auto at = differences.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(differences.begin(), at, differences.end());
  out.p999 = *at;
}

ErrorMeasure measure_error(std::span<const glm::vec3> picture, std::span<const glm::vec3> truth, int width,
                           int height) {
  ErrorMeasure out;
  out.metrics = measure(picture, truth, width, height);
  add_distribution(picture, truth, out);
  return out;
}

}  // namespace

PictureError picture_error(std::span<const glm::vec3> picture, std::span<const glm::vec3> truth,
                           const std::vector<char>& covered, int width, int height) {
  assert(picture.size() == truth.size() && picture.size() == covered.size());
  PictureError out;
  out.whole = measure_error(picture, truth, width, height);

  // Covered pixels in one long row, and the greatest one's place brought back.
  std::vector<glm::vec3> some, some_truth;
  std::vector<int> place;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    if (!covered[i]) continue;
    some.push_back(picture[i]);
    some_truth.push_back(truth[i]);
    place.push_back(static_cast<int>(i));
  }
  out.covered = measure_error(some, some_truth, static_cast<int>(some.size()), 1);
  if (some.empty()) return out;
  Metrics::Max& max = out.covered.metrics.max;
  const int at = place[static_cast<std::size_t>(max.x)];
  max.x = at % width;
  max.y = at / width;
  return out;
}

}  // namespace sidelight
