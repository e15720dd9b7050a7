// SPDX-License-Identifier: MIT
// What a bench found out, in words: the same ones in the terminal, on the plots and in the report. Text as it was given,
// made safe by whoever shows it.
#pragma once

#include <string>
#include <vector>

#include "viewer/bench/result.h"

namespace sidelight {

// "raster", "raytrace depth=2": the renderer and what was varied.
std::string config_name(const BenchPoint& point);
// The same beside its mark on a plot, whose shape tells the renderer: "depth 2", "default".
std::string mark_name(const BenchPoint& point);
// Its value of a knob, empty if it has no such knob.
std::string knob_value(const BenchPoint& point, std::string_view knob);
// Gates and hard cases that it fails, separated by "; ".
std::string failure_words(const BenchPoint& point);

std::string scene_name(const BenchScene& scene);  // its title, else its path
// Indices of its points: the finished ones, fastest first where times were taken; the others.
std::vector<std::size_t> finished_points(const BenchResult& result, std::size_t scene);
std::vector<std::size_t> unfinished_points(const BenchResult& result, std::size_t scene);
// The scenes, that with the worst ratio of the front to the standard setting first, the others as given.
std::vector<std::size_t> scenes_worst_first(const BenchResult& result);

// Numbers with three digits: "12.3", "1230"; "0", "1.23e-05".
std::string time_words(double ms);
std::string error_words(double error);
// "12.3 (11.9-13.1)": the median, the least and the greatest.
std::string spread_words(const Spread& ms);

// Of points in the order of finished_points: the numbers, from 1, of those whose range of times overlaps that of
// order[at], so that the two do not differ: "2-4, 7". Empty if none does.
std::string same_time_as(const BenchResult& result, const std::vector<std::size_t>& order, std::size_t at);

struct Fact {
  std::string name, value;
};
// The summary of a scene: its settings of note, and what the front gains over the standard setting.
std::vector<Fact> summary_facts(const BenchResult& result, std::size_t scene);
// The gains over all scenes: geometric means of ratios, and the worst. Empty for one scene.
std::vector<Fact> facts_over_scenes(const BenchResult& result);
// How the reference image came to be and how far it can be trusted, in sentences.
std::string reference_words(const ReferenceImage& reference);

}  // namespace sidelight
