// SPDX-License-Identifier: MIT
// Clearings: of a triangle, the inner part around which nothing else is, so that a hit there is known to be lone without
// a search (lone_hit.h). Found for triangles that are hit again and again, as walls of glass are; for one thread.
#pragma once

#include <vector>

#include "raytrace/prepared.h"

namespace sidelight::raytrace {

class Clearings {
 public:
  // A triangle is looked at when it is asked about for this many times: it takes as long as a few searches.
  static constexpr int kPatience = 8;

  explicit Clearings(const Prepared& prepared, Isa isa, int patience = kPatience);

  // Whether surely nothing but the triangle itself has a point within `room`, along each axis, of this one on it. Not so
  // where that is not known.
  bool contain(std::uint32_t primitive, const glm::dvec3& point, double room);

 private:
  double find_inset(std::uint32_t primitive) const;
  bool others_near(const Corners& corners) const;

  const Prepared& prepared_;
  Isa isa_;
  double room_;  // that of rays of any length a scene has room for
  // Of each triangle the least barycentric weight from which on it is clear, 1 if nowhere; if negative, how often it is
  // still to be asked about.
  std::vector<float> inset_;
};

}  // namespace sidelight::raytrace
