// SPDX-License-Identifier: MIT
// The rasterizer's kernels for eight lanes of floats (compiled with -mavx2).
#include "raster/kernel_table.h"

namespace sidelight::raster {

static_assert(kLanes<stdx::native_simd<float>> == 8);

const Kernels& kernels_avx2() {
  return kernels_in_lanes<stdx::native_simd<double>, stdx::native_simd<float>>();
}

}  // namespace sidelight::raster
