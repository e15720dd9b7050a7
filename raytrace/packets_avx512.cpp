// SPDX-License-Identifier: MIT
// packet_kernel.h for sixteen lanes, and eight boxes (compiled with -mavx512f and its companions).
#include "raytrace/packet_kernel.h"
#include "raytrace/shadow_places_kernel.h"

namespace sidelight::raytrace {

[[gnu::flatten]] void trace_packet_avx512(const Prepared& prepared, RayPacket& packet,
                                          VisibilityCounts& counts) {
  meet_all<stdx::native_simd<float>, stdx::simd<float, stdx::simd_abi::deduce_t<float, 8>>,
           stdx::native_simd<double>>(prepared, packet, counts);
}

[[gnu::flatten]] std::size_t find_places_avx512(const ShadowQueries& queries, const CubeFace& face, bool all,
                                                ShadowPlaces& places) {
  return find_places_in_lanes<stdx::native_simd<double>>(queries, face, all, places);
}

}  // namespace sidelight::raytrace
