// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "common/picture/srgb.h"

using namespace sidelight;

TEST_CASE("the sRGB curve has its known values") {
  CHECK(encode_srgb8(0) == 0);
  CHECK(encode_srgb8(-0.0f) == 0);
  CHECK(encode_srgb8(0.5f) == 188);
  CHECK(encode_srgb8(0.18f) == 118);
  CHECK(encode_srgb8(0.0031308f) == 10);  // 12.92 * 0.0031308 * 255 = 10.31
  CHECK(encode_srgb8(1) == 255);
  CHECK(decode_srgb8(0) == 0);
  CHECK(decode_srgb8(128) == doctest::Approx(0.21586050).epsilon(1e-7));
  CHECK(decode_srgb8(255) == 1);
  CHECK(decode_srgb(1) == 1);
}

TEST_CASE("values outside 0 to 1 are clamped, NaN is black") {
  const float inf = std::numeric_limits<float>::infinity();
  CHECK(encode_srgb8(1e30f) == 255);
  CHECK(encode_srgb8(inf) == 255);
  CHECK(encode_srgb8(-1) == 0);
  CHECK(encode_srgb8(-inf) == 0);
  CHECK(encode_srgb8(std::numeric_limits<float>::denorm_min()) == 0);
  CHECK(encode_srgb8(std::numeric_limits<float>::quiet_NaN()) == 0);
  CHECK(encode_srgb8(-std::numeric_limits<float>::quiet_NaN()) == 0);
}

TEST_CASE("every code comes back") {
  for (int code = 0; code < 256; ++code) {
    CHECK(encode_srgb8(decode_srgb8(static_cast<std::uint8_t>(code))) == code);
  }
}

TEST_CASE("the encoder's table is the formula, float by float, and monotone") {
  const auto by_formula = [](double x) {
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<int>(std::floor(255 * encoded + 0.5));
  };
  int wrong = 0, falls = 0, before = 0;
  const auto check = [&](std::uint32_t bits) {
    const float x = std::bit_cast<float>(bits);
    const int code = encode_srgb8(x);
    wrong += code != by_formula(x);
    falls += code < before;
    before = code;
  };
  const std::uint32_t end = std::bit_cast<std::uint32_t>(1.0f);
  for (std::uint32_t bits = 0; bits <= end; bits += 997) check(bits);
  CHECK(wrong == 0);
  CHECK(falls == 0);

  // Around every step, where an error would hide.
  for (int code = 1; code < 256; ++code) {
    const double encoded = (code - 0.5) / 255;
    const auto bits = std::bit_cast<std::uint32_t>(decode_srgb(encoded));
    before = 0;
    for (std::uint32_t near = bits - 16; near <= bits + 16; ++near) check(near);
    CHECK(before == code);
  }
  CHECK(wrong == 0);
  CHECK(falls == 0);
}

TEST_CASE("a picture is encoded pixel by pixel, top row first") {
  const Image8 image = to_image8(std::vector<glm::vec3>{{0, 0.5f, 1}, {2, -1, 0.18f}}, 1, 2);
  CHECK(image.width == 1);
  CHECK(image.height == 2);
  CHECK(image.rgb == std::vector<std::uint8_t>{0, 188, 255, 255, 0, 118});
}
