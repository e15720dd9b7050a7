// SPDX-License-Identifier: MIT
// Small hand-made frames for the tests of common/picture.
#pragma once

#include <cstdint>
#include <limits>
#include <random>

#include "common/picture/frame.h"
#include "common/scene/scene.h"

namespace sidelight::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInf = std::numeric_limits<float>::infinity();

inline RenderOptions options_with(LayerMask layers, bool keep_samples = false) {
  RenderOptions options;
  options.layers = layers;
  options.keep_samples = keep_samples;
  return options;
}

// A z-buffer's and a tracer's picture of one grey wall (primitive 0, depth 2, colour 0.5) that agree in every
// bit and have no causes.
struct Pair {
  Frame rastered, traced;
};
inline Pair equal_pair(int width, int height, int n = 1) {
  Pair pair{make_frame(width, height, n, options_with(kRasterLayers, true)),
            make_frame(width, height, n, options_with(kRaytraceLayers, true))};
  for (Frame* frame : {&pair.rastered, &pair.traced}) {
    frame->color.assign(frame->pixels(), glm::vec3(0.5f));
    frame->sample_depth.assign(frame->sample_depth.size(), 2.0);
  }
  return pair;
}

// Every array of the frame filled with reproducible noise: any finite float, any id.
inline void fill_with_noise(Frame& frame, unsigned seed) {
  std::mt19937 generator(seed);
  const auto number = [&] {
    return static_cast<float>(static_cast<double>(generator()) * 0x1p-32 - 0.25) * 1e6f;
  };
  const auto fill = [&](KeptArray<glm::vec3>& values) {
    for (glm::vec3& value : values) value = {number(), number(), number()};
  };
  fill(frame.color);
  for (KeptArray<glm::vec3>& layer : frame.rgb) fill(layer);
  fill(frame.normal);
  for (float& depth : frame.depth) depth = number();
  for (float& tests : frame.cost) tests = number();
  for (std::uint32_t& id : frame.object_id) id = static_cast<std::uint32_t>(generator());
  for (std::uint32_t& id : frame.primitive_id) id = static_cast<std::uint32_t>(generator());
}

}  // namespace sidelight::test
