// SPDX-License-Identifier: MIT
// Shadow rays of one point light, from the light's end: seen from there, the points of a tile are rays with a common
// origin (packets.h), on a face of a cube around it. Which points are dark is what blocker() says of each, every one.
//
// I. Wald, C. Benthin, M. Wagner, P. Slusallek, "Interactive Rendering with Coherent Ray Tracing", 2001, section 4.3
// (shadow rays traced from the light); here sorted, and cut where they lie too far apart.
#pragma once

#include <span>
#include <vector>

#include "raytrace/packets.h"

namespace sidelight::raytrace {

struct ShadowQuery {
  glm::dvec3 from{0};  // leaving_point(); the light is on the side of the surface on which it lies
  // The primitive that asks, where it is flat, or a sphere that is left outward; else kNone.
  std::uint32_t own = kNone;
};

class ShadowPackets {
 public:
  ShadowPackets(const Prepared& prepared, Isa isa);

  // dark[i] != 0 where something blocks query i. The light is not directional.
  void trace(const Light& light, std::span<const ShadowQuery> queries, std::vector<std::uint8_t>& dark,
             SignCounts& counts);

 private:
  // A query on a face of the cube: P = light + depth (axis + u U + v V).
  struct Place {
    double u = 0, v = 0, depth = 0;
    std::uint32_t query = 0;
    std::uint32_t key = 0;  // Morton code of its place among those of the face
  };

  void sort_face();
  void trace_face(int face, std::vector<std::uint8_t>& dark, SignCounts& counts);
  void trace_places(int face, std::size_t first, std::size_t last, std::vector<std::uint8_t>& dark,
                    SignCounts& counts);
  bool is_dark(std::uint32_t query, SignCounts& counts) const;
  static void ask(RayPacket& packet, std::size_t ray, std::uint32_t primitive, SignCounts& counts);

  const Prepared& prepared_;
  Isa isa_;
  RayPacket packet_;
  const Light* light_ = nullptr;
  std::span<const ShadowQuery> queries_;
  std::array<std::vector<Place>, 6> faces_;
  std::vector<Place> sorted_, other_;
  RayPacket::PerRay<std::uint32_t> query_;  // of the packet's rays
};

}  // namespace sidelight::raytrace
