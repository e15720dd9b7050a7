// SPDX-License-Identifier: MIT
// Clearings (clearings.h) of balls: which others come near a ball's surface, so that a hit that is near none of these is
// known to be lone without a search. Balls that touch a few others, as those of a flake do, have clearings nearly everywhere.
#pragma once

#include <array>
#include <deque>
#include <mutex>
#include <vector>

#include "raytrace/prepared.h"

namespace sidelight::raytrace {

class BallClearings {
 public:
  // Of all balls, which are looked at when they are asked about for the `patience`th time; `room`: the most that is asked
  // for.
  BallClearings(const Prepared& prepared, double room, int patience);

  // Clearings::contain() of a ball. For any thread.
  bool contain(std::uint32_t primitive, const glm::dvec3& point, double room, Isa isa);

 private:
  // Those near a ball, as indices of spheres; more than kMost, or anything flat: it has no clearings.
  struct Others {
    static constexpr std::uint32_t kMost = 15;

    std::uint32_t count = 0;
    std::array<std::uint32_t, kMost> spheres;
  };

  const Others* others_of(std::uint32_t primitive, std::uint32_t sphere, Isa isa);
  Others find_others(std::uint32_t primitive, const Sphere& ball, Isa isa) const;

  const Prepared& prepared_;
  double room_;
  int patience_;
  // Of each ball how often it was asked about, and what was found then.
  std::vector<std::uint8_t> asked_;
  std::vector<const Others*> others_;
  std::mutex adding_;
  std::deque<Others> found_;
};

}  // namespace sidelight::raytrace
