// SPDX-License-Identifier: MIT
// surface_kernel.h for four lanes (compiled with -mavx2).
#include "common/model/surface_kernel.h"

namespace sidelight {

static_assert(kLanes<stdx::native_simd<double>> == 4);

[[gnu::flatten]] void surfaces_avx2(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out) {
  surfaces_of_batch<stdx::native_simd<double>>(view, batch, out);
}

}  // namespace sidelight
