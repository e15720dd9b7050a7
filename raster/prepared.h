// SPDX-License-Identifier: MIT
// What the z-buffer keeps of a scene between frames.
#pragma once

#include "common/large_pages.h"
#include "common/model/shading.h"
#include "raster/raster.h"
#include "raster/thread_bins.h"

namespace sidelight::raster {

class Prepared {
 public:
  Prepared(const Scene& s, const Needs& needs) : scene(s), tables(make_shading_tables(s, needs)) {
    corners.resize(s.triangles.size() + 3);
    for (std::size_t i = 0; i < s.triangles.size(); ++i) corners[i] = s.triangles[i].vertex;
    move_to_large_pages<glm::dvec3>(s.positions);
    move_to_large_pages<glm::dvec3>(s.normals);
    move_to_large_pages<Triangle>(s.triangles);
    move_to_large_pages<Corners3>(corners);
  }

  const Scene& scene;
  ShadingTables tables;
  // Of every triangle: all of it that set-up reads, four at a time, so that after the last there are three more.
  std::vector<Corners3> corners;
  mutable KeptBins bins;
};

}  // namespace sidelight::raster
