// SPDX-License-Identifier: MIT
// The report of a bench: speed against error of every configuration on every scene, as one page.
#pragma once

#include <string>

#include "viewer/bench/result.h"

namespace sidelight {

// The page, under 10 MB: pictures are embedded reduced by a whole factor where they must be, which the page says. Equal
// arguments give equal bytes.
std::string bench_report(const BenchResult& result);

}  // namespace sidelight
