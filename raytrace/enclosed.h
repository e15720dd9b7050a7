// SPDX-License-Identifier: MIT
// Points that surely lie within a solid, and lights that lie outside of it: every way from the one to the other crosses
// the solid's surface, so that b_i = 0 and no tree is asked. In glass these are most shadow rays.
//
// Why that is certain. Around a point that a closed mesh winds around, no ray escapes it: visibility.h sees the same
// rounded corners from all triangles, so that the mesh stays closed, and an edge belongs to both sides. Corners that are
// rounded move by less than what a lone hit keeps free around it (lone_hit.h), so whether the mesh winds around the point
// does not change, either.
#pragma once

#include "raytrace/media.h"

namespace sidelight::raytrace {

// Whether no ray from within a solid, a sphere or a mesh, escapes it: all of it casts shadows, and there is no degenerate
// triangle, which is never hit and leaves a crack where corners are rounded.
bool shuts_in(const Scene& scene, const Object& solid);

// Whether the light is so far outside that rounding of depths does not matter.
bool is_outside(const Bounds& bounds, const Light& light);

class Enclosures {
 public:
  explicit Enclosures(const Prepared& prepared) : prepared_(prepared) {}

  // The solid, as its place in Prepared::solids, that surely contains a point from which rays leave a hit in this medium;
  // kNone if that is not known. `lone`: whether the hit is (lone_hit.h).
  std::uint32_t around(const glm::dvec3& from, const Media& media, bool lone) const;
  // Whether the light is hidden from all that lies within the solid; not from kNone.
  bool hide(std::uint32_t solid, std::size_t light) const {
    return solid != kNone && prepared_.shuts_in[solid] != 0 &&
           is_outside(prepared_.bounds[solid], prepared_.scene.lights[light]);
  }

 private:
  const Prepared& prepared_;
};

}  // namespace sidelight::raytrace
