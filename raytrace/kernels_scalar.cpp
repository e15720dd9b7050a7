// SPDX-License-Identifier: MIT
// The readable twin: one lane, and the oracle of the wide ones.
#include "raytrace/ray_kernel.h"

namespace sidelight::raytrace {

const Kernels& kernels_scalar() { return kKernels<float, double>; }

}  // namespace sidelight::raytrace
