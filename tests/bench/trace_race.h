// SPDX-License-Identifier: MIT
// One scene of the tracers' race: Embree and sidelight build, and trace the same frames, in turn, on one core and on
// several in turn as well.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "tests/bench/cost.h"
#include "tests/bench/program.h"
#include "tests/bench/trace_scenes.h"

namespace sidelight::bench {

enum class Task { build, eye, eye_and_shadow, whole };
inline constexpr std::array<std::string_view, 4> kTaskNames{"build", "eye rays", "eye + shadow",
                                                            "whole frame"};

struct TracePlan {
  Size size;
  std::vector<int> threads;  // each its own row, pinned to as many cores
  int frames = 31, warm_up = 2;
  int builds = 9;
};

struct TraceRow {
  Task task = Task::build;
  int threads = 0;
  CostSpread single, packets, sidelight;  // packets: zero where Embree has none
  bool has_packets() const { return task == Task::eye || task == Task::eye_and_shadow; }
};

// Rays aimed along shared edges of a closed mesh, vertices included, from a place in it: those that leave it.
struct Leaks {
  std::uint64_t rays = 0, single = 0, packets = 0, sidelight = 0;
};

struct TraceVerdict {
  std::array<std::uint64_t, 3> embree_rays{}, sidelight_rays{};  // of a frame: eye, eye + shadow, whole
  std::uint64_t different = 0;  // pixels of the whole frame that are more than 2/255 apart
  Leaks leaks;                  // all 0 where the scene has no such place
};

struct TraceRace {
  std::size_t triangles = 0, spheres = 0;
  std::vector<TraceRow> rows;  // by task, then threads
  TraceVerdict verdict;
};

// Runs in processes of its own; no other thread may be running. Throws std::runtime_error where one of them fails.
TraceRace race(const TraceEntry& entry, const Scene& scene, const TracePlan& plan);

}  // namespace sidelight::bench
