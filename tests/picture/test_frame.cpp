// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "common/picture/frame.h"
#include "tests/picture/frames.h"

using namespace sidelight;
using sidelight::test::options_with;

TEST_CASE("a frame holds what was asked for and nothing else") {
  const Frame plain = make_frame(7, 5, 2, {});
  CHECK(plain.color.size() == 35);
  CHECK(plain.window == Rect{0, 0, 7, 5});
  for (const auto& layer : plain.rgb) CHECK(layer.empty());
  CHECK(plain.depth.empty());
  CHECK(plain.object_id.empty());
  CHECK(plain.primitive_id.empty());
  CHECK(plain.normal.empty());
  CHECK(plain.cost.empty());
  CHECK(plain.sample_primitive.empty());
  CHECK(plain.sample_depth.empty());

  const Frame all = make_frame(7, 5, 2, options_with(kAllLayers, true));
  for (const auto& layer : all.rgb) CHECK(layer == KeptArray<glm::vec3>(35, glm::vec3(0)));
  CHECK(all.depth.size() == 35);
  CHECK(all.object_id.size() == 35);
  CHECK(all.primitive_id.size() == 35);
  CHECK(all.normal.size() == 35);
  CHECK(all.cost == KeptArray<float>(35, 0.0f));
  CHECK(all.sample_primitive.size() == 35 * 4);
  CHECK(all.sample_depth.size() == 35 * 4);

  const Frame shadow = make_frame(7, 5, 1, options_with(layer_bit(Layer::shadow) | layer_bit(Layer::object)));
  CHECK(shadow.layer(Layer::shadow).size() == 35);
  CHECK(shadow.layer(Layer::reflection).empty());
  CHECK(shadow.object_id.size() == 35);
  CHECK(shadow.primitive_id.empty());
}

TEST_CASE("a frame starts with zeros, but for what its renderer writes, whatever its memory held") {
  constexpr int kWidth = 1024, kHeight = 512;  // large enough for memory that is used again
  RenderOptions options = options_with(layer_bit(Layer::shadow) | layer_bit(Layer::depth), true);
  const auto spoil = [&] {
    Frame frame = make_frame(kWidth, kHeight, 2, options);
    frame.color.assign(frame.pixels(), glm::vec3(7));
    frame.layer(Layer::shadow) = frame.color;
    frame.depth.assign(frame.pixels(), 7);
    frame.sample_primitive.assign(frame.sample_primitive.size(), 7);
    frame.sample_depth.assign(frame.sample_depth.size(), 7);
  };
  const auto zero = [](const auto& array) {
    using T = typename std::decay_t<decltype(array)>::value_type;
    return std::count(array.begin(), array.end(), T{}) == static_cast<std::ptrdiff_t>(array.size());
  };
  spoil();
  {
    const Frame frame = make_frame(kWidth, kHeight, 2, options);
    CHECK(zero(frame.color));
    CHECK(zero(frame.layer(Layer::shadow)));
    CHECK(zero(frame.depth));
    CHECK(zero(frame.sample_primitive));
    CHECK(zero(frame.sample_depth));
  }
  spoil();
  const Frame frame = make_frame_to_write(kWidth, kHeight, 2, options, layer_bit(Layer::depth));
  CHECK(zero(frame.layer(Layer::shadow)));
  CHECK_FALSE(zero(frame.color));  // else this test tells nothing of memory that is used again
}

TEST_CASE("a cropped frame holds the crop only") {
  RenderOptions options = options_with(layer_bit(Layer::depth));
  options.crop = {10, 20, 13, 22};
  const Frame frame = make_frame(640, 480, 1, options);
  CHECK(frame.full_width == 640);
  CHECK(frame.full_height == 480);
  CHECK(frame.pixels() == 6);
  CHECK(frame.depth.size() == 6);
  CHECK(frame.index(10, 20) == 0);
  CHECK(frame.index(12, 21) == 5);
}

