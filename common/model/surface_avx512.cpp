// SPDX-License-Identifier: MIT
// surface_kernel.h for eight lanes (compiled with -mavx512f and its companions).
#include "common/model/surface_kernel.h"

namespace sidelight {

static_assert(kLanes<stdx::native_simd<double>> == 8);

[[gnu::flatten]] void surfaces_avx512(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out) {
  surfaces_of_batch<stdx::native_simd<double>>(view, batch, out);
}

}  // namespace sidelight
