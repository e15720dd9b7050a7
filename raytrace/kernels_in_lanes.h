// SPDX-License-Identifier: MIT
// All kernels for one set of lane types: F as many floats as there are (a packet's rays), B of floats (boxes), D of
// doubles (leaves). Included only by kernels_scalar.cpp, kernels_avx2.cpp and kernels_avx512.cpp, each compiled for its
// instruction set.
#pragma once

#include "raytrace/packet_kernel.h"
#include "raytrace/ray_batch_kernel.h"
#include "raytrace/ray_kernel.h"
#include "raytrace/shadow_places_kernel.h"

namespace sidelight::raytrace {

template <class F, class B, class D>
inline constexpr Kernels kKernels{
    nearest_in_lanes<B, D>,    nearest_of_in_lanes<B, D>, blocker_in_lanes<B, D>,
    blocked_of_in_lanes<B, D>, candidates_in_lanes<B, D>, traverse_in_lanes<B, D>,
    near_in_lanes<B, D>,       near_in_lanes<B, D>,       inset_in_lanes<B, D>,
    directions_in_lanes<D>,    own_hits_in_lanes<D>,      trace_packet_in_lanes<F, B, D>,
    find_places_in_lanes<D>};

}  // namespace sidelight::raytrace
