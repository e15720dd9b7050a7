// SPDX-License-Identifier: MIT
// Where rays that start on a ball meet it again: what intersect() finds of it after kRayStart, bit for bit, in lanes.
#pragma once

#include "common/model/surface_batch.h"

namespace sidelight::raytrace {

struct BallBatch {
  static constexpr std::size_t kCapacity = SurfaceBatch::kCapacity;

  std::size_t size = 0;
  SurfaceBatch::Channel<std::uint32_t> ray;  // the caller's own number
  alignas(64) SurfaceBatch::Vectors origin{}, direction{}, center{};
  alignas(64) SurfaceBatch::Channel<double> radius{};
  // Not 0: its first hit is passed, the second is asked for.
  alignas(64) SurfaceBatch::Channel<double> passes{};
  alignas(64) SurfaceBatch::Channel<double> t{};  // result; infinite where there is no such hit
};

}  // namespace sidelight::raytrace
