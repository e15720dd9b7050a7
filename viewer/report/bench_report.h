// SPDX-License-Identifier: MIT
// The results of a bench, speed against error of every configuration on every scene: as one page, as a table to read in a
// terminal, and all of its numbers for other programs.
#pragma once

#include <string>

#include "viewer/bench/result.h"

namespace sidelight {

// The page, under 10 MB: pictures are embedded reduced by a whole factor where they must be, which the page says. Equal
// arguments give equal bytes.
std::string bench_report(const BenchResult& result);

// Per scene: a line a configuration, fastest first, which of them do not differ in time, the reference image and the
// summary. Plain text of lines that end in "\n", safe to print whatever the scene's texts hold.
std::string bench_table(const BenchResult& result);

// RFC 4180: a heading, then a record a point in the order of the sweep, lines ended by CR LF. A column a knob. What is
// not known is empty: all but the configuration of an unfinished point, times and memory of a bench without times.
// Numbers have as many digits as bring back the same double.
std::string bench_csv(const BenchResult& result);

}  // namespace sidelight
