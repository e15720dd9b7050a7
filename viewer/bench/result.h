// SPDX-License-Identifier: MIT
// What a bench finds out: for each scene, points of cost against error. Filled by sweep.cpp, judged by front.cpp, shown
// by the tables, plots and the report. Plain data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/picture/error_measure.h"
#include "common/picture/image_io.h"

namespace sidelight {

// Of repeated runs; all of one value where there was one run.
struct Spread {
  double min = 0, median = 0, max = 0;
};

// What an error comes from: rounding with the same samples and model; a model that leaves something out; too few
// samples a pixel.
enum class ErrorKind { arithmetic, model, sampling };
inline constexpr int kErrorKinds = 3;
inline constexpr std::array<std::string_view, kErrorKinds> kErrorKindNames{"arithmetic", "model", "sampling"};

struct KnobValue {
  std::string knob, value;  // "renderer", "raster"
};

struct BenchPoint {
  std::size_t scene = 0;          // index into BenchResult::scenes
  std::vector<KnobValue> config;  // every knob, in the table's order
  std::string varied;     // the knobs by which it differs from its renderer's default; empty for that itself
  std::string left_out;   // why it is not part of the sweep, in words; empty: it is
  bool finished = false;  // false: left out, or the sweep was interrupted first; the rest is then not filled
  std::uint64_t mismatches = 0;       // samples whose surface is not the exact one
  std::vector<std::string> failures;  // gates it fails, in words; empty: it may stand on the front
  bool on_front = false;

  // Of one frame, scene to finished float picture: frame_ms and cpu_ms. Nothing of it where BenchResult::timed is false.
  Spread build_ms, build_cpu_ms, frame_ms, cpu_ms;
  std::size_t runs = 0;                              // fewer than asked for where the sweep was interrupted
  std::uint64_t rays = 0, fragments = 0, tests = 0;  // of one frame, all kinds of rays together
  double tests_per_ray = 0, nodes_per_ray = 0;
  // What the process came to hold more than before, at most: while preparing the scene, and during a frame.
  double build_memory_mb = 0, frame_memory_mb = 0;

  PictureError error;  // against the reference image
  // By kind, indexed by ErrorKind: empty where it cannot be told, as the sampling error of the reference's own samples.
  std::array<std::optional<PictureError>, kErrorKinds> by_kind;

  Image8 picture, difference;  // at the scene's size; the difference multiplied so that it can be seen
  double difference_gain = 1;  // by this factor
};

// The picture that errors are measured against.
struct ReferenceImage {
  int n = 0;                // n x n samples a pixel; 0: the sweep was interrupted before it was finished
  int depth = 0;            // rays along a path, the eye ray included
  double cut = 0;           // the least weight of a ray that is sent: above 0 where rays multiply without end
  double cut_weight = 0;    // mean weight of the rays that were not sent even so
  double unsent_bound = 0;  // the most that these can take from the mean of a channel; may be infinite
  std::vector<double> steps;  // RMSE between n = 1 and 2, 2 and 4, ...
  double bound = 0;           // it stopped when a step had fallen below this ...
  bool converged = false;
  bool finer = false;     // ... and n was at least twice that of every configuration; or n was greatest ...
  bool too_dear = false;  // ... or because the next n would have exceeded the steps that it may take
  double remaining = 0;   // estimate of its own RMSE, from the last two steps
  // RMSE between its picture of one sample a pixel and raytrace-reference's, where that is affordable.
  std::optional<double> against_brute_force;
  double ms = 0;  // what it took, 0 if it came from the cache
  Image8 picture;
};

struct BenchScene {
  std::string path, title, hash;
  int width = 0, height = 0;
  std::uint64_t triangles = 0, spheres = 0, planes = 0;
  Spread load_ms, load_cpu_ms;
  ReferenceImage reference;
};

// A scene's points of note, and what the front gains over the standard setting.
struct SceneSummary {
  std::optional<std::size_t> standard, fastest_exact, most_accurate;  // indices into BenchResult::points
  std::optional<double> equal_error_speedup;  // front against the standard setting: time at its error
  std::optional<double> equal_time_error;     // and error at its time, as ratio
};

// Ratios of one kind over several scenes: never an average of errors, whose sizes mean different things.
struct RatioOverScenes {
  double geometric_mean = 1;
  double worst = 1;
  std::size_t worst_scene = 0;  // index into BenchResult::scenes
};
// One configuration against the standard setting, over the scenes in which both are finished: its time and its error
// divided by the standard's (below 1 is better). Empty where a ratio has no meaning, as 0 / 0.
struct ConfigOverScenes {
  std::size_t config = 0;  // points[scene * configs + config] is it
  std::optional<RatioOverScenes> time, error;
};

struct BenchResult {
  std::string command, version, machine;  // the machine in words: processor, cores, instruction set
  std::vector<BenchScene> scenes;
  std::size_t configs = 0;                    // the same ones for every scene
  std::vector<BenchPoint> points;             // scene by scene, in the order of the sweep: scenes * configs
  std::vector<SceneSummary> summaries;        // one a scene
  std::vector<ConfigOverScenes> over_scenes;  // one a configuration
  std::optional<RatioOverScenes> equal_error_speedup, equal_time_error;  // the summaries' over the scenes
  bool timed = true;  // false: no times were taken (--no-times), so there is no front either
  bool interrupted = false;
};

}  // namespace sidelight
