// SPDX-License-Identifier: MIT
// packet_kernel.h for one lane: the oracle of the wide ones.
#include "raytrace/packet_kernel.h"
#include "raytrace/shadow_places_kernel.h"

namespace sidelight::raytrace {

void trace_packet_scalar(const Prepared& prepared, RayPacket& packet, VisibilityCounts& counts) {
  meet_all<float, float, double>(prepared, packet, counts);
}

std::size_t find_places_scalar(const ShadowQueries& queries, const CubeFace& face, bool all,
                               ShadowPlaces& places) {
  return find_places_in_lanes<double>(queries, face, all, places);
}

}  // namespace sidelight::raytrace
