// SPDX-License-Identifier: MIT
// Where rays go that leave many hits: the mirror and Snell directions of optics.h, bit for bit, computed in lanes.
#pragma once

#include "common/model/surface_batch.h"

namespace sidelight::raytrace {

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

}  // namespace sidelight::raytrace
