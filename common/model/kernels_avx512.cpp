// SPDX-License-Identifier: MIT
// The model's kernels for sixteen lanes of floats, eight of doubles (compiled with -mavx512f and its companions).
#include "common/model/kernels.h"
#include "common/model/shading_kernel.h"
#include "common/model/surface_kernel.h"

namespace sidelight {

static_assert(kLanes<stdx::native_simd<float>> == 16);

const ModelKernels& model_kernels_avx512() {
  static constexpr ModelKernels kernels{surfaces_of_batch<stdx::native_simd<double>>,
                                        shade_batch<stdx::native_simd<float>>,
                                        light_terms_of_batch<stdx::native_simd<float>>};
  return kernels;
}

}  // namespace sidelight
