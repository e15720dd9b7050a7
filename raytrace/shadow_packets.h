// SPDX-License-Identifier: MIT
// Shadow rays of one point light, from the light's end: seen from there, the points of a tile are rays with a common
// origin (packets.h), on a face of a cube around it. Which points are dark is what blocker() says of each, every one.
//
// I. Wald, C. Benthin, M. Wagner, P. Slusallek, "Interactive Rendering with Coherent Ray Tracing", 2001, section 4.3
// (shadow rays traced from the light); here sorted where neighbours lie too far apart.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "raytrace/kernels.h"
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

  // dark[k] != 0 where something blocks queries[asking[k]]. The light is not directional. Neighbours in this order should
  // be neighbours in space.
  void trace(const Light& light, std::span<const ShadowQuery> queries, std::span<const std::uint32_t> asking,
             std::vector<std::uint8_t>& dark, SignCounts& counts);

 private:
  // Queries on a face of the cube, side by side: P = light + (axis + u U + v V) / per_depth.
  struct Places {
    std::vector<double> u, v;
    std::vector<float> per_depth;
    std::vector<std::uint32_t> number;  // in asking_
    std::vector<std::int32_t> own;      // ShadowQuery::own, -1 for kNone

    std::size_t size() const { return number.size(); }
    void resize(std::size_t size);
  };
  // What the rays of a group, or of more, have in common.
  struct Extent {
    double low_u = std::numeric_limits<double>::infinity(), high_u = -low_u, low_v = low_u, high_v = -low_u;
    float least_per_depth = std::numeric_limits<float>::infinity();

    void grow(const Extent& other);
    double area() const { return (high_u - low_u) * (high_v - low_v); }
  };

  bool find_places(int face, bool all);
  template <int kAxis>
  bool find_places_along(int face, bool all);
  Extent group_at(std::size_t first) const;
  double find_groups();
  void trace_face(int face, std::vector<std::uint8_t>& dark, SignCounts& counts);
  void sort_places();
  void trace_groups(std::size_t first, std::size_t last, std::vector<std::uint8_t>& dark, SignCounts& counts);
  const ShadowQuery& query(std::size_t number) const { return queries_[asking_[number]]; }
  void leave(std::size_t number);
  void trace_left(std::vector<std::uint8_t>& dark, SignCounts& counts);
  static void ask(RayPacket& packet, std::size_t ray, std::uint32_t primitive, SignCounts& counts);

  const Prepared& prepared_;
  Isa isa_;
  RayPacket packet_;
  const Light* light_ = nullptr;
  std::span<const ShadowQuery> queries_;
  std::span<const std::uint32_t> asking_;
  // Of one face, in the order of the queries and sorted.
  Places places_, sorted_;
  std::vector<std::uint32_t> keys_;
  std::vector<Extent> groups_;
  Extent whole_;                           // of all groups
  std::span<const std::uint32_t> number_;  // of the packet's rays
  // Rays without a packet, and their numbers.
  std::vector<ShadowQuestion> questions_;
  std::vector<std::uint32_t> left_;
};

}  // namespace sidelight::raytrace
