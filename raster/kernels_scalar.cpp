// SPDX-License-Identifier: MIT
// The rasterizer's kernels for one lane, and the oracle of the wide ones.
#include "raster/setup_kernel.h"
#include "raster/visible_large.h"
#include "raster/visible_small.h"

namespace sidelight::raster {

const Kernels& kernels_scalar() {
  static constexpr Kernels kernels{project_all<double>,
                                   set_up_chunk<float>,
                                   draw_small_triangles<float>,
                                   find_farthest_of_blocks<float>,
                                   find_wall<float>,
                                   draw_large_surface<float>};
  return kernels;
}

}  // namespace sidelight::raster
