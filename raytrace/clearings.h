// SPDX-License-Identifier: MIT
// Clearings: of a triangle, the inner part around which nothing else is, so that a hit there is known to be lone without
// a search (lone_hit.h); and of balls what is told in ball_clearings.h. Found for what is hit again and again, as walls of
// glass are, in one picture. Threads share it: which of them is the first to find something changes no answer.
#pragma once

#include <optional>
#include <vector>

#include "raytrace/ball_clearings.h"

namespace sidelight::raytrace {

class Clearings {
 public:
  // A triangle or ball is looked at when it is asked about for this many times: it takes as long as a few searches.
  static constexpr int kPatience = 8;

  // Of scenes that have secondary rays; else nothing is ever clear.
  explicit Clearings(const Prepared& prepared, int patience = kPatience);

  // Whether surely nothing but the triangle or ball itself has a point within `room`, along each axis, of this one on
  // it. Not so where that is not known.
  bool contain(std::uint32_t primitive, const glm::dvec3& point, double room, Isa isa);

 private:
  double inset_of(std::uint32_t primitive, std::uint32_t triangle, Isa isa);
  double find_inset(std::uint32_t primitive, Isa isa) const;
  bool others_near(const Corners& corners, Isa isa) const;

  const Prepared& prepared_;
  double room_;  // that of rays of any length a scene has room for
  // Of each triangle the least barycentric weight from which on it is clear, 1 if nowhere; if negative, how often it is
  // still to be asked about.
  std::vector<float> inset_;
  std::optional<BallClearings> balls_;
};

}  // namespace sidelight::raytrace
