// SPDX-License-Identifier: MIT
// The rasterizer's kernels for sixteen lanes of floats (compiled with -mavx512f and its companions).
#include "raster/setup_kernel.h"
#include "raster/visible_large.h"
#include "raster/visible_small.h"

namespace sidelight::raster {

static_assert(kLanes<stdx::native_simd<float>> == 16);

const Kernels& kernels_avx512() {
  static constexpr Kernels kernels{project_all<stdx::native_simd<double>>,
                                   set_up_chunk<stdx::native_simd<float>>,
                                   draw_small_triangles<stdx::native_simd<float>>,
                                   find_farthest_of_blocks<stdx::native_simd<float>>,
                                   find_wall<stdx::native_simd<float>>,
                                   draw_large_surface<stdx::native_simd<float>>};
  return kernels;
}

}  // namespace sidelight::raster
