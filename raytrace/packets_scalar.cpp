// SPDX-License-Identifier: MIT
// packet_kernel.h for one lane: the oracle of the wide ones.
#include "raytrace/packet_kernel.h"

namespace sidelight::raytrace {

void trace_packet_scalar(const Prepared& prepared, RayPacket& packet, SignCounts& counts) {
  meet_all<float, float, double>(prepared, packet, counts);
}

}  // namespace sidelight::raytrace
