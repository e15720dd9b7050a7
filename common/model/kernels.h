// SPDX-License-Identifier: MIT
// The model's kernels, each written once over lanes (surface_kernel.h, shading_kernel.h) and instantiated for each
// instruction set, all of which give the same bits. For surface_batch.cpp and shading.cpp, which say what they do.
#pragma once

#include "common/math/isa.h"
#include "common/model/shading.h"
#include "common/model/surface_batch.h"

namespace sidelight {

struct SurfaceView;

struct ModelKernels {
  void (*surfaces)(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out);
  void (*shade)(const ShadingTables& tables, ShadingBatch& batch, bool with_parts);
  void (*light_terms)(const ShadingTables& tables, const ShadingBatch& batch, bool with_parts, LitBatch& out);
};

const ModelKernels& model_kernels_scalar();
const ModelKernels& model_kernels_avx2();
const ModelKernels& model_kernels_avx512();

inline const ModelKernels& model_kernels(Isa isa) {
  return by_isa(isa, model_kernels_scalar, model_kernels_avx2, model_kernels_avx512)();
}

}  // namespace sidelight
