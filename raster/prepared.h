// SPDX-License-Identifier: MIT
// What the z-buffer keeps of a scene between frames.
#pragma once

#include "common/model/shading.h"
#include "raster/raster.h"

namespace sidelight::raster {

class Prepared {
 public:
  Prepared(const Scene& s, const Needs& needs) : scene(s), tables(make_shading_tables(s, needs)) {}

  const Scene& scene;
  ShadingTables tables;
};

}  // namespace sidelight::raster
