// SPDX-License-Identifier: MIT
// What is worked out for many rays at once, in lanes, as arrays of their numbers: where they go that leave a hit, and where
// those that start on a ball meet it again. Kernels::directions and Kernels::own_hits fill in the results.
#pragma once

#include "common/model/surface_batch.h"

namespace sidelight::raytrace {

// The mirror and Snell directions of optics.h, bit for bit.
struct OpticsBatch {
  static constexpr std::size_t kCapacity = SurfaceBatch::kCapacity;
  static constexpr double kNoRefraction = 0;

  std::size_t size = 0;
  // The ray's direction, of any length; N and Nv of optics.h; eta, or kNoRefraction.
  alignas(64) SurfaceBatch::Vectors direction{}, normal{}, facing{};
  alignas(64) SurfaceBatch::Channel<double> eta{};
  // Results: directions as make_ray() takes them in; whether reflection is total. Without refraction the last two are of
  // no meaning.
  alignas(64) SurfaceBatch::Vectors mirrored{}, refracted{};
  alignas(64) SurfaceBatch::Channel<double> total{};  // not 0 where it is
};

// What intersect() finds after kRayStart of the balls at which rays start, bit for bit.
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
