// SPDX-License-Identifier: MIT
#include "viewer/report/log_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace sidelight {
namespace {

constexpr double kRoomBelow = 0.06;      // of the span
constexpr double kLeastDecades = 0.602;  // log10 of 4
constexpr double kMostFineDecades = 2.5;
constexpr int kMostTicks = 8;

// 10^exponent as the literal would be: std::pow may be one ulp off.
double power_of_ten(int exponent) { return std::stod(fmt::format("1e{}", exponent)); }

std::string superscript(int number) {
  constexpr std::array<std::string_view, 10> kDigits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  for (const char c : std::to_string(number))
    out += c == '-' ? "⁻" : kDigits[static_cast<std::size_t>(c - '0')];
  return out;
}

void add_ticks(LogAxis& axis) {
  const int first = static_cast<int>(std::floor(std::log10(axis.low)));
  const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
  axis.powers = std::log10(axis.high / axis.low) > kMostFineDecades;
  const int step = axis.powers ? (last - first + kMostTicks - 1) / kMostTicks : 1;
  for (int exponent = first; exponent <= last; ++exponent) {
    if (exponent % step != 0) continue;
    for (const int digit : {1, 2, 5}) {
      const double tick = digit * power_of_ten(exponent);
      if (tick >= axis.low && tick <= axis.high && (digit == 1 || !axis.powers)) axis.ticks.push_back(tick);
    }
  }
}

}  // namespace

LogAxis log_axis(std::span<const double> values, double room_above) {
  std::vector<double> logs;
  for (const double value : values)
    if (std::isfinite(value) && value > 0) logs.push_back(std::log10(value));
  LogAxis axis;
  if (!logs.empty()) {
    const auto [least, greatest] = std::minmax_element(logs.begin(), logs.end());
    const double missing = std::max(0.0, kLeastDecades - (*greatest - *least)) / 2;
    const double span = *greatest - *least + 2 * missing;
    // Neither end may leave the range of double.
    axis.low = std::pow(10, std::max(*least - missing - kRoomBelow * span, -307.0));
    axis.high = std::pow(10, std::min(*greatest + missing + room_above * span, 308.0));
  }
  add_ticks(axis);
  return axis;
}

std::string tick_words(const LogAxis& axis, double tick) {
  const bool plain = tick == 1 || (tick >= 1e-3 && tick < 1e5 && !(axis.powers && axis.low < 1e-3));
  if (plain) return fmt::format("{:g}", tick);
  const int exponent = static_cast<int>(std::floor(std::log10(tick * (1 + 1e-9))));
  const int digit = static_cast<int>(std::lround(tick / power_of_ten(exponent)));
  return (digit == 1 ? "" : fmt::format("{}·", digit)) + "10" + superscript(exponent);
}

double log_place(const LogAxis& axis, double value) {
  return std::log(value / axis.low) / std::log(axis.high / axis.low);
}

}  // namespace sidelight
