// SPDX-License-Identifier: MIT
#include "raytrace/packets.h"

#include <algorithm>

namespace sidelight::raytrace {

void finish_places(RayPacket& p) {
  constexpr auto kGroup = static_cast<std::size_t>(RayPacket::kGroup);
  const auto size = static_cast<std::size_t>(p.size);
  p.groups = static_cast<int>((size + kGroup - 1) / kGroup);
  for (std::size_t i = size; i < kGroup * static_cast<std::size_t>(p.groups); ++i) {
    p.u[i] = p.u[size - 1];
    p.v[i] = p.v[size - 1];
  }
  p.extent_u = p.extent_v = 0;
  const auto bound = [&](const float* place, std::array<RayPacket::PerGroup<float>, 2>& of, std::size_t g,
                         float& extent) {
    const auto [low, high] = std::minmax_element(place + g * kGroup, place + (g + 1) * kGroup);
    of[0][g] = *low;
    of[1][g] = *high;
    extent = std::max({extent, -*low, *high});
  };
  for (std::size_t g = 0; g < static_cast<std::size_t>(p.groups); ++g) {
    bound(p.u.data(), p.group_u, g, p.extent_u);
    bound(p.v.data(), p.group_v, g, p.extent_v);
  }
  for (std::size_t g = static_cast<std::size_t>(p.groups); g < p.least_w.size(); ++g)
    p.group_u[0][g] = p.group_u[1][g] = p.group_v[0][g] = p.group_v[1][g] = 0;
}

void start(RayPacket& p) {
  constexpr auto kGroup = static_cast<std::size_t>(RayPacket::kGroup);
  p.primitive.fill(-1);
  p.asked.fill(false);
  p.least_w.fill(std::numeric_limits<float>::infinity());
  const std::size_t whole = kGroup * static_cast<std::size_t>(p.groups);
  for (std::size_t i = static_cast<std::size_t>(p.size); i < whole; ++i) {
    p.w[i] = std::numeric_limits<float>::infinity();
    p.own[i] = -1;
  }
  for (std::size_t g = 0; g < static_cast<std::size_t>(p.groups); ++g)
    p.least_w[g] = *std::min_element(&p.w[g * kGroup], &p.w[g * kGroup] + kGroup);
  p.least = *std::min_element(p.least_w.begin(), p.least_w.end());
}

void trace_packet(Isa isa, const Prepared& prepared, RayPacket& packet, SignCounts& counts) {
  by_isa(isa, trace_packet_scalar, trace_packet_avx2, trace_packet_avx512)(prepared, packet, counts);
}

}  // namespace sidelight::raytrace
