// SPDX-License-Identifier: MIT
// Points that ask a light, as that light sees them: places on a face of a cube around it (shadow_packets.h). Filtered out
// of the hits of a tile and projected many at a time; the same bits for every instruction set.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/math/isa.h"
#include "common/scene/scene.h"

namespace sidelight::raytrace {

// Side by side, for all lights in turn. A light that is asked is on the side of the surface on which the point lies.
// Neighbours in this order should be neighbours in space.
class ShadowQueries {
 public:
  std::vector<double> x, y, z;  // leaving_point()
  std::vector<std::int32_t>
      own;  // the primitive that asks if flat, or a sphere that is left outward; else -1
  std::vector<std::int32_t> asks;  // not 0 where the light is to be asked
  bool seen_by_eye = true;         // else by secondary rays: then neighbours lie farther apart

  std::size_t size() const { return asks.size(); }
  // To a number of queries, rounded up to whole lanes; those that are added ask nothing.
  void resize(std::size_t size);
  glm::dvec3 from(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

// From where a light is seen through: P = light + depth (axis + u U + v V), U and V being the axes that follow.
struct CubeFace {
  // How far beyond its edges a face is used where that spares a second one.
  static constexpr double kWide = 2;
  // Points nearer to the light than this have no direction from it that a double could hold.
  static constexpr double kLeastDepth = 1e-100;

  int axis = 0;
  double sign = 1;
  glm::dvec3 light{0};
  double middle_u = 0, middle_v = 0;  // what u and v are told from
};
// The one that a point lies behind, the point in its middle.
CubeFace face_towards(const glm::dvec3& point, const glm::dvec3& light);

struct ShadowPlaces {
  std::vector<float> u, v;  // from the face's middle; rounded to double, at most kWide, then to float
  std::vector<float> per_depth;
  std::vector<std::int32_t> number;  // of the query
  std::vector<std::int32_t> own;     // as there

  std::size_t size() const { return number.size(); }
  void resize(std::size_t size);
};

// Of all queries that ask: true if they can all be seen through this face; else `places` are of no use. Or, not of all, of
// those that lie behind this face itself.
bool find_places(Isa isa, const ShadowQueries& queries, const CubeFace& face, bool all, ShadowPlaces& places);
inline constexpr std::size_t kNotSeen =
    ~std::size_t{0};  // what the kernel says where this face does not show all

}  // namespace sidelight::raytrace
