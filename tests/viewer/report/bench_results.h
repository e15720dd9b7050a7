// SPDX-License-Identifier: MIT
// Bench results made by hand: what a sweep might have found, small enough to say what must be shown of it.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "viewer/bench/result.h"

namespace sidelight::test {

// A disc on a slope of grey; `shift` moves it, so that different points have different pictures.
inline Image8 small_picture(int width, int height, int shift) {
  Image8 image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int dx = x - width / 2 - shift, dy = y - height / 2;
      const bool inside = 9 * (dx * dx + dy * dy) < height * height;
      const int slope = 40 + 160 * y / height;
      for (const int value :
           {inside ? 200 : slope, inside ? 80 + 2 * shift : slope, inside ? 40 : slope + 20})
        image.rgb.push_back(static_cast<std::uint8_t>(std::clamp(value, 0, 255)));
    }
  return image;
}

// A finished point of one run of 7, its range of times 10 % to either side.
inline BenchPoint bench_point(const std::string& renderer, const std::string& knob, const std::string& value,
                              double ms, double rmse) {
  BenchPoint point;
  point.config = {{"renderer", renderer}, {"samples", "1"}, {"depth", "scene"}, {"precision", "exact"}};
  for (KnobValue& each : point.config)
    if (each.knob == knob) each.value = value;
  point.varied = knob;
  point.finished = true;
  point.frame_ms = point.cpu_ms = point.build_ms = {0.9 * ms, ms, 1.1 * ms};
  point.runs = 7;
  point.rays = 307200;
  point.error.whole.metrics.rms = point.error.covered.metrics.rms = rmse;
  point.error.whole.metrics.max = {10 * rmse, 3, 4, 1};
  return point;
}

inline void set_kinds(BenchPoint& point, double arithmetic, double model, double sampling) {
  const std::array<double, kErrorKinds> all{arithmetic, model, sampling};
  for (std::size_t kind = 0; kind < kErrorKinds; ++kind)
    point.by_kind[kind].emplace().whole.metrics.rms = all[kind];
}

// A scene with a point of every sort: on the front, dominated, failing a gate, without any error; and a summary.
inline void add_scene(BenchResult& result, const std::string& path, const std::string& title, int width,
                      int height) {
  const std::size_t scene = result.scenes.size(), first = result.points.size();
  BenchScene info;
  info.path = path;
  info.title = title;
  info.width = width;
  info.height = height;
  info.spheres = 3;
  info.planes = 1;
  info.triangles = 1234;
  info.reference.n = 8;
  info.reference.depth = 30;
  info.reference.steps = {4e-2, 2.1e-2, 1.5e-3};
  info.reference.bound = 1.0 / 512;
  info.reference.converged = true;
  info.reference.remaining = 2e-4;
  info.reference.against_brute_force = 3e-9;
  info.reference.picture = small_picture(width, height, 0);
  result.scenes.push_back(info);

  std::vector<BenchPoint> points{bench_point("raytrace", "", "", 40, 2e-2),
                                 bench_point("raster", "", "", 6, 9e-2),
                                 bench_point("raytrace", "samples", "4", 150, 8e-3),
                                 bench_point("raytrace", "samples", "16", 610, 0),
                                 bench_point("raytrace", "depth", "1", 21, 6e-2),
                                 bench_point("raytrace", "depth", "2", 30, 4e-2),
                                 bench_point("raytrace", "precision", "float", 42, 2.1e-2),
                                 bench_point("raster", "precision", "float", 5, 9e-2)};
  set_kinds(points[0], 4e-8, 1e-4, 2e-2);
  set_kinds(points[1], 3e-8, 8e-2, 2e-2);
  set_kinds(points[2], 4e-8, 1e-4, 8e-3);
  set_kinds(points[4], 4e-8, 5e-2, 2e-2);
  set_kinds(points[5], 4e-8, 3e-2, 2e-2);
  set_kinds(points[6], 5e-4, 1e-4, 2e-2);
  set_kinds(points[7], 0, 8e-2, 2e-2);
  for (const std::size_t k : {0, 1, 2, 3, 4, 5}) points[k].on_front = true;
  points[7].failures = {"12 samples show another surface"};
  points[7].mismatches = 12;
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k].scene = scene;
    points[k].picture = small_picture(width, height, static_cast<int>(5 * k));
    points[k].difference = small_picture(width, height, static_cast<int>(40 - 5 * k));
    points[k].difference_gain = 16;
  }
  points[7].picture = points[1].picture;  // float sees the same here
  result.points.insert(result.points.end(), points.begin(), points.end());
  result.configs = points.size();

  SceneSummary summary;
  summary.standard = first;
  summary.fastest_exact = first + 1;
  summary.most_accurate = first + 3;
  summary.equal_error_speedup = 1.5 + static_cast<double>(scene);
  summary.equal_time_error = 0.5;
  result.summaries.push_back(summary);
}

inline BenchResult bench_result(int scenes = 1, int width = 64, int height = 48) {
  BenchResult result;
  result.command = "sidelight bench scenes/a.toml -o out";
  result.version = "0.1.0";
  result.machine = "a processor, 2 cores, avx2";
  for (int scene = 0; scene < scenes; ++scene) {
    const std::string name(1, static_cast<char>('a' + scene));
    add_scene(result, "scenes/" + name + ".toml", "Scene " + name, width, height);
  }
  return result;
}

}  // namespace sidelight::test
