// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "common/picture/error_measure.h"

using namespace sidelight;

namespace {

std::vector<glm::vec3> grey(std::size_t pixels, float value) {
  return std::vector<glm::vec3>(pixels, glm::vec3(value));
}

}  // namespace

TEST_CASE("error measure: equal pictures have no error of any kind") {
  const PictureError error = picture_error(grey(12, 0.5f), grey(12, 0.5f), std::vector<char>(12, 1), 4, 3);
  for (const ErrorMeasure& each : {error.whole, error.covered}) {
    CHECK(each.metrics.rms == 0);
    CHECK(each.p999 == 0);
    CHECK(each.relmse == 0);
    CHECK_FALSE(each.metrics.psnr.has_value());
  }
}

TEST_CASE("error measure: relMSE is relative to the truth, with 0.01 against division by zero") {
  const std::vector<char> all(4, 1);
  CHECK(picture_error(grey(4, 0.5f), grey(4, 0.25f), all, 2, 2).whole.relmse ==
        doctest::Approx(0.0625 / (0.0625 + 0.01)).epsilon(1e-12));
  CHECK(picture_error(grey(4, 0.25f), grey(4, 0.5f), all, 2, 2).whole.relmse ==
        doctest::Approx(0.0625 / (0.25 + 0.01)).epsilon(1e-12));
  CHECK(picture_error(grey(4, 1), grey(4, 0), all, 2, 2).whole.relmse == doctest::Approx(100).epsilon(1e-12));
}

// Differences 1/1024, 2/1024, ... in the red values, none in the others: 3000 values, of which 2997 do not exceed the 997th.
TEST_CASE("error measure: the 99.9th percentile is the least that 99.9 % do not exceed") {
  std::vector<glm::vec3> picture = grey(1000, 0);
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[(i * 7) % 1000].x = static_cast<float>(i + 1) / 1024;
  const PictureError error = picture_error(picture, grey(1000, 0), std::vector<char>(1000, 1), 40, 25);
  CHECK(error.whole.p999 == 997.0 / 1024);
  CHECK(picture_error(grey(1, 0.5f), grey(1, 0), {1}, 1, 1).whole.p999 == 0.5);
}

TEST_CASE("error measure: covered pixels are measured alone, their greatest where it is in the picture") {
  std::vector<glm::vec3> picture = grey(12, 0);
  picture[1].y = 4;     // not covered
  picture[6].z = 0.5f;  // pixel (2, 1) of 4 x 3
  std::vector<char> covered(12, 0);
  covered[6] = covered[11] = 1;
  const PictureError error = picture_error(picture, grey(12, 0), covered, 4, 3);
  CHECK(error.whole.metrics.max.value == 4);
  CHECK(error.covered.metrics.max.value == 0.5);
  CHECK(error.covered.metrics.max.x == 2);
  CHECK(error.covered.metrics.max.y == 1);
  CHECK(error.covered.metrics.max.channel == 2);
  CHECK(error.covered.metrics.rms == doctest::Approx(std::sqrt(0.25 / 6)).epsilon(1e-12));
  CHECK(picture_error(picture, grey(12, 0), std::vector<char>(12, 0), 4, 3).covered.metrics.mean == 0);
}

TEST_CASE("error measure: values that are not finite are counted and left out") {
  std::vector<glm::vec3> picture = grey(4, 0.5f);
  picture[2].x = std::numeric_limits<float>::quiet_NaN();
  picture[3].y = std::numeric_limits<float>::infinity();
  const PictureError error = picture_error(picture, grey(4, 0.25f), {1, 1, 1, 0}, 2, 2);
  CHECK(error.whole.metrics.non_finite == 2);
  CHECK(error.covered.metrics.non_finite == 1);
  CHECK(error.whole.p999 == 0.25);
  CHECK(error.whole.relmse == doctest::Approx(0.0625 / 0.0725).epsilon(1e-12));
}
