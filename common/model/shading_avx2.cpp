// SPDX-License-Identifier: MIT
// shading_kernel.h for eight lanes (compiled with -mavx2).
#include "common/model/shading_kernel.h"

namespace sidelight {

static_assert(kLanes<stdx::native_simd<float>> == 8);

[[gnu::flatten]] void shade_avx2(const ShadingTables& tables, ShadingBatch& batch, bool with_parts) {
  shade_batch<stdx::native_simd<float>>(tables, batch, with_parts);
}

[[gnu::flatten]] void light_terms_avx2(const ShadingTables& tables, const ShadingBatch& batch,
                                       bool with_parts, LitBatch& out) {
  light_terms_of_batch<stdx::native_simd<float>>(tables, batch, with_parts, out);
}

}  // namespace sidelight
