// SPDX-License-Identifier: MIT
#include "viewer/bench/front.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sidelight {
namespace {

// y at x on the lines through (x, y) in double logarithm; the points in any order.
struct XY {
  double x, y;
};
std::optional<double> on_log_lines(std::vector<XY> points, double x) {
  std::sort(points.begin(), points.end(),
            [](const XY& a, const XY& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].x == x) return points[i].y;  // of several there the least
    if (i == 0 || points[i].x < x || points[i - 1].x > x) continue;
    const XY &a = points[i - 1], &b = points[i];
    if (!(a.x > 0 && a.y > 0 && b.y > 0)) return {};
    const double part = std::log(x / a.x) / std::log(b.x / a.x);
    return a.y * std::pow(b.y / a.y, part);
  }
  return {};
}

TimeAndError time_and_error(const BenchPoint& point) {
  return {point.frame_ms, point.error.whole.metrics.rms, point.finished && point.failures.empty()};
}

std::optional<double> ratio(double a, double b) {
  if (!(a > 0 && b > 0)) return {};
  return a / b;
}

// The index, from `first`, of the least of the valid points; empty if there is none.
template <class Less>
std::optional<std::size_t> least(std::span<const TimeAndError> points, std::size_t first, const Less& less) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].valid && (!best || less(points[i], points[*best - first]))) best = first + i;
  return best;
}

SceneSummary summarise(std::span<const TimeAndError> points, std::size_t first,
                       std::span<const TimeAndError> front, bool standard_finished) {
  SceneSummary summary;
  summary.fastest_exact = least(points, first, [](const TimeAndError& a, const TimeAndError& b) {
    return a.time.median < b.time.median;
  });
  summary.most_accurate = least(points, first, [](const TimeAndError& a, const TimeAndError& b) {
    return a.error < b.error || (a.error == b.error && a.time.median < b.time.median);
  });
  if (!standard_finished) return summary;
  summary.standard = first;
  const TimeAndError& standard = points.front();
  if (const auto time = time_at_error(front, standard.error))
    summary.equal_error_speedup = ratio(standard.time.median, *time);
  if (const auto error = error_at_time(front, standard.time.median))
    summary.equal_time_error = ratio(*error, standard.error);
  return summary;
}

void judge_scene(BenchResult& result, std::size_t scene) {
  const std::size_t first = scene * result.configs;
  std::vector<TimeAndError> points, front;
  for (std::size_t c = 0; c < result.configs; ++c) points.push_back(time_and_error(result.points[first + c]));
  const std::vector<bool> on = pareto_front(points);
  for (std::size_t c = 0; c < result.configs; ++c) {
    result.points[first + c].on_front = on[c] && result.timed;
    if (on[c]) front.push_back(points[c]);
  }
  SceneSummary summary = summarise(points, first, front, result.points[first].finished);
  if (!result.timed) {
    summary.fastest_exact = {};
    summary.equal_error_speedup = summary.equal_time_error = {};
  }
  result.summaries.push_back(summary);
}

// Over the scenes, of one configuration: quantity(point) divided by the standard setting's.
template <class Quantity>
std::optional<RatioOverScenes> config_ratio(const BenchResult& result, std::size_t config,
                                            const Quantity& quantity) {
  std::vector<std::optional<double>> ratios;
  for (std::size_t scene = 0; scene < result.scenes.size(); ++scene) {
    const BenchPoint &point = result.points[scene * result.configs + config],
                     &standard = result.points[scene * result.configs];
    const bool both = point.finished && standard.finished;
    ratios.push_back(both ? ratio(quantity(point), quantity(standard)) : std::nullopt);
  }
  return ratio_over_scenes(ratios, false);
}

}  // namespace

std::vector<bool> pareto_front(std::span<const TimeAndError> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return !points[i].valid || std::isnan(points[i].error); });
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].error < points[b].error ||
           (points[a].error == points[b].error && points[a].time.median < points[b].time.median);
  });

  std::vector<bool> on(points.size());
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const bool stands = std::all_of(front.begin(), front.end(), [&](std::size_t before) {
      return points[before].error == points[i].error ? !surely_faster(points[before].time, points[i].time)
                                                     : surely_faster(points[i].time, points[before].time);
    });
    if (!stands) continue;
    on[i] = true;
    front.push_back(i);
  }
  return on;
}

std::optional<double> time_at_error(std::span<const TimeAndError> front, double error) {
  std::vector<XY> points;
  for (const TimeAndError& each : front) points.push_back({each.error, each.time.median});
  return on_log_lines(points, error);
}

std::optional<double> error_at_time(std::span<const TimeAndError> front, double time) {
  std::vector<XY> points;
  for (const TimeAndError& each : front) points.push_back({each.time.median, each.error});
  return on_log_lines(points, time);
}

std::optional<RatioOverScenes> ratio_over_scenes(std::span<const std::optional<double>> ratios,
                                                 bool small_is_bad) {
  std::optional<RatioOverScenes> out;
  double logarithms = 0;
  std::size_t count = 0;
  for (std::size_t scene = 0; scene < ratios.size(); ++scene) {
    if (!ratios[scene]) continue;
    const double value = *ratios[scene];
    logarithms += std::log(value);
    ++count;
    if (!out) out = RatioOverScenes{1, value, scene};
    if (small_is_bad ? value < out->worst : value > out->worst) out = RatioOverScenes{1, value, scene};
  }
  if (out) out->geometric_mean = std::exp(logarithms / static_cast<double>(count));
  return out;
}

void judge(BenchResult& result) {
  result.summaries.clear();
  result.over_scenes.clear();
  for (std::size_t scene = 0; scene < result.scenes.size(); ++scene) judge_scene(result, scene);
  for (std::size_t config = 0; config < result.configs; ++config)
    result.over_scenes.push_back(
        {config, config_ratio(result, config, [](const BenchPoint& p) { return p.frame_ms.median; }),
         config_ratio(result, config, [](const BenchPoint& p) { return p.error.whole.metrics.rms; })});

  std::vector<std::optional<double>> speedups, errors;
  for (const SceneSummary& summary : result.summaries) {
    speedups.push_back(summary.equal_error_speedup);
    errors.push_back(summary.equal_time_error);
  }
  result.equal_error_speedup = ratio_over_scenes(speedups, true);
  result.equal_time_error = ratio_over_scenes(errors, false);
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values.front(), (values[(n - 1) / 2] + values[n / 2]) / 2, values.back()};
}

}  // namespace sidelight
