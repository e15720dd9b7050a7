// SPDX-License-Identifier: MIT
// Linear light to 8-bit sRGB and back: the one place where a colour is clamped and encoded. No file is read
// or written here, so the window, the metrics and image_io share it.
//
// Source: IEC 61966-2-1:1999, the curve with its linear toe below 0.0031308.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sidelight {

// What R, G and B of a linear colour weigh in its luminance (Rec. 709, whose primaries are sRGB's).
inline constexpr glm::vec3 kLuminance{0.2126f, 0.7152f, 0.0722f};

// 8-bit RGB, top row first.
struct Image8 {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height
};

// Linear to sRGB, clamped to [0, 1], to 8 bits by rounding half up. Monotone; infinity gives 255, NaN 0.
std::uint8_t encode_srgb8(float linear);
// The linear value of an 8-bit sRGB code; encode_srgb8 gives the code back.
float decode_srgb8(std::uint8_t encoded);
// The linear value of an sRGB value in [0, 1].
float decode_srgb(double encoded);

// linear.size() == width * height.
Image8 to_image8(std::span<const glm::vec3> linear, int width, int height);

}  // namespace sidelight
