// SPDX-License-Identifier: MIT
#include "common/picture/signed_difference.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/picture/srgb.h"

namespace sidelight {
namespace {

// sRGB values. A ramp is straight in these: to the eye its steps are then about even.
constexpr glm::dvec3 kDarker(0.20, 0.04, 0.42), kEqual(0.50, 0.50, 0.50), kBrighter(1.0, 0.90, 0.25);

}  // namespace

glm::vec3 signed_difference_color(double difference) {
  if (std::isnan(difference)) return glm::vec3(1);
  const double strength = std::sqrt(std::min(std::abs(difference), 1.0));
  const glm::dvec3 encoded = glm::mix(kEqual, difference < 0 ? kDarker : kBrighter, strength);
  return {decode_srgb(encoded.x), decode_srgb(encoded.y), decode_srgb(encoded.z)};
}

std::vector<glm::vec3> signed_difference(const Frame& rastered, const Frame& traced) {
  assert(rastered.window == traced.window);
  assert(rastered.color.size() == rastered.pixels() && traced.color.size() == traced.pixels());
  std::vector<glm::vec3> picture(rastered.pixels());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const glm::dvec3 difference = glm::dvec3(traced.color[i]) - glm::dvec3(rastered.color[i]);
    picture[i] = signed_difference_color(glm::dot(glm::dvec3(kLuminance), difference));
  }
  return picture;
}

}  // namespace sidelight
