// SPDX-License-Identifier: MIT
// Boxes become float without a branch: outward, and by no more than std::nextafter() would move them.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "raytrace/bvh_items.h"
#include "tests/support/random.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

float slowly_down(double x) {
  const auto nearest = static_cast<float>(x);
  return nearest <= x ? nearest : std::nextafter(nearest, -kFar);
}
float slowly_up(double x) {
  const auto nearest = static_cast<float>(x);
  return nearest >= x ? nearest : std::nextafter(nearest, kFar);  // from below 0 to -0
}

std::vector<double> awkward_numbers() {
  std::vector<double> all{0.0,    0x1p-149, 0x1p-150, 0x1.8p-149, 0x1p-1074, 0x1p-126, 0x1.fffffep-127,
                          1e-30,  1.0,      0.1,      1.0f / 3,   1e15,      1e300,    0x1.fffffep127,
                          0x1p128};
  Random random(7);
  for (int exponent = -1074; exponent < 1024; ++exponent)
    for (int i = 0; i < 20; ++i) {
      const double x = std::ldexp(1 + random.uniform(), exponent);
      all.push_back(x);
      all.push_back(static_cast<double>(static_cast<float>(x)));  // exact, or infinite
    }
  const std::size_t size = all.size();
  for (std::size_t i = 0; i < size; ++i)
    for (const double beside : {std::nextafter(all[i], 0.0), std::nextafter(all[i], 1e308)})
      all.push_back(beside);
  return all;
}

}  // namespace

TEST_CASE("BVH: numbers are rounded outward as by the slow way, bit for bit") {
  const std::vector<double> numbers = awkward_numbers();
  std::uint64_t wrong = 0;
  const auto compare = [&](float rounded, float slowly) {
    wrong += std::bit_cast<std::uint32_t>(rounded) != std::bit_cast<std::uint32_t>(slowly);
  };
  const auto check = [&](const glm::dvec3& v) {
    const raytrace::Double3 wide = raytrace::difference(v, glm::dvec3(0));
    const auto low = raytrace::round_down(wide), high = raytrace::round_up(wide);
    for (int axis = 0; axis < 3; ++axis) {
      compare(low[static_cast<std::size_t>(axis)], slowly_down(v[axis]));
      compare(high[static_cast<std::size_t>(axis)], slowly_up(v[axis]));
    }
    CHECK(low[3] == 0);
    CHECK(high[3] == 0);
  };
  for (std::size_t i = 0; i + 2 < numbers.size(); ++i) {
    check({numbers[i], numbers[i + 1], numbers[i + 2]});
    check({-numbers[i], numbers[i + 1], -numbers[i + 2]});
    check({numbers[i], -numbers[i + 1], numbers[i + 2]});
  }
  CHECK(wrong == 0);
}
