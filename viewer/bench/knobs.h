// SPDX-License-Identifier: MIT
// The knobs that a bench turns: one table, one line a knob. A configuration is a value for every knob, as text; a
// Setting is what that asks of a renderer.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/math/isa.h"
#include "common/model/faults.h"
#include "common/scene/camera.h"
#include "viewer/bench/result.h"

namespace sidelight {

struct Setting {
  bool raster = false;       // the z-buffer, else the ray tracer
  bool from_raster = false;  // which takes what samples show from the z-buffer (stage.h)
  int n = 1;                 // n x n samples a pixel
  std::optional<int> depth;  // else as the scene says, and so for the cut
  std::optional<double> cut;
  Faults faults;    // the planes of a depth format are not set
  int threads = 0;  // 0: all
  Isa isa = best_isa();
};

struct Knob {
  std::string_view name;
  std::optional<ErrorKind> moves;  // the kind of error; none: it moves time only
  bool raster, raytrace;           // the renderers that have it
  std::string_view standard;       // its value in the standard setting
  std::string_view by_default;     // the other values of the default sweep, separated by commas
  std::string_view sweep;          // and those of its own
  std::string_view wanted;         // in words, for messages and help
  bool (*set)(Setting& setting, const std::string& value);  // false: not a value
};
std::span<const Knob> knobs();

// Every knob, in the table's order; kNotThere where the renderer lacks it.
using Config = std::vector<KnobValue>;
inline constexpr std::string_view kNotThere = "-";

Setting setting_of(const Config& config);
// The knobs, but the renderer, whose values are not the standard ones: "samples" or "depth, cut"; empty where none is.
std::string varied_knobs(const Config& config);

// The names that --sweep knows: "default", then every knob's.
std::vector<std::string> sweep_names();
// The configurations of a sweep: the standard one of the ray tracer first, then that of the z-buffer, then one value
// away from either. Values that this machine lacks are left out. Throws UsageError for an unknown name.
std::vector<Config> sweep_configs(const std::string& name);
// The product of "knob=value,value" texts, without doubles, after the standard configuration of the ray tracer. Both
// renderers, unless a text chooses. Throws UsageError: an unknown knob (with the nearest name), a value it does not
// have, a knob named twice or had by no renderer chosen, or more than kMostConfigs configurations.
std::vector<Config> product_configs(const std::vector<std::string>& texts);
inline constexpr std::size_t kMostConfigs = 500;

}  // namespace sidelight
