// SPDX-License-Identifier: MIT
// Eight lanes of floats, four of doubles (compiled with -mavx2 and -mfma).
#include "raytrace/kernels_in_lanes.h"

namespace sidelight::raytrace {

const Kernels& kernels_avx2() {
  return kKernels<stdx::native_simd<float>, stdx::native_simd<float>, stdx::native_simd<double>>;
}

}  // namespace sidelight::raytrace
