// SPDX-License-Identifier: MIT
// The rasterizer's kernels for sixteen lanes of floats (compiled with -mavx512f and its companions).
#include "raster/kernel_table.h"

namespace sidelight::raster {

static_assert(kLanes<stdx::native_simd<float>> == 16);

const Kernels& kernels_avx512() {
  return kernels_in_lanes<stdx::native_simd<double>, stdx::native_simd<float>>();
}

}  // namespace sidelight::raster
