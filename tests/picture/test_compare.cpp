// SPDX-License-Identifier: MIT
// Hand-made frames with known answers: each planted fault must change exactly the count that is there for it.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "common/picture/compare.h"
#include "tests/picture/frames.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

void check_counts(const Pair& pair, std::uint64_t mismatches, std::uint64_t unexplained,
                  std::size_t lights = 1) {
  const Comparison result = compare(pair.rastered, pair.traced, lights);
  CHECK(result.visibility_mismatches == mismatches);
  CHECK(result.unexplained == unexplained);
  CHECK(result.agrees() == (mismatches == 0 && unexplained == 0));
}

// 4x3 pixels; pixel 0 lies in shadow, pixel 1 is a mirror, pixel 2 is glass, pixel 3 has all three.
Pair explained_pair() {
  Pair pair = equal_pair(4, 3);
  Frame& traced = pair.traced;
  traced.layer(Layer::shadow)[0] = glm::vec3(0.25f);
  traced.layer(Layer::reflection)[1] = {0.125f, 0, 0};
  traced.layer(Layer::refraction)[2] = {0, 0.5f, 1};
  traced.layer(Layer::shadow)[3] = glm::vec3(0.25f);
  traced.layer(Layer::reflection)[3] = glm::vec3(0.125f);
  traced.layer(Layer::refraction)[3] = glm::vec3(0.0625f);
  for (std::size_t i = 0; i < 4; ++i) {
    traced.color[i] += -traced.layer(Layer::shadow)[i] + traced.layer(Layer::reflection)[i] +
                       traced.layer(Layer::refraction)[i];
  }
  return pair;
}

}  // namespace

TEST_CASE("equal frames agree") {
  const Pair pair = equal_pair(5, 4, 2);
  const Comparison result = compare(pair.rastered, pair.traced, 2);
  CHECK(result.agrees());
  CHECK(result.width == 5);
  CHECK(result.height == 4);
  CHECK(result.covered == 20);
  CHECK(result.ledger_max_residual == 0);
  CHECK(result.shadow.pixels + result.reflection.pixels + result.refraction.pixels == 0);
  CHECK_FALSE(result.metrics.psnr.has_value());
  CHECK(result.mismatch_x == -1);
  CHECK(result.unexplained_x == -1);
}

TEST_CASE("differences that the terms explain are explained, counted and measured") {
  const Pair pair = explained_pair();
  check_counts(pair, 0, 0);
  const Comparison result = compare(pair.rastered, pair.traced, 0);
  CHECK(result.ledger_max_residual == 0);
  CHECK(result.shadow.pixels == 2);
  CHECK(result.reflection.pixels == 2);
  CHECK(result.refraction.pixels == 2);
  CHECK(result.shadow.energy == doctest::Approx(6 * 0.25 / 36));
  CHECK(result.reflection.energy == doctest::Approx(4 * 0.125 / 36));
  CHECK(result.refraction.energy == doctest::Approx((1.5 + 3 * 0.0625) / 36));
  CHECK(result.metrics.max.value == 1);
  CHECK(result.metrics.max.x == 2);
  CHECK(result.metrics.max.channel == 2);
}

TEST_CASE("without a cause one ulp is unexplained, in any channel") {
  for (int channel = 0; channel < 3; ++channel) {
    Pair pair = equal_pair(4, 3);
    pair.traced.color[6][channel] = std::nextafter(0.5f, 1.0f);
    check_counts(pair, 0, 1);
    const Comparison result = compare(pair.rastered, pair.traced, 1);
    CHECK(result.unexplained_x == 2);
    CHECK(result.unexplained_y == 1);
    CHECK(result.ledger_max_residual == 0x1p-23);
  }
  Pair pair = equal_pair(4, 3);  // three wrong channels are one wrong pixel
  pair.traced.color[6] = glm::vec3(0.75f);
  check_counts(pair, 0, 1);

  // A cause in another channel excuses nothing.
  Pair mirror = explained_pair();
  mirror.traced.color[1].y = std::nextafter(0.5f, 1.0f);
  check_counts(mirror, 0, 1);
}

TEST_CASE("every bit means every bit: -0 is not 0") {
  Pair pair = equal_pair(4, 3);
  pair.rastered.color[0] = glm::vec3(0);
  pair.traced.color[0] = {0, -0.0f, 0};
  check_counts(pair, 0, 1);
}

