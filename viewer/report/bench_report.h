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

// SVG files by name, such as "showcase-total.svg" and "showcase-sampling.svg", a scene's named by its file; names are
// ASCII letters, digits, "-" and "_" before the ".svg", no two the same. None without times.
std::vector<std::pair<std::string, std::string>> bench_plots(const BenchResult& result);

}  // namespace sidelight
