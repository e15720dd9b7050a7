// SPDX-License-Identifier: MIT
// Judging a bench: which points nothing beats, and by how much the rest is beaten. Functions of numbers only.
//
// Two times differ only where their ranges of all runs do not overlap. The front is drawn up from the least error: of
// equal errors, the points that no other is surely faster than; then, error by error, a point that is surely faster than
// all those before it. Points that fail a gate never stand on it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "viewer/bench/result.h"

namespace sidelight {

struct TimeAndError {
  Spread time;
  double error = 0;
  bool valid = true;  // finished, and no gate failed
};

// Whether the slowest run of a was faster than the fastest of b.
inline bool surely_faster(const Spread& a, const Spread& b) { return a.max < b.min; }

// One a point: whether it is on the front.
std::vector<bool> pareto_front(std::span<const TimeAndError> points);

// Along the front (points as above, those that stand on it), straight lines between neighbours in log error and log
// median time: the time at an error, the error at a time. Empty outside of what the front spans: never extrapolated; and
// empty between two points of which one has error 0, which has no logarithm.
std::optional<double> time_at_error(std::span<const TimeAndError> front, double error);
std::optional<double> error_at_time(std::span<const TimeAndError> front, double time);

// Of what has a ratio in at least one scene; the worst is the greatest, or the least where small is bad. A ratio is
// positive.
std::optional<RatioOverScenes> ratio_over_scenes(std::span<const std::optional<double>> ratios,
                                                 bool small_is_bad);

// Fills on_front, summaries, over_scenes and the ratios over scenes. A point's time is frame_ms, its error the RMSE of
// the whole picture. The standard setting is the first configuration.
void judge(BenchResult& result);

// Of runs in any order; zeros without any.
Spread spread_of(std::vector<double> values);

}  // namespace sidelight
