// SPDX-License-Identifier: MIT
// The rasterizer's kernels for one lane, and the oracle of the wide ones.
#include "raster/kernel_table.h"

namespace sidelight::raster {

const Kernels& kernels_scalar() { return kernels_in_lanes<double, float>(); }

}  // namespace sidelight::raster
