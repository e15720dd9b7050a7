// SPDX-License-Identifier: MIT
// The sweep: every configuration on every scene, its errors first, then its times, in rounds over all configurations so
// that whatever else the machine does hits all of them alike.
#pragma once

#include <atomic>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>

#include "viewer/bench/cache.h"
#include "viewer/bench/knobs.h"

namespace sidelight {

// The default sweep is to take less than two minutes a scene at 640x480 on two cores. So one frame of every configuration
// may take this many steps a pixel together (stage.h), as tried out on fewer pixels; with seven runs, and 12 ns a step,
// that is 25 s. The dearest are left out until the rest fits.
inline constexpr double kRoundSteps = 1500;

struct SweepPlan {
  std::vector<std::string> scenes;  // files
  std::optional<glm::ivec2> size;   // instead of each scene's
  std::vector<Config> configs;
  int runs = 7;  // timed frames of each, after a warm-up
  bool timed = true;
  PictureCache cache{""};
  std::atomic<bool>* cancel = nullptr;             // may be null
  std::function<void(const Scene& scene)> loaded;  // hears of each scene, may refuse it; may be empty
  std::function<void(double done)> progress;       // of the whole sweep, from any thread; may be empty
  bool limited = false;  // leave out, by name, what would exceed kRoundSteps; but no standard setting
};

// Loads all scenes (throws InputError for the first bad one, and what `loaded` throws) and fills all but `command` and
// what judge() (front.h) adds.
// When `cancel` is raised what is finished stays and `interrupted` is set.
BenchResult run_sweep(const SweepPlan& plan);

// The machine in words: processor, cores, instruction set.
std::string machine_name();

}  // namespace sidelight
