// SPDX-License-Identifier: MIT
#include "common/picture/signed_difference.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "common/picture/srgb.h"

namespace sidelight {
namespace {

// sRGB values. A ramp is straight in these: to the eye its steps are then about even.
constexpr glm::dvec3 kDarker(0.20, 0.04, 0.42), kEqual(0.50, 0.50, 0.50), kBrighter(1.0, 0.90, 0.25);

// 0 to 1.
double strength_of(double difference) { return std::sqrt(std::min(std::abs(difference), 1.0)); }

// visit(pixel, traced - rastered) in luminance.
template <class Visit>
void for_each_difference(const Frame& rastered, const Frame& traced, const Visit& visit) {
  assert(rastered.window == traced.window);
  assert(rastered.color.size() == rastered.pixels() && traced.color.size() == traced.pixels());
  for (std::size_t i = 0; i < rastered.pixels(); ++i) {
    const glm::dvec3 difference = glm::dvec3(traced.color[i]) - glm::dvec3(rastered.color[i]);
    visit(i, glm::dot(glm::dvec3(kLuminance), difference));
  }
}

constexpr std::size_t kHalf = DifferenceHistogram::kBins / 2;

// Of a difference that is not 0.
std::size_t bin_of(double difference) {
  const double place = strength_of(difference) * static_cast<double>(kHalf);
  const std::size_t from_zero = std::min(static_cast<std::size_t>(place), kHalf - 1);
  return difference < 0 ? kHalf - 1 - from_zero : kHalf + from_zero;
}

}  // namespace

glm::vec3 signed_difference_color(double difference) {
  if (std::isnan(difference)) return glm::vec3(1);
  const glm::dvec3 encoded = glm::mix(kEqual, difference < 0 ? kDarker : kBrighter, strength_of(difference));
  return {decode_srgb(encoded.x), decode_srgb(encoded.y), decode_srgb(encoded.z)};
}

std::vector<glm::vec3> signed_difference(const Frame& rastered, const Frame& traced) {
  std::vector<glm::vec3> picture(rastered.pixels());
  for_each_difference(rastered, traced, [&](std::size_t i, double difference) {
    picture[i] = signed_difference_color(difference);
  });
  return picture;
}

double DifferenceHistogram::middle(std::size_t bin) {
  const double strength = (static_cast<double>(bin) + 0.5) / static_cast<double>(kHalf) - 1;
  return strength * std::abs(strength);
}
std::uint64_t DifferenceHistogram::darker() const {
  return std::accumulate(pixels.begin(), pixels.begin() + kHalf, std::uint64_t{0});
}
std::uint64_t DifferenceHistogram::brighter() const {
  return std::accumulate(pixels.begin() + kHalf, pixels.end(), std::uint64_t{0});
}
std::uint64_t DifferenceHistogram::most() const { return *std::max_element(pixels.begin(), pixels.end()); }
double DifferenceHistogram::height(std::size_t bin) const {
  if (pixels[bin] == 0) return 0;
  return std::log1p(static_cast<double>(pixels[bin])) / std::log1p(static_cast<double>(most()));
}

DifferenceHistogram difference_histogram(const Frame& rastered, const Frame& traced) {
  DifferenceHistogram out;
  for_each_difference(rastered, traced, [&](std::size_t, double difference) {
    if (std::isnan(difference))
      ++out.undefined;
    else if (difference == 0)
      ++out.equal;
    else
      ++out.pixels[bin_of(difference)];
  });
  return out;
}

}  // namespace sidelight
