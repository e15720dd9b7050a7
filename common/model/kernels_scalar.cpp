// SPDX-License-Identifier: MIT
// The model's kernels for one lane: the oracle of the wide ones.
#include "common/model/kernels.h"
#include "common/model/shading_kernel.h"
#include "common/model/surface_kernel.h"

namespace sidelight {

const ModelKernels& model_kernels_scalar() {
  static constexpr ModelKernels kernels{surfaces_of_batch<double>, shade_batch<float>,
                                        light_terms_of_batch<float>};
  return kernels;
}

}  // namespace sidelight
