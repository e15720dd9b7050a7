// SPDX-License-Identifier: MIT
// One tile's z-buffer with faults on purpose: what tile.h does exactly, with a depth format and float precision as
// `faults` says. Never optimised.
#pragma once

#include <vector>

#include "common/model/faults.h"
#include "common/model/visibility.h"
#include "common/scene/camera.h"
#include "raster/setup.h"

namespace sidelight::raster {

// Depth as a z-buffer stores it, as a number that is smaller where the surface is nearer. From the exact depth, so that
// a format's own rounding is all that shows.
class StoredDepth {
 public:
  StoredDepth(const Faults& faults, const Camera& camera);

  double nearest() const { return near_ / scale_; }  // t of the near plane
  double farthest() const { return far_ / scale_; }
  double key(double t) const;

 private:
  std::optional<DepthFormat> format_;
  double near_ = 0, far_ = std::numeric_limits<double>::infinity(), scale_ = 1;
};

class FaultyTile {
 public:
  FaultyTile(const Camera& camera, const Rect& pixels, const Faults& faults);

  // Primitives in the order of their numbers.
  void draw(const Scene& scene, std::uint32_t primitive, VisibilityCounts& counts);

  const Hit& at(int X, int Y) const { return samples_[index(X, Y)].nearest; }
  std::uint32_t tests(int X, int Y) const { return samples_[index(X, Y)].tests; }

 private:
  struct Sample {
    Hit nearest;
    std::uint32_t tests = 0;
  };
  std::size_t index(int X, int Y) const {
    return static_cast<std::size_t>(Y - box_.y0) * static_cast<std::size_t>(box_.x1 - box_.x0) +
           static_cast<std::size_t>(X - box_.x0);
  }
  bool wins(const Hit& hit, const Hit& nearest) const;

  const Camera& camera_;
  SampleBox box_;
  StoredDepth stored_;
  bool in_float_;
  std::vector<Sample> samples_;
};

}  // namespace sidelight::raster
