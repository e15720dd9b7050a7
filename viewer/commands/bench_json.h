// SPDX-License-Identifier: MIT
// bench.json: what other programs read of a bench.
#pragma once

#include <string>

#include "viewer/bench/result.h"

namespace sidelight {

// {scenes, machine, reference, points: [{scene, config, valid, on_front, mismatches, time_ms: {build, frame}, error,
// arithmetic, model, sampling, ...}], summary}; one entry of `reference` and `summary.scenes` a scene. Points and
// scenes are named by their numbers from 0 in the summary. Without times (--no-times)
// nothing depends on them: no time_ms and no memory, and on_front is null. Numbers that are infinite are null.
std::string bench_json(const BenchResult& result);

}  // namespace sidelight
