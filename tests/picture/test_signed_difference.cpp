// SPDX-License-Identifier: MIT
#include "common/picture/signed_difference.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "common/picture/srgb.h"
#include "tests/picture/frames.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

float lightness(double difference) { return glm::dot(signed_difference_color(difference), kLuminance); }

}  // namespace

TEST_CASE("signed difference: lightness alone tells the sign and the amount") {
  const double steps[] = {-1, -0.5, -0.25, -0.01, -1e-4, 0, 1e-4, 0.01, 0.25, 0.5, 1};
  for (std::size_t i = 1; i < std::size(steps); ++i) CHECK(lightness(steps[i - 1]) < lightness(steps[i]));
}

TEST_CASE("signed difference: neutral at zero, yellow above, violet below, full beyond one") {
  const glm::vec3 equal = signed_difference_color(0), above = signed_difference_color(0.3),
                  below = signed_difference_color(-0.3);
  CHECK(equal.x == equal.y);
  CHECK(equal.y == equal.z);
  CHECK(above.x > above.z);  // red and green against blue: the axis that red-green-blind eyes keep
  CHECK(above.y > above.z);
  CHECK(below.z > below.x);
  CHECK(below.z > below.y);
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(signed_difference_color(1) == signed_difference_color(infinity));
  CHECK(signed_difference_color(-1) == signed_difference_color(-7));
  CHECK(signed_difference_color(std::nan("")) == glm::vec3(1));
}

TEST_CASE("signed difference: halfway at a quarter, in sRGB codes") {
  const auto red = [](double difference) { return int{encode_srgb8(signed_difference_color(difference).x)}; };
  CHECK(std::abs(2 * red(0.25) - red(0) - red(1)) <= 2);  // each code is rounded by half a step at most
  CHECK(std::abs(2 * red(-0.25) - red(0) - red(-1)) <= 2);
}

TEST_CASE("signed difference: a picture of luminance, traced minus rastered") {
  Pair pair = equal_pair(3, 1);
  pair.traced.color[1].y += 0.25f;
  pair.rastered.color[2].y += 0.25f;
  const std::vector<glm::vec3> picture = signed_difference(pair.rastered, pair.traced);
  REQUIRE(picture.size() == 3);
  CHECK(picture[0] == signed_difference_color(0));
  const double green = double{kLuminance.y} * 0.25;  // exact: 0.5, 0.25 and their sum are powers of two
  CHECK(picture[1] == signed_difference_color(green));
  CHECK(picture[2] == signed_difference_color(-green));
}

TEST_CASE("signed difference: a histogram counts every pixel where the colours' scale has it") {
  const double nan = std::nan("");
  const std::vector<double> differences{0, 1e-9, -1e-9, 0.26, 0.26, -0.26, 0.99, 5, -7, nan, 0};
  Pair pair = equal_pair(static_cast<int>(differences.size()), 1);
  for (std::size_t i = 0; i < differences.size(); ++i) {
    pair.rastered.color[i] = glm::vec3(0);
    pair.traced.color[i] = glm::vec3(static_cast<float>(differences[i]));
  }
  const DifferenceHistogram histogram = difference_histogram(pair.rastered, pair.traced);
  CHECK(histogram.equal == 2);
  CHECK(histogram.undefined == 1);
  CHECK(histogram.darker() == 3);
  CHECK(histogram.brighter() == 5);
  CHECK(histogram.most() == 2);
  std::array<std::uint64_t, DifferenceHistogram::kBins> expected{};
  // sqrt(0.26) is 0.51, in the 17th of 32 parts; sqrt(0.99) is in the last, and so is all beyond 1.
  constexpr std::array<std::size_t, 8> kExpected{31, 31 - 16, 0, 32, 32 + 16, 32 + 16, 63, 63};
  for (const std::size_t bin : kExpected) ++expected[bin];
  CHECK(histogram.pixels == expected);

  // A bar is as high as the logarithm of its pixels.
  CHECK(histogram.height(48) == 1);
  CHECK(histogram.height(31) == doctest::Approx(std::log(2) / std::log(3)));
  CHECK(histogram.height(30) == 0);
  CHECK(DifferenceHistogram().height(0) == 0);
}

TEST_CASE("signed difference: a bin's middle is in the bin, and they stand evenly in the colours' strength") {
  constexpr std::size_t kBins = DifferenceHistogram::kBins;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const double middle = DifferenceHistogram::middle(bin);
    CHECK(middle == -DifferenceHistogram::middle(kBins - 1 - bin));
    Pair pair = equal_pair(1, 1);
    pair.rastered.color[0] = glm::vec3(0);
    pair.traced.color[0] = glm::vec3(static_cast<float>(middle));
    CHECK(difference_histogram(pair.rastered, pair.traced).pixels[bin] == 1);
    const double strength = std::copysign(std::sqrt(std::abs(middle)), middle);
    CHECK(strength == doctest::Approx((static_cast<double>(bin) + 0.5) / (kBins / 2) - 1));
  }
}
