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

struct SweepPlan {
  std::vector<std::string> scenes;  // files
  std::optional<glm::ivec2> size;   // instead of each scene's
  std::vector<Config> configs;
  int runs = 7;  // timed frames of each, after a warm-up
  bool timed = true;
  PictureCache cache;
  std::atomic<bool>* cancel = nullptr;             // may be null
  std::function<void(const Scene& scene)> loaded;  // hears of each scene, may refuse it; may be empty
  std::function<void(const std::string& what, double done)> progress;  // within `what`; may be empty
};

// Loads all scenes (throws InputError for the first bad one, and what `loaded` throws) and fills all but `command` and what judge() (front.h) adds.
// When `cancel` is raised what is finished stays and `interrupted` is set.
BenchResult run_sweep(const SweepPlan& plan);

// The machine in words: processor, cores, instruction set.
std::string machine_name();

}  // namespace sidelight
