// SPDX-License-Identifier: MIT
#include "common/picture/srgb.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace sidelight {
namespace {

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// The definition that the table below tabulates.
int code_by_formula(float linear) {
  return static_cast<int>(std::floor(255 * srgb_from_linear(linear) + 0.5));
}

// The encoder without a power per value. Between 2^-13 (which still encodes to 0) and 1, floats are sorted
// into buckets by exponent and eight bits of mantissa. Across a bucket ln x grows by at most 1/256, so 255
// srgb(x) by at most 255 * 1.055 / 2.4 / 256 < 0.44: a bucket holds at most one step, and one comparison
// finds the code.
class EncodeTable {
 public:
  EncodeTable() {
    threshold_.back() = std::numeric_limits<float>::infinity();
    for (int code = 1; code < 256; ++code)
      threshold_[static_cast<std::size_t>(code)] = least_float_with(code);
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
      const auto bits = kLeastBits + (static_cast<std::uint32_t>(bucket) << kShift);
      first_code_[bucket] = static_cast<std::uint8_t>(code_by_formula(std::bit_cast<float>(bits)));
    }
  }

  std::uint8_t code(float linear) const {
    if (!(linear >= kLeast)) return 0;  // NaN too
    if (linear >= 1) return 255;
    const std::uint8_t code = first_code_[(std::bit_cast<std::uint32_t>(linear) - kLeastBits) >> kShift];
    return linear >= threshold_[code + 1u] ? static_cast<std::uint8_t>(code + 1) : code;
  }

 private:
  static constexpr float kLeast = 0x1p-13f;
  static constexpr std::uint32_t kLeastBits = std::bit_cast<std::uint32_t>(kLeast);
  static constexpr int kShift = 23 - 8;
  static constexpr std::size_t kBuckets = (std::bit_cast<std::uint32_t>(1.0f) - kLeastBits) >> kShift;

  static float least_float_with(int code) {
    auto x = static_cast<float>(linear_from_srgb((code - 0.5) / 255));
    while (code_by_formula(x) >= code) x = std::nextafter(x, 0.0f);
    while (code_by_formula(x) < code) x = std::nextafter(x, 2.0f);
    return x;
  }

  // threshold_[k]: the least float with code k; the last entry stands behind code 255.
  std::array<float, 257> threshold_{};
  std::array<std::uint8_t, kBuckets> first_code_{};
};

std::array<float, 256> make_decode_table() {
  std::array<float, 256> table{};
  for (std::size_t code = 0; code < table.size(); ++code) {
    table[code] = decode_srgb(static_cast<double>(code) / 255);
  }
  return table;
}

}  // namespace

std::uint8_t encode_srgb8(float linear) {
  static const EncodeTable table;
  return table.code(linear);
}

float decode_srgb8(std::uint8_t encoded) {
  static const std::array<float, 256> table = make_decode_table();
  return table[encoded];
}

float decode_srgb(double encoded) { return static_cast<float>(linear_from_srgb(encoded)); }

Image8 to_image8(std::span<const glm::vec3> linear, int width, int height) {
  assert(linear.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Image8 image{width, height, {}};
  image.rgb.reserve(3 * linear.size());
  for (const glm::vec3& color : linear) {
    for (const float channel : {color.x, color.y, color.z}) image.rgb.push_back(encode_srgb8(channel));
  }
  return image;
}

}  // namespace sidelight
