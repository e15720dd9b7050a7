// SPDX-License-Identifier: MIT
// The readable twin: one lane, and the oracle of the wide ones.
#include "raytrace/kernels_in_lanes.h"

namespace sidelight::raytrace {

const Kernels& kernels_scalar() { return kKernels<float, float, double>; }

}  // namespace sidelight::raytrace
