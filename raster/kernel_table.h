// SPDX-License-Identifier: MIT
// All kernels for one instruction set, by its lanes. Included only by kernels_scalar.cpp, kernels_avx2.cpp and
// kernels_avx512.cpp.
#pragma once

#include "raster/setup_kernel.h"
#include "raster/visible_large.h"
#include "raster/visible_small.h"

namespace sidelight::raster {

// D: lanes of double, F: of float.
template <class D, class F>
const Kernels& kernels_in_lanes() {
  static constexpr Kernels kernels{
      project_all<D>, set_up_chunk<F>,      draw_small_triangles<F>, find_farthest_of_blocks<F>,
      find_wall<F>,   draw_large_surface<F>};
  return kernels;
}

}  // namespace sidelight::raster
