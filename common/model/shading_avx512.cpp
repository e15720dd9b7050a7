// SPDX-License-Identifier: MIT
// shading_kernel.h for sixteen lanes (compiled with -mavx512f and its companions).
#include "common/model/shading_kernel.h"

namespace sidelight {

static_assert(kLanes<stdx::native_simd<float>> == 16);

[[gnu::flatten]] void shade_avx512(const ShadingTables& tables, ShadingBatch& batch, bool with_parts) {
  shade_batch<stdx::native_simd<float>>(tables, batch, with_parts);
}

[[gnu::flatten]] void light_terms_avx512(const ShadingTables& tables, const ShadingBatch& batch,
                                         bool with_parts, LitBatch& out) {
  light_terms_of_batch<stdx::native_simd<float>>(tables, batch, with_parts, out);
}

}  // namespace sidelight
