// SPDX-License-Identifier: MIT
// The report of a bench: speed against error of every configuration on every scene, as one page and as plots to cite.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewer/bench/result.h"

namespace sidelight {

// The page, under 10 MB: pictures are embedded reduced by a whole factor where they must be, which the page says. Equal
// arguments give equal bytes.
std::string bench_report(const BenchResult& result);

struct BenchPlot {
  std::string name;  // of its file, such as "showcase-total.svg" or "showcase-sampling.svg"
  std::string svg;  // empty where there is nothing to draw: no times, nothing finished, no error of this kind

  bool operator==(const BenchPlot&) const = default;
};
// Four a scene, named by its file: ASCII letters, digits, "-" and "_" before the ".svg", the first no "-"; no two the
// same.
std::vector<BenchPlot> bench_plots(const BenchResult& result);

}  // namespace sidelight
