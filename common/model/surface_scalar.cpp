// SPDX-License-Identifier: MIT
// surface_kernel.h for one lane: the oracle of the wide ones.
#include "common/model/surface_kernel.h"

namespace sidelight {

void surfaces_scalar(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out) {
  surfaces_of_batch<double>(view, batch, out);
}

}  // namespace sidelight
