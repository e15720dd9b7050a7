// SPDX-License-Identifier: MIT
// Shadow rays of one light. Of a point light from its end: seen from there, the points of a tile are rays with a common
// origin (packets.h), on a face of a cube around it. Those that have little in common, and all of a directional light, go
// as bundles do. Which points are dark is what blocker() says of each, every one.
//
// I. Wald, C. Benthin, M. Wagner, P. Slusallek, "Interactive Rendering with Coherent Ray Tracing", 2001, section 4.3
// (shadow rays traced from the light); here sorted where neighbours lie too far apart.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "raytrace/kernels.h"
#include "raytrace/packets.h"
#include "raytrace/shadow_places.h"

namespace sidelight::raytrace {

class ShadowPackets {
 public:
  ShadowPackets(const Prepared& prepared, Isa isa);

  // dark[k] != 0 where query k asks and something blocks it.
  void trace(const Light& light, const ShadowQueries& queries, std::vector<std::uint8_t>& dark,
             VisibilityCounts& counts);

 private:
  // What the rays of a group, or of more, have in common.
  struct Extent {
    float low_u = kInfinity, high_u = -low_u, low_v = low_u, high_v = -low_u;
    float least_per_depth = low_u;

    void grow(const Extent& other);
    float area() const { return (high_u - low_u) * (high_v - low_v); }
    float width() const { return std::max(high_u - low_u, high_v - low_v); }
    float farthest() const {  // from the face's middle
      return std::max(std::max(-low_u, high_u), std::max(-low_v, high_v));
    }
  };

  Extent group_at(std::size_t first) const;
  float find_groups();
  void trace_face(std::vector<std::uint8_t>& dark, VisibilityCounts& counts);
  void sort_places();
  void trace_groups(std::size_t first, std::size_t last, std::vector<std::uint8_t>& dark,
                    VisibilityCounts& counts);
  void leave(std::size_t number);
  void trace_left(std::vector<std::uint8_t>& dark, VisibilityCounts& counts);
  static void ask(RayPacket& packet, std::size_t ray, std::uint32_t primitive, VisibilityCounts& counts);

  const Prepared& prepared_;
  Isa isa_;
  RayPacket packet_;
  const Light* light_ = nullptr;
  const ShadowQueries* queries_ = nullptr;
  CubeFace face_;
  // Of one face, in the order of the queries and sorted.
  ShadowPlaces places_, sorted_;
  std::vector<std::int32_t> keys_;
  std::vector<Extent> groups_;
  Extent whole_;                          // of all groups
  std::span<const std::int32_t> number_;  // of the packet's rays
  // Rays without a packet, and their numbers.
  std::vector<ShadowQuestion> questions_;
  std::vector<std::uint32_t> left_;
};

}  // namespace sidelight::raytrace
