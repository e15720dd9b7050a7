// SPDX-License-Identifier: MIT
// Eight lanes of both, as a node has eight children (compiled with -mavx512f and its companions).
#include "raytrace/ray_kernel.h"

namespace sidelight::raytrace {

const Kernels& kernels_avx512() {
  return kKernels<stdx::simd<float, stdx::simd_abi::deduce_t<float, 8>>, stdx::native_simd<double>>;
}

}  // namespace sidelight::raytrace
