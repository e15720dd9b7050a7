// SPDX-License-Identifier: MIT
// shading_kernel.h for the readable twin: one lane, and the oracle of the wide ones.
#include "common/model/shading_kernel.h"

namespace sidelight {

void shade_scalar(const ShadingTables& tables, ShadingBatch& batch, bool with_parts) {
  shade_batch<float>(tables, batch, with_parts);
}

}  // namespace sidelight
