// SPDX-License-Identifier: MIT
// Sources: D. Knuth, "The Art of Computer Programming" 3, section 6.4 (multiples of the golden ratio fall
// into the largest gaps left by those before); B. Ottosson, "A perceptual color space for image processing",
// 2020 (Oklab and its matrices); J. Nunez et al., "Optimizing colormaps with consideration for color vision
// deficiency", PLoS ONE 13(7), 2018 (even steps of lightness along blue to yellow).
#include "common/picture/layer_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace sidelight {
namespace {

constexpr Color8 kBlack{};

// 0 to 1, clamped, as one of 256 codes by rounding half up; NaN gives 0.
std::uint8_t code(double value) {
  if (!(value > 0)) return 0;
  return static_cast<std::uint8_t>(std::floor(255 * std::min(value, 1.0) + 0.5));
}

template <class T, class Color>
Image8 colored(const Frame& frame, const KeptArray<T>& values, const Color& color) {
  assert(values.size() == frame.pixels());
  Image8 image{frame.width(), frame.height(), {}};
  image.rgb.reserve(3 * values.size());
  for (const T& value : values) {
    const Color8 c = color(value);
    image.rgb.insert(image.rgb.end(), {c.r, c.g, c.b});
  }
  return image;
}

Image8 depth_picture(const Frame& frame) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const float z : frame.depth) {
    if (!(z > 0)) continue;  // background
    nearest = std::min(nearest, double{z});
    farthest = std::max(farthest, double{z});
  }
  const double least = 1 / farthest, range = 1 / nearest - least;
  return colored(frame, frame.depth, [&](float z) {
    constexpr double kFarthest = 0.2;  // dark, and not background
    if (!(z > 0)) return kBlack;
    const double nearness = range > 0 ? (1 / double{z} - least) / range : 1;
    const std::uint8_t grey = code(kFarthest + (1 - kFarthest) * nearness);
    return Color8{grey, grey, grey};
  });
}

Image8 cost_picture(const Frame& frame) {
  const float greatest = *std::max_element(frame.cost.begin(), frame.cost.end());
  return colored(frame, frame.cost,
                 [&](float tests) { return amount_color(greatest > 0 ? double{tests} / greatest : 0); });
}

Color8 normal_color(const glm::vec3& normal) {
  if (normal == glm::vec3(0)) return kBlack;
  const glm::dvec3 half = 0.5 * (glm::dvec3(normal) + 1.0);
  return {code(half.x), code(half.y), code(half.z)};
}

}  // namespace

Image8 layer_picture(const Frame& frame, Layer layer) {
  switch (layer) {
    case Layer::ambient:
    case Layer::diffuse:
    case Layer::specular:
    case Layer::shadow:
    case Layer::reflection:
    case Layer::refraction:
      break;
    case Layer::depth:
      return depth_picture(frame);
    case Layer::object:
      return colored(frame, frame.object_id, id_color);
    case Layer::primitive:
      return colored(frame, frame.primitive_id, id_color);
    case Layer::normal:
      return colored(frame, frame.normal, normal_color);
    case Layer::cost:
      return cost_picture(frame);
  }
  return to_image8(frame.layer(layer), frame.width(), frame.height());
}

// Hue, saturation, value. The hue turns by the golden ratio with each id; ids whose hues come close, 3, 5, 8,
// ... apart, differ in the other two, which repeat every 2 and 3.
Color8 id_color(std::uint32_t id) {
  if (id == 0) return kBlack;
  constexpr std::uint32_t kGolden = 2654435769u;  // 2^32 / 1.618...
  constexpr std::array kSaturations{0.9, 0.5};
  constexpr std::array kValues{1.0, 0.8, 0.6};
  const double hue = 6 * 0x1p-32 * static_cast<double>(id * kGolden);  // sixths of the circle
  const double saturation = kSaturations[id % kSaturations.size()], value = kValues[id % kValues.size()];
  const auto channel = [&](int sixth) {  // full within one sixth of its own hue, none beyond two
    const double turned = std::abs(hue - sixth), away = std::min(turned, 6 - turned);
    return code(value * (1 - saturation * std::clamp(away - 1, 0.0, 1.0)));
  };
  return {channel(0), channel(2), channel(4)};
}

// A straight line in Oklab (lightness, green to red, blue to yellow), inside the colours that sRGB can show.
Color8 amount_color(double amount) {
  constexpr glm::dvec3 kLeast(0.25, -0.01, -0.1), kMost(0.92, -0.04, 0.16);
  const double t = amount > 0 ? std::min(amount, 1.0) : 0;
  const glm::dvec3 lab = kLeast + t * (kMost - kLeast);
  const double l = lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z;
  const double m = lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z;
  const double s = lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z;
  const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  const auto encoded = [](double linear) { return encode_srgb8(static_cast<float>(linear)); };
  return {encoded(4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3),
          encoded(-1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3),
          encoded(-0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3)};
}

}  // namespace sidelight
