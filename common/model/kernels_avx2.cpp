// SPDX-License-Identifier: MIT
// The model's kernels for eight lanes of floats, four of doubles (compiled with -mavx2).
#include "common/model/kernels.h"
#include "common/model/shading_kernel.h"
#include "common/model/surface_kernel.h"

namespace sidelight {

static_assert(kLanes<stdx::native_simd<float>> == 8);

const ModelKernels& model_kernels_avx2() {
  static constexpr ModelKernels kernels{surfaces_of_batch<stdx::native_simd<double>>,
                                        shade_batch<stdx::native_simd<float>>,
                                        light_terms_of_batch<stdx::native_simd<float>>};
  return kernels;
}

}  // namespace sidelight
