// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "common/picture/metrics.h"
#include "tests/hardcases/result.h"
#include "tests/tier.h"

using namespace sidelight;
using Picture = std::vector<glm::vec3>;
using test::HardCase;

namespace {

// Multiples of 1/64 in [0, 4): sums and differences of such values are exact in float.
Picture dyadic_picture(std::size_t pixels) {
  Picture picture(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto value = [&](std::size_t k) { return static_cast<float>((i * 7 + k * 31) % 256) / 64; };
    picture[i] = {value(0), value(1), value(2)};
  }
  return picture;
}

}  // namespace

TEST_CASE("a picture against itself") {
  const Picture picture = dyadic_picture(12);
  const Metrics metrics = measure(picture, picture, 4, 3);
  CHECK(metrics.max.value == 0);
  CHECK(metrics.mean == 0);
  CHECK(metrics.rms == 0);
  CHECK_FALSE(metrics.psnr.has_value());
  CHECK(metrics.non_finite == 0);
  HardCase("IMG-2").holds("a picture against itself: all 0, no psnr",
                          metrics.max.value == 0 && metrics.mean == 0 && metrics.rms == 0 && !metrics.psnr);
}

TEST_CASE("a picture against itself plus c") {
  const int width = 2048, height = 512;
  const Picture a = dyadic_picture(std::size_t{width} * height);
  Picture b = a;
  for (glm::vec3& color : b) color += glm::vec3(0.125f);
  const Metrics metrics = measure(a, b, width, height);
  CHECK(metrics.max.value == 0.125);
  CHECK(metrics.mean == doctest::Approx(0.125).epsilon(1e-12));
  CHECK(metrics.rms == doctest::Approx(0.125).epsilon(1e-12));
}

// 4096 x 4096 pixels are 5e7 values: summed one by one in double, up to 5e7 u = 6e-9 of the sum could be lost, but
// roundings of both signs leave far less than that.
TEST_CASE("a constant that no float holds, over many pixels") {
  const int edge = test::tier() == "sanitized" ? 512 : 4096;
  const Picture a(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge), glm::vec3(0)),
      b(a.size(), glm::vec3(0.1f));
  const Metrics metrics = measure(a, b, edge, edge);
  const double c = double{0.1f};
  const HardCase hard("IMG-2");
  hard.at_most("picture against itself plus c, many pixels: relative error of c",
               std::abs(metrics.mean / c - 1), 1e-12);
  hard.at_most("and of c squared", std::abs(metrics.rms * metrics.rms / (c * c) - 1), 1e-12);
}

TEST_CASE("black against white") {
  const Picture black(6, glm::vec3(0)), white(6, glm::vec3(1));
  const Metrics metrics = measure(black, white, 3, 2);
  CHECK(metrics.max.value == 1);
  CHECK(metrics.mean == 1);
  CHECK(metrics.rms == 1);
  REQUIRE(metrics.psnr.has_value());
  CHECK(*metrics.psnr == 0);
  HardCase("IMG-2").holds("black against white: 1 and 0 dB", metrics.max.value == 1 && metrics.mean == 1 &&
                                                                 metrics.rms == 1 && *metrics.psnr == 0);
}

TEST_CASE("one by one pixel, one code apart") {
  const Metrics metrics = measure(Picture{{1, 1, 1}}, Picture{{1, 1, 0.992f}}, 1, 1);  // 0.992 encodes to 254
  CHECK(metrics.max.channel == 2);
  REQUIRE(metrics.psnr.has_value());
  CHECK(*metrics.psnr == doctest::Approx(10 * std::log10(255.0 * 255.0 * 3)).epsilon(1e-12));
}

TEST_CASE("differences too small for 8 bits: no psnr, but a mean") {
  const Metrics metrics = measure(Picture{{0.5f, 0.5f, 0.5f}}, Picture{{0.5f, 0.50001f, 0.5f}}, 1, 1);
  CHECK_FALSE(metrics.psnr.has_value());
  CHECK(metrics.mean > 0);
}

TEST_CASE("swapped pictures give the same numbers") {
  const Picture a = dyadic_picture(20);
  Picture b = a;
  b[7].y += 2;
  b[13].x -= 0.5f;
  const Metrics ab = measure(a, b, 5, 4), ba = measure(b, a, 5, 4);
  CHECK(ab.mean == ba.mean);
  CHECK(ab.rms == ba.rms);
  CHECK(ab.psnr == ba.psnr);
  CHECK(ab.max.value == ba.max.value);
  HardCase("IMG-2").holds("swapped pictures give the same numbers", ab.mean == ba.mean && ab.rms == ba.rms &&
                                                                        ab.psnr == ba.psnr &&
                                                                        ab.max.value == ba.max.value);

  // So do pixels in another order, but for the order of the sums: all terms are dyadic here, so exactly.
  Picture c(a.rbegin(), a.rend()), d(b.rbegin(), b.rend());
  const Metrics cd = measure(c, d, 5, 4);
  HardCase("IMG-2").holds("permuted pixels give the same numbers", ab.mean == cd.mean && ab.rms == cd.rms &&
                                                                       ab.psnr == cd.psnr &&
                                                                       ab.max.value == cd.max.value);
}

TEST_CASE("the greatest difference is named, the first of equals") {
  Picture a(12, glm::vec3(0)), b = a;
  b[5].z = -0.75f;  // (1, 1) of 4x3
  b[9].x = 0.75f;
  b[2].y = 0.5f;
  const Metrics metrics = measure(a, b, 4, 3);
  CHECK(metrics.max.value == 0.75);
  CHECK(metrics.max.x == 1);
  CHECK(metrics.max.y == 1);
  CHECK(metrics.max.channel == 2);
  CHECK(metrics.max.a == 0);
  CHECK(metrics.max.b == -0.75f);
  CHECK(measure(b, a, 4, 3).max.a == -0.75f);
  CHECK(metrics.mean == 2.0 / 36);
  CHECK(metrics.rms == std::sqrt((2 * 0.5625 + 0.25) / 36));
}

TEST_CASE("values that are not finite are counted and leave the rest alone") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Picture reference(4, glm::vec3(0.25f));
  Picture test(4, glm::vec3(0.75f));
  test[1].x = nan;
  test[2].y = inf;
  Metrics metrics = measure(test, reference, 2, 2);
  CHECK(metrics.non_finite == 2);
  CHECK(metrics.max.value == 0.5);
  CHECK(metrics.mean == 0.5);
  CHECK(metrics.rms == 0.5);

  // In both pictures at the same place: still counted, once.
  metrics = measure(test, test, 2, 2);
  CHECK(metrics.non_finite == 2);
  CHECK(metrics.mean == 0);

  const Picture all(4, glm::vec3(nan));
  metrics = measure(all, reference, 2, 2);
  HardCase("IMG-1").holds("12 values of 12 that are not finite are counted, the rest measured apart",
                          metrics.non_finite == 12);
  CHECK(metrics.mean == 0);
  CHECK_FALSE(metrics.psnr.has_value());
}

TEST_CASE("a one-pixel crack vanishes in the rms, so rms cannot be the gate") {
  Picture wall(512 * 512, glm::vec3(1)), cracked = wall;
  cracked[512 * 200 + 100] = glm::vec3(0);
  const Metrics metrics = measure(wall, cracked, 512, 512);
  HardCase("IMG-4").at_most("rms of one black pixel in a white wall of 512 x 512", metrics.rms, 0.002);
  CHECK(metrics.rms == doctest::Approx(0.001953125));
  CHECK(metrics.max.value == 1);
  CHECK(metrics.max.x == 100);
  CHECK(metrics.max.y == 200);
}