TEST_CASE("with a cause the tolerance is (2 lights + 12) 2^-24 (R + S + M + G)") {
  for (const std::size_t lights : {0u, 1u, 5u}) {
    Pair pair = equal_pair(1, 1);
    pair.traced.layer(Layer::shadow)[0] = glm::vec3(0.125f);  // the sum is 0.625, the tolerance a double
    pair.traced.layer(Layer::refraction)[0] = glm::vec3(0.375f);
    const double tolerance = static_cast<double>(2 * lights + 12) * 0x1p-24;  // times 1
    pair.traced.color[0] = glm::vec3(static_cast<float>(0.75 + tolerance));
    REQUIRE(double{pair.traced.color[0].x} == 0.75 + tolerance);
    check_counts(pair, 0, 0, lights);
    CHECK(compare(pair.rastered, pair.traced, lights).ledger_max_residual == tolerance);
    pair.traced.color[0].z = std::nextafter(pair.traced.color[0].z, 1.0f);
    check_counts(pair, 0, 1, lights);
    pair.traced.color[0] = glm::vec3(static_cast<float>(0.75 - tolerance));
    check_counts(pair, 0, 0, lights);
    pair.traced.color[0].z = std::nextafter(pair.traced.color[0].z, 0.0f);
    check_counts(pair, 0, 1, lights);
  }
}

TEST_CASE("the model's own rounding stays within the derived part of the tolerance") {
  std::mt19937 generator(1);
  const auto number = [&](float most) { return most * static_cast<float>(generator() >> 8) * 0x1p-24f; };
  for (const std::size_t lights : {1u, 2u, 8u, 40u}) {
    Pair pair = equal_pair(100, 50, 2);
    for (std::size_t i = 0; i < pair.rastered.pixels(); ++i) {
      std::array<PixelMean, 5> mean;
      for (int sample = 0; sample < 4; ++sample) {
        const float c1 = number(1), ambient = number(0.2f), mirrored = number(2), glass = number(3);
        float all = ambient, seen = ambient, blocked = 0;
        for (std::size_t light = 0; light < lights; ++light) {
          const float term = number(1);
          const bool blocks = generator() % 2 == 0;
          all += term;
          if (!blocks) seen += term;
          if (blocks) blocked += term;
        }
        const std::array<float, 5> values{c1 * all, c1 * blocked, mirrored, glass,
                                          (c1 * seen + mirrored) + glass};
        for (std::size_t k = 0; k < 5; ++k) mean[k].add(glm::vec3(values[k]));
      }
      pair.rastered.color[i] = mean[0].mean(4);
      pair.traced.layer(Layer::shadow)[i] = mean[1].mean(4);
      pair.traced.layer(Layer::reflection)[i] = mean[2].mean(4);
      pair.traced.layer(Layer::refraction)[i] = mean[3].mean(4);
      pair.traced.color[i] = mean[4].mean(4);
    }
    const Comparison result = compare(pair.rastered, pair.traced, lights);
    CHECK(result.unexplained == 0);
    CHECK(result.ledger_max_residual > 0);
    CHECK(result.ledger_max_residual <= static_cast<double>(2 * lights + 6) * 0x1p-24);
  }
}

TEST_CASE("planted faults of the terms are unexplained") {
  Pair twice = explained_pair();  // a mirror weight used twice
  twice.traced.color[1].x += 0.125f;
  check_counts(twice, 0, 1);

  Pair unbooked = explained_pair();  // a shadow that nobody booked
  unbooked.traced.layer(Layer::shadow)[0] = glm::vec3(0);
  check_counts(unbooked, 0, 1);

  Pair other_light = explained_pair();  // a light that the z-buffer skipped
  for (glm::vec3& color : other_light.rastered.color) color -= glm::vec3(0.0625f);
  check_counts(other_light, 0, 12);
}

TEST_CASE("visibility is compared per sample and bit by bit") {
  Pair depth = equal_pair(4, 3, 2);
  depth.traced.sample_depth[4 * 7 + 2] = std::nextafter(2.0, 3.0);
  check_counts(depth, 1, 0);
  const Comparison result = compare(depth.rastered, depth.traced, 1);
  CHECK(result.mismatch_x == 3);
  CHECK(result.mismatch_y == 1);

  Pair neighbour = equal_pair(4, 3, 2);
  neighbour.rastered.sample_primitive[5] = 1;
  check_counts(neighbour, 1, 0);

  Pair both = equal_pair(4, 3, 2);  // id and depth of one sample: one mismatch
  both.rastered.sample_primitive[5] = 1;
  both.rastered.sample_depth[5] = 1;
  check_counts(both, 1, 0);

  Pair hole = equal_pair(4, 3, 2);
  for (std::size_t s = 0; s < 4; ++s) hole.traced.sample_primitive[s] = kNone;
  check_counts(hole, 4, 0);
}

TEST_CASE("covered pixels have a hit in at least one sample of at least one picture") {
  Pair pair = equal_pair(4, 3, 2);
  for (Frame* frame : {&pair.rastered, &pair.traced}) {
    frame->sample_primitive.assign(frame->sample_primitive.size(), kNone);
    frame->sample_primitive[4 * 2 + 3] = 0;
  }
  pair.traced.sample_depth[0] = 1;  // of a sample without a hit: not a depth
  Comparison result = compare(pair.rastered, pair.traced, 1);
  CHECK(result.covered == 1);
  CHECK(result.visibility_mismatches == 0);
  pair.rastered.sample_primitive[4 * 5] = 3;
  result = compare(pair.rastered, pair.traced, 1);
  CHECK(result.covered == 2);
  CHECK(result.visibility_mismatches == 1);
}

