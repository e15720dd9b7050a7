// SPDX-License-Identifier: MIT
// What a bench plots of a scene: time against error, in total and by kind of error.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/bench/result.h"
#include "viewer/report/scatter_svg.h"

namespace sidelight {

// All finished configurations: the error is the RMSE of the whole picture. A mark's attributes name its point:
// data-point="7", the index into BenchResult::points.
Scatter total_scatter(const BenchResult& result, std::size_t scene);

// One kind of error: the standard settings of each renderer and the points that move this error, that is, by more than a
// quarter of what their renderer's standard setting has. Empty where no point is known to have this kind.
std::optional<Scatter> kind_scatter(const BenchResult& result, std::size_t scene, ErrorKind kind);

// All of a scene's kinds, in small, with the same axes.
std::vector<std::pair<ErrorKind, Scatter>> small_kind_scatters(const BenchResult& result, std::size_t scene);

// The same as files, to cite.
struct BenchPlot {
  std::string name;  // of its file, such as "showcase-total.svg" or "showcase-sampling.svg"
  std::string svg;  // empty where there is nothing to draw: no times, nothing finished, no error of this kind

  bool operator==(const BenchPlot&) const = default;
};
// Four a scene, named by its file: ASCII letters, digits, "-" and "_" before the ".svg", the first no "-"; no two the
// same.
std::vector<BenchPlot> bench_plots(const BenchResult& result);

}  // namespace sidelight
