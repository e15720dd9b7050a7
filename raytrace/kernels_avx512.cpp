// SPDX-License-Identifier: MIT
// Eight lanes of both, as a node has eight children; of a packet's rays sixteen (compiled with -mavx512f and its
// companions).
#include "raytrace/kernels_in_lanes.h"

namespace sidelight::raytrace {

const Kernels& kernels_avx512() {
  return kKernels<stdx::native_simd<float>, stdx::simd<float, stdx::simd_abi::deduce_t<float, 8>>,
                  stdx::native_simd<double>>;
}

}  // namespace sidelight::raytrace