TEST_CASE("frame_bytes is the size of two frames, at any size") {
  const auto bytes_of = [](const Frame& f) {
    std::size_t bytes = (f.color.size() + f.normal.size()) * sizeof(glm::vec3);
    for (const auto& layer : f.rgb) bytes += layer.size() * sizeof(glm::vec3);
    bytes += (f.depth.size() + f.cost.size()) * sizeof(float);
    bytes += (f.object_id.size() + f.primitive_id.size()) * sizeof(std::uint32_t);
    return bytes + f.sample_primitive.size() * sizeof(std::uint32_t) + f.sample_depth.size() * sizeof(double);
  };
  for (const LayerMask layers : {LayerMask{0}, kVisibilityLayers, kLedgerLayers, kAllLayers}) {
    for (const bool keep_samples : {false, true}) {
      const RenderOptions options = options_with(layers, keep_samples);
      CHECK(frame_bytes(33, 17, 3, options) == 2 * bytes_of(make_frame(33, 17, 3, options)));
    }
  }
  const std::uint64_t pixels = std::uint64_t{65535} * 65535;
  CHECK(frame_bytes(65535, 65535, 8, options_with(0, true)) == 2 * pixels * (12 + 64 * 12));
  CHECK(frame_bytes(65535, 65535, 64, options_with(kAllLayers, true)) == 2 * pixels * (112 + 4096 * 12));
  constexpr int kMost = std::numeric_limits<int>::max();
  CHECK(frame_bytes(kMost, kMost, kMost, options_with(0, true)) == std::numeric_limits<std::uint64_t>::max());
  CHECK(frame_bytes(0, 480, 1, {}) == 0);

  RenderOptions cropped;
  cropped.crop = {0, 0, 2, 2};
  CHECK(frame_bytes(65535, 65535, 1, cropped) == 2 * 4 * 12);
}

TEST_CASE("the first pixel that is not finite is named") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  RenderOptions options = options_with(kAllLayers, true);
  options.crop = {10, 40, 14, 44};
  Frame frame = make_frame(100, 100, 2, options);
  frame.sample_primitive.assign(frame.sample_primitive.size(), kNone);
  CHECK(first_non_finite(frame).empty());

  frame.sample_depth[0] = inf;  // of a sample without a hit: not a value
  CHECK(first_non_finite(frame).empty());
  frame.sample_primitive[4 * frame.index(13, 43) + 3] = 7;
  frame.sample_depth[4 * frame.index(13, 43) + 3] = std::numeric_limits<double>::quiet_NaN();
  CHECK(first_non_finite(frame) == "sample depth at pixel (13, 43)");
  frame.cost[frame.index(12, 43)] = inf;
  CHECK(first_non_finite(frame) == "cost at pixel (12, 43)");
  frame.normal[frame.index(12, 43)].z = -inf;
  CHECK(first_non_finite(frame) == "normal at pixel (12, 43)");
  frame.depth[frame.index(11, 43)] = inf;
  CHECK(first_non_finite(frame) == "depth at pixel (11, 43)");
  frame.layer(Layer::refraction)[frame.index(13, 41)].y = nan;
  CHECK(first_non_finite(frame) == "refraction at pixel (13, 41)");
  frame.color[frame.index(12, 40)].x = nan;
  CHECK(first_non_finite(frame) == "colour at pixel (12, 40)");
  frame.color[frame.index(13, 40)].x = nan;  // later: changes nothing
  CHECK(first_non_finite(frame) == "colour at pixel (12, 40)");
}

TEST_CASE("counts add up, the cut weight does not") {
  RenderStats a, b;
  a.rays = {1, 2, 3, 4};
  b.rays = {10, 20, 30, 40};
  a.visibility = {5, 6, 7, 9};
  b.visibility = {50, 60, 70, 90};
  a.self_shadowed = 8;
  b.self_shadowed = 80;
  a.cut_weight = 0.5;
  b.cut_weight = 0.25;
  a.add_counts(b);
  CHECK(a.rays.primary == 11);
  CHECK(a.rays.shadow == 22);
  CHECK(a.rays.reflection == 33);
  CHECK(a.rays.refraction == 44);
  CHECK(a.visibility.filtered == 55);
  CHECK(a.visibility.in_double == 66);
  CHECK(a.visibility.exact == 77);
  CHECK(a.visibility.tests == 99);
  CHECK(a.self_shadowed == 88);
  CHECK(a.cut_weight == 0.5);
}

TEST_CASE("a pixel's mean is rounded once") {
  // In float, 1 + 2^-24 is 1, four times over; the sum in double keeps all of them.
  PixelMean mean;
  mean.add(glm::vec3(1));
  for (int i = 0; i < 3; ++i) mean.add(glm::vec3(0x1p-24f));
  CHECK(mean.mean(4).x == static_cast<float>((1 + 3 * 0x1p-24) / 4));
  CHECK(mean.mean(4).x != 0.25f);
}
