// SPDX-License-Identifier: MIT
// What a piece of work costs, once and many times.
#pragma once

#include <vector>

#include "common/clock.h"
#include "viewer/bench/front.h"

namespace sidelight::bench {

struct Cost {
  double cpu_ms = 0, wall_ms = 0;  // of all threads together, and by the clock
};

template <class Work>
Cost cost_of(const Work& work) {
  const double cpu = cpu_ms(), wall = wall_ms();
  work();
  return {cpu_ms() - cpu, wall_ms() - wall};
}

struct CostSpread {
  Spread cpu, wall;
};

inline CostSpread spread_of_costs(const std::vector<Cost>& costs) {
  std::vector<double> cpu, wall;
  for (const Cost& cost : costs) {
    cpu.push_back(cost.cpu_ms);
    wall.push_back(cost.wall_ms);
  }
  return {spread_of(cpu), spread_of(wall)};
}

// How many times as fast `own` is: by processor time on one core, where others on the machine matter least, else by
// the clock.
inline double times_faster(const CostSpread& peer, const CostSpread& own, int threads) {
  return threads == 1 ? peer.cpu.median / own.cpu.median : peer.wall.median / own.wall.median;
}

}  // namespace sidelight::bench
