// SPDX-License-Identifier: MIT
// shading_kernel.h for the readable twin: one lane, and the oracle of the wide ones.
#include "common/model/shading_kernel.h"

namespace sidelight {

void shade_scalar(const ShadingTables& tables, ShadingBatch& batch, bool with_parts) {
  shade_batch<float>(tables, batch, with_parts);
}

void light_terms_scalar(const ShadingTables& tables, const ShadingBatch& batch, bool with_parts,
                        LitBatch& out) {
  light_terms_of_batch<float>(tables, batch, with_parts, out);
}

}  // namespace sidelight
