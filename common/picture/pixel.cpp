// SPDX-License-Identifier: MIT
#include "common/picture/pixel.h"

#include <algorithm>

#include "common/scene/scene.h"

namespace sidelight {

void PixelWriter::add(const Sample& sample) {
  color_.add(sample.color);
  for (std::size_t l = 0; l < layer_.size(); ++l)
    if (!frame_.rgb[l].empty()) layer_[l].add(sample.layer[l]);
  tests_ += sample.tests;
  const int n = frame_.n;
  if (count_ == (n / 2) * n + n / 2) center_ = sample;
  if (!frame_.sample_primitive.empty()) {
    kept_primitive_.push_back(sample.primitive == 0 ? kNone : sample.primitive - 1);
    kept_t_.push_back(sample.t);
  }
  ++count_;
}

void PixelWriter::write(int x, int y) {
  const std::size_t i = frame_.index(x, y);
  frame_.color[i] = color_.mean(count_);
  for (std::size_t l = 0; l < layer_.size(); ++l)
    if (!frame_.rgb[l].empty()) frame_.rgb[l][i] = layer_[l].mean(count_);

  if (!frame_.depth.empty()) frame_.depth[i] = static_cast<float>(center_.t * depth_scale_);
  if (!frame_.object_id.empty()) frame_.object_id[i] = center_.object;
  if (!frame_.primitive_id.empty()) frame_.primitive_id[i] = center_.primitive;
  if (!frame_.normal.empty()) frame_.normal[i] = center_.normal;
  if (!frame_.cost.empty()) frame_.cost[i] = static_cast<float>(tests_);
  const auto first = static_cast<std::ptrdiff_t>(i) * frame_.n * frame_.n;
  std::copy(kept_primitive_.begin(), kept_primitive_.end(), frame_.sample_primitive.begin() + first);
  std::copy(kept_t_.begin(), kept_t_.end(), frame_.sample_depth.begin() + first);
}

}  // namespace sidelight