TEST_CASE("a value that is not finite is never explained") {
  for (const float bad : {kNan, kInf}) {
    Pair traced = equal_pair(4, 3);
    traced.traced.color[2].y = bad;
    check_counts(traced, 0, 1);

    Pair both = equal_pair(4, 3);  // the same bits in both pictures
    both.rastered.color[2].y = both.traced.color[2].y = bad;
    check_counts(both, 0, 1);
    CHECK(compare(both.rastered, both.traced, 1).metrics.non_finite == 1);

    Pair layer = explained_pair();
    layer.traced.layer(Layer::reflection)[1].x = bad;
    check_counts(layer, 0, 1);
    CHECK(std::isfinite(compare(layer.rastered, layer.traced, 1).reflection.energy));
  }
}

TEST_CASE("a residual over nothing is infinite") {
  Pair pair = equal_pair(4, 3);
  pair.rastered.color[0] = glm::vec3(0);
  CHECK(compare(pair.rastered, pair.traced, 1).ledger_max_residual ==
        std::numeric_limits<double>::infinity());
}

TEST_CASE("offenders of a crop are named in picture coordinates") {
  RenderOptions options = options_with(kRaytraceLayers, true);
  options.crop = {100, 50, 103, 52};
  Pair pair{make_frame(640, 480, 1, options), make_frame(640, 480, 1, options)};
  pair.traced.color[4] = glm::vec3(1);
  pair.traced.sample_depth[5] = 1;
  const Comparison result = compare(pair.rastered, pair.traced, 1);
  CHECK(result.unexplained_x == 101);
  CHECK(result.unexplained_y == 51);
  CHECK(result.mismatch_x == 102);
  CHECK(result.mismatch_y == 51);
  CHECK(result.metrics.max.x == 101);
  CHECK(result.metrics.max.y == 51);
}

TEST_CASE("the cause map names the cause of greatest luminance, as bright as the difference") {
  Pair pair = explained_pair();
  pair.traced.color[8] = glm::vec3(0.75f);       // no cause
  pair.traced.layer(Layer::shadow)[9].x = kNan;  // and a broken one
  pair.traced.color[9].x = kNan;
  pair.traced.layer(Layer::refraction)[10] = glm::vec3(50);
  pair.traced.color[10] = glm::vec3(50.5f);
  const std::vector<glm::vec3> map = cause_map(pair.rastered, pair.traced);
  const auto close = [](const glm::vec3& a, const glm::vec3& b) { return glm::dot(a - b, a - b) < 1e-10f; };
  CHECK(close(map[0], kCauseHues[0] * 0.25f));
  CHECK(close(map[1], kCauseHues[1] * (0.2126f * 0.125f)));
  CHECK(close(map[2], kCauseHues[2] * (0.7152f * 0.5f + 0.0722f)));
  CHECK(close(map[3], kCauseHues[0] * 0.0625f));  // 0.25 of shadow against 0.125 and 0.0625
  CHECK(map[4] == glm::vec3(0));
  CHECK(map[8] == glm::vec3(1));
  CHECK(map[9] == glm::vec3(1));
  CHECK(close(map[10], kCauseHues[2]));  // clamped, the hue is kept

  // Terms that cancel leave the pictures equal: black.
  Pair cancelled = equal_pair(1, 1);
  cancelled.traced.layer(Layer::shadow)[0] = cancelled.traced.layer(Layer::reflection)[0] = glm::vec3(0.25f);
  CHECK(cause_map(cancelled.rastered, cancelled.traced)[0] == glm::vec3(0));
}

TEST_CASE("the absolute difference") {
  Pair pair = explained_pair();
  const std::vector<glm::vec3> difference = absolute_difference(pair.rastered, pair.traced);
  CHECK(difference[0] == glm::vec3(0.25f));
  CHECK(difference[2] == glm::vec3(0, 0.5f, 1));
  CHECK(difference[4] == glm::vec3(0));
}

TEST_CASE("the ledger's sums lead from the left picture to the right one") {
  Pair pair = equal_pair(2, 1);
  pair.traced.layer(Layer::shadow)[1] = glm::vec3(0.25f);
  pair.traced.layer(Layer::reflection)[1] = glm::vec3(0.125f, 0, 0);
  pair.traced.layer(Layer::refraction)[1] = glm::vec3(0, 0, 1);
  const auto sums = ledger_sums(pair.rastered, pair.traced);
  for (const auto& sum : sums) CHECK(sum[0] == glm::vec3(0.5f));
  CHECK(sums[0][1] == glm::vec3(0.5f));
  CHECK(sums[1][1] == glm::vec3(0.25f));
  CHECK(sums[2][1] == glm::vec3(0.375f, 0.25f, 0.25f));
  CHECK(sums[3][1] == glm::vec3(0.375f, 0.25f, 1.25f));
}
