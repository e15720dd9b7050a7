// SPDX-License-Identifier: MIT
#include "raytrace/packets.h"

namespace sidelight::raytrace {

void start(RayPacket& p) {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  const auto size = static_cast<std::size_t>(p.size), groups = (size + kGroup - 1) / kGroup;
  p.groups = static_cast<int>(groups);
  for (std::size_t i = size; i < kGroup * groups; ++i) {
    p.u[i] = p.u[size - 1];
    p.v[i] = p.v[size - 1];
    p.w[i] = kInfinity;
    p.own[i] = -1;
  }
  for (std::size_t g = groups; g < p.least_w.size(); ++g) {
    p.group_u[0][g] = p.group_v[0][g] = kInfinity;
    p.group_u[1][g] = p.group_v[1][g] = -kInfinity;
  }
  p.primitive.fill(-1);
  p.asked.fill(0);
}

}  // namespace sidelight::raytrace
