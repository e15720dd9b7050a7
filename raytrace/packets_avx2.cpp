// SPDX-License-Identifier: MIT
// packet_kernel.h for eight lanes (compiled with -mavx2 and -mfma).
#include "raytrace/packet_kernel.h"
#include "raytrace/shadow_places_kernel.h"

namespace sidelight::raytrace {

[[gnu::flatten]] void trace_packet_avx2(const Prepared& prepared, RayPacket& packet,
                                        VisibilityCounts& counts) {
  meet_all<stdx::native_simd<float>, stdx::native_simd<float>, stdx::native_simd<double>>(prepared, packet,
                                                                                          counts);
}

[[gnu::flatten]] std::size_t find_places_avx2(const ShadowQueries& queries, const CubeFace& face, bool all,
                                              ShadowPlaces& places) {
  return find_places_in_lanes<stdx::native_simd<double>>(queries, face, all, places);
}

}  // namespace sidelight::raytrace
