// SPDX-License-Identifier: MIT
// A logarithmic axis: what it spans, where its ticks stand and what is written at them.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace sidelight {

struct LogAxis {
  double low = 1e-9, high = 1;  // 0 < low < high
  std::vector<double> ticks;    // ascending, within
  bool powers = false;          // they are powers of ten only
};

// An axis for these values with some room beyond the outermost, `room_above` as a part of what they span; those that are
// not positive or not finite are passed over. It spans at least a factor of 4; without any value 1e-9 to 1. Ticks: 1, 2
// and 5 of every decade if it spans no more than two and a half, else powers of ten, at most 8 of them.
LogAxis log_axis(std::span<const double> values, double room_above = 0.06);

// "20", "0.5"; "10⁻²", "1" where they are powers of ten from below 0.001; "2·10⁻⁵" where the plain number would be long.
std::string tick_words(const LogAxis& axis, double tick);

// Where a value stands between 0 (low) and 1 (high).
double log_place(const LogAxis& axis, double value);

}  // namespace sidelight
