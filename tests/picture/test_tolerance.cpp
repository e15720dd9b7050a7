// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/picture/tolerance.h"
#include "tests/picture/frames.h"

using namespace sidelight;
using namespace sidelight::test;
using Differences = std::vector<double>;
using Picture = std::vector<glm::vec3>;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// `over` of `pixels` off by 1, the rest equal.
Differences off_by_one(std::size_t over, std::size_t pixels) {
  Differences differences(pixels, 0.0);
  std::fill_n(differences.begin(), over, 1.0);
  return differences;
}

bool passes(const Differences& differences, const Tolerance& tolerance) {
  return count_excess(differences, tolerance).within(tolerance);
}

}  // namespace

TEST_CASE("tolerance: the greatest channel counts, whichever picture is the brighter") {
  const glm::vec3 a(0.5f), b(0.25f, 0.5f, 1.25f);
  CHECK(channel_difference(a, b) == 0.75);
  CHECK(channel_difference(b, a) == 0.75);
  CHECK(channel_difference(a, a) == 0);
  CHECK(channel_difference(glm::vec3(0.0f), glm::vec3(-0.0f)) == 0);
  Differences differences = pixel_differences(Picture{a, a}, Picture{b, a});
  CHECK(differences == Differences{0.75, 0});
  include_channel(differences, {1, 1}, {1, 0.5f});
  CHECK(differences == Differences{0.75, 0.5});
}

TEST_CASE("tolerance: exactly as much as allowed is not over") {
  const Differences differences{0, 0.25, std::nextafter(0.25, 1.0)};
  CHECK(count_excess(differences, {.fail = 0.25}).over == 1);
  CHECK(count_excess(differences, {.fail = std::nextafter(0.25, 0.0)}).over == 2);
  CHECK(count_excess(differences, {}).over == 2);
  CHECK(count_excess(differences, {.hard_fail = 0.25}).hard == 1);
  CHECK(count_excess(differences, {}).hard == 0);
  CHECK(passes({0, 0, 0}, {}));
  CHECK_FALSE(passes({0, std::numeric_limits<double>::denorm_min(), 0}, {}));
}

TEST_CASE("tolerance: one pixel is too many, whatever the size of the picture") {
  for (const std::size_t pixels : {std::size_t{1}, std::size_t{640 * 480}, std::size_t{4'000'000}})
    CHECK_FALSE(passes(off_by_one(1, pixels), {}));
}

TEST_CASE("tolerance: the percentage or the count, whichever allows more") {
  CHECK(passes(off_by_one(5, 100), {.fail_percent = 5}));
  CHECK_FALSE(passes(off_by_one(6, 100), {.fail_percent = 5}));
  CHECK(passes(off_by_one(6, 100), {.fail_percent = 5, .allow = 6}));
  CHECK(passes(off_by_one(6, 100), {.fail_percent = 6, .allow = 2}));
  CHECK_FALSE(passes(off_by_one(7, 100), {.fail_percent = 6, .allow = 6}));
  CHECK(passes(off_by_one(100, 100), {.fail_percent = 100}));
  CHECK(passes({}, {}));
}

// 0.29 % of 10,000 is 29 in decimal; 0.29 * 10000 in double is less.
TEST_CASE("tolerance: a percentage is taken as it is written") {
  for (const auto& [percent, over] : {std::pair{0.29, 29u}, {0.57, 57u}, {0.58, 58u}, {1.13, 113u}}) {
    CAPTURE(percent);
    CHECK(passes(off_by_one(over, 10'000), {.fail_percent = percent}));
    CHECK_FALSE(passes(off_by_one(over + 1, 10'000), {.fail_percent = percent}));
  }
}

TEST_CASE("tolerance: the hard limit holds for every pixel, however many may be over") {
  Differences differences = off_by_one(3, 100);
  differences[50] = 2;
  CHECK(passes(differences, {.allow = 4, .hard_fail = 2}));
  CHECK_FALSE(passes(differences, {.allow = 4, .hard_fail = 1.5}));
  CHECK_FALSE(passes(differences, {.fail = 10, .fail_percent = 100, .hard_fail = 1.5}));
}

TEST_CASE("tolerance: what is not finite never passes, not even against itself") {
  const glm::vec3 fine(0.5f);
  const Tolerance everything{.fail = kInfinity, .fail_percent = 100, .allow = 1000};
  for (const float value : {kNan, kInf, -kInf}) {
    const glm::vec3 bad(0.5f, value, 0.5f);
    CHECK(channel_difference(bad, fine) == kInfinity);
    CHECK(channel_difference(fine, bad) == kInfinity);
    CHECK(channel_difference(bad, bad) == kInfinity);
    const Differences differences = pixel_differences(Picture{fine, bad, bad}, Picture{fine, fine, bad});
    const Excess excess = count_excess(differences, everything);
    CHECK(excess.non_finite == 2);
    CHECK(excess.over == 2);
    CHECK(excess.hard == 2);
    CHECK_FALSE(excess.within(everything));
  }
  Differences differences{0, 0};
  include_channel(differences, {1, kNan}, {1, kNan});
  CHECK(count_excess(differences, everything).non_finite == 1);

  // The greatest floats are finite, however far apart.
  const float most = std::numeric_limits<float>::max();
  const double apart = channel_difference(glm::vec3(most), glm::vec3(-most));
  CHECK(apart == 2 * double{most});
  CHECK(passes({apart}, everything));
}

TEST_CASE("tolerance: the worst pixels come first and not all from one spot") {
  Differences differences(20 * 10, 0.0);
  const auto at = [&](int x, int y) -> double& { return differences[static_cast<std::size_t>(y * 20 + x)]; };
  at(3, 3) = 0.9;
  at(4, 3) = 0.8;  // beside the worst
  at(3, 5) = 0.7;
  at(19, 3) = 0.6;
  at(0, 4) = 0.6;  // next in memory to the one before, but at the other border
  at(10, 9) = 0.1;
  const auto index = [](int x, int y) { return static_cast<std::size_t>(y * 20 + x); };
  using Pixels = std::vector<std::size_t>;
  CHECK(worst_pixels(differences, 20, 0, 9, 1) ==
        Pixels{index(3, 3), index(4, 3), index(3, 5), index(19, 3), index(0, 4), index(10, 9)});
  CHECK(worst_pixels(differences, 20, 0, 9, 2) ==
        Pixels{index(3, 3), index(3, 5), index(19, 3), index(0, 4), index(10, 9)});
  CHECK(worst_pixels(differences, 20, 0, 9, 3) ==
        Pixels{index(3, 3), index(19, 3), index(0, 4), index(10, 9)});
  CHECK(worst_pixels(differences, 20, 0, 2, 2) == Pixels{index(3, 3), index(3, 5)});
  CHECK(worst_pixels(differences, 20, 0.1, 9, 3) == Pixels{index(3, 3), index(19, 3), index(0, 4)});
  CHECK(worst_pixels(Differences(200, 0.0), 20, 0, 9, 1).empty());

  at(7, 7) = kInfinity;
  CHECK(worst_pixels(differences, 20, 0, 1, 1) == Pixels{index(7, 7)});
  CHECK(worst_pixels(differences, 20, kInfinity, 9, 1) == Pixels{index(7, 7)});
}
