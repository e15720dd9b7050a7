// SPDX-License-Identifier: MIT
#include "raytrace/packets.h"

#include <algorithm>

namespace sidelight::raytrace {

void finish(RayPacket& p) {
  constexpr auto kGroup = static_cast<std::size_t>(RayPacket::kGroup);
  const auto size = static_cast<std::size_t>(p.size);
  p.groups = static_cast<int>((size + kGroup - 1) / kGroup);
  for (std::size_t i = size; i < kGroup * static_cast<std::size_t>(p.groups); ++i) {
    p.u[i] = p.u[size - 1];
    p.v[i] = p.v[size - 1];
    p.w[i] = std::numeric_limits<float>::infinity();
    p.primitive[i] = p.own[i] = -1;
  }
  p.extent_u = p.extent_v = 0;
  p.least = std::numeric_limits<float>::infinity();
  p.least_w.fill(p.least);
  for (std::size_t g = 0; g < static_cast<std::size_t>(p.groups); ++g) {
    float low_u = p.u[g * kGroup], high_u = low_u, low_v = p.v[g * kGroup], high_v = low_v,
          low_w = p.w[g * kGroup];
    for (std::size_t i = g * kGroup + 1; i < (g + 1) * kGroup; ++i) {
      low_u = std::min(low_u, p.u[i]);
      high_u = std::max(high_u, p.u[i]);
      low_v = std::min(low_v, p.v[i]);
      high_v = std::max(high_v, p.v[i]);
      low_w = std::min(low_w, p.w[i]);
    }
    // Rounded up, so that [u - half, u + half] covers them.
    constexpr float kUp = 1 + 0x1p-20f;
    p.group_u[g] = 0.5f * (low_u + high_u);
    p.group_v[g] = 0.5f * (low_v + high_v);
    p.extent_u = std::max({p.extent_u, -low_u, high_u});
    p.extent_v = std::max({p.extent_v, -low_v, high_v});
    p.half_u[g] = kUp * (0.5f * (high_u - low_u)) + 0x1p-22f * std::max(-low_u, high_u);
    p.half_v[g] = kUp * (0.5f * (high_v - low_v)) + 0x1p-22f * std::max(-low_v, high_v);
    p.least_w[g] = low_w;
    p.least = std::min(p.least, low_w);
  }
  for (std::size_t g = static_cast<std::size_t>(p.groups); g < p.group_u.size(); ++g)
    p.group_u[g] = p.group_v[g] = p.half_u[g] = p.half_v[g] = 0;
}

void trace_packet(Isa isa, const Prepared& prepared, RayPacket& packet, SignCounts& counts) {
  by_isa(isa, trace_packet_scalar, trace_packet_avx2, trace_packet_avx512)(prepared, packet, counts);
}

}  // namespace sidelight::raytrace
