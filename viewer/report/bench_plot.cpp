// SPDX-License-Identifier: MIT
#include "viewer/report/bench_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "viewer/report/bench_words.h"

namespace sidelight {
namespace {

constexpr std::array kAllKinds{ErrorKind::arithmetic, ErrorKind::model, ErrorKind::sampling};

// The renderers in the order in which a bench first names them: the same series on every plot of it.
std::vector<std::string> renderers(const BenchResult& result) {
  std::vector<std::string> out;
  for (const BenchPoint& point : result.points) {
    const std::string name = knob_value(point, "renderer");
    if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
  }
  if (out.size() > kMostSeries) out.resize(kMostSeries);
  return out;
}

std::string words(const BenchPoint& point) {
  std::string out = fmt::format("{}: {} ms, RMSE {}", config_name(point), spread_words(point.frame_ms),
                                error_words(point.error.whole.metrics.rms));
  if (point.mismatches > 0) out += fmt::format(", {} visibility mismatches", point.mismatches);
  if (!point.failures.empty()) return out + "; fails: " + failure_words(point);
  return out + (point.on_front ? "; on the front" : "; dominated");
}

Mark mark_of(const BenchPoint& point, double error, const std::vector<std::string>& series) {
  Mark mark;
  mark.x_low = point.frame_ms.min;
  mark.x = point.frame_ms.median;
  mark.x_high = point.frame_ms.max;
  mark.y = error;
  const auto at = std::find(series.begin(), series.end(), knob_value(point, "renderer"));
  mark.series = std::min(static_cast<std::size_t>(at - series.begin()), kMostSeries - 1);
  mark.name = mark_name(point);
  mark.words = words(point);
  if (!point.failures.empty()) {
    mark.state = MarkState::failed;
    mark.reason = point.failures.front();
  }
  return mark;
}

// The points that differ in the same one knob, if there are several, with their renderer's standard setting; by time.
std::vector<std::vector<std::size_t>> threads(const BenchResult& result,
                                              const std::vector<std::size_t>& points) {
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> by_knob;  // marks
  for (std::size_t k = 0; k < points.size(); ++k) {
    const BenchPoint& point = result.points[points[k]];
    by_knob[{knob_value(point, "renderer"), point.varied}].push_back(k);
  }
  std::vector<std::vector<std::size_t>> out;
  for (const auto& [key, of_knob] : by_knob) {
    const auto& [renderer, knob] = key;
    if (knob.empty() || knob.find(',') != std::string::npos || of_knob.size() < 2) continue;
    std::vector<std::size_t> thread = of_knob;
    if (const auto standard = by_knob.find({renderer, ""}); standard != by_knob.end())
      thread.push_back(standard->second.front());
    std::stable_sort(thread.begin(), thread.end(), [&](std::size_t a, std::size_t b) {
      return result.points[points[a]].frame_ms.median < result.points[points[b]].frame_ms.median;
    });
    out.push_back(thread);
  }
  return out;
}

Scatter scatter_of(const BenchResult& result, const std::string& title, const std::string& y_label) {
  Scatter plot;
  plot.title = title;
  plot.x_label = "time a frame in ms: median, least to greatest";
  plot.y_label = y_label;
  plot.series = renderers(result);
  return plot;
}

double kind_error(const BenchPoint& point, std::size_t kind) {
  return point.by_kind[kind]->whole.metrics.rms;
}

std::vector<std::size_t> points_of_kind(const BenchResult& result, std::size_t scene, std::size_t kind) {
  constexpr double kMoved = 1.25;
  std::vector<std::size_t> with_kind;
  std::map<std::string, double> standard;  // by renderer
  for (const std::size_t i : finished_points(result, scene)) {
    const BenchPoint& point = result.points[i];
    if (!point.by_kind[kind]) continue;
    with_kind.push_back(i);
    if (point.varied.empty()) standard.emplace(knob_value(point, "renderer"), kind_error(point, kind));
  }
  std::erase_if(with_kind, [&](std::size_t i) {
    const BenchPoint& point = result.points[i];
    const auto at = standard.find(knob_value(point, "renderer"));
    if (point.varied.empty() || at == standard.end()) return false;
    const double error = kind_error(point, kind);
    return error <= kMoved * at->second && at->second <= kMoved * error;
  });
  return with_kind;
}

// The name of a scene's file without folder and ending, in harmless letters.
std::string stem(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  name = name.substr(0, name.find_last_of('.'));
  for (char& c : name) {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (!kept) c = '-';
  }
  name.erase(0, name.find_first_not_of('-'));  // which a command would take for a flag
  constexpr std::size_t kLongest = 60;
  return name.empty() ? "scene" : name.substr(0, kLongest);
}

}  // namespace

Scatter total_scatter(const BenchResult& result, std::size_t scene) {
  Scatter plot =
      scatter_of(result,
                 fmt::format("Time a frame against error of {}, both logarithmic, one mark a configuration",
                             scene_name(result.scenes[scene])),
                 "RMSE against the reference image");
  plot.staircase = true;
  const std::vector<std::size_t> points = finished_points(result, scene);
  for (const std::size_t i : points) {
    const BenchPoint& point = result.points[i];
    Mark mark = mark_of(point, point.error.whole.metrics.rms, plot.series);
    if (mark.state == MarkState::good && !point.on_front) mark.state = MarkState::beaten;
    mark.attributes = html(" data-point=\"{}\"", i);
    plot.marks.push_back(mark);
  }
  plot.threads = threads(result, points);
  return plot;
}

std::optional<Scatter> kind_scatter(const BenchResult& result, std::size_t scene, ErrorKind kind) {
  const std::size_t index = static_cast<std::size_t>(kind);
  const std::string name(kErrorKindNames[index]);
  const std::vector<std::size_t> points = points_of_kind(result, scene, index);
  if (points.empty()) return {};
  Scatter plot = scatter_of(
      result, fmt::format("Time a frame against {} error of {}", name, scene_name(result.scenes[scene])),
      fmt::format("{} error (RMSE)", name));
  for (const std::size_t i : points)
    plot.marks.push_back(mark_of(result.points[i], kind_error(result.points[i], index), plot.series));
  plot.threads = threads(result, points);
  return plot;
}

std::vector<std::pair<ErrorKind, Scatter>> small_kind_scatters(const BenchResult& result, std::size_t scene) {
  std::vector<std::pair<ErrorKind, Scatter>> out;
  for (const ErrorKind kind : kAllKinds)
    if (const std::optional<Scatter> plot = kind_scatter(result, scene, kind)) out.emplace_back(kind, *plot);
  std::vector<double> xs, ys;
  for (const auto& [kind, plot] : out)
    for (const Mark& mark : plot.marks) {
      xs.insert(xs.end(), {mark.x_low, mark.x_high});
      ys.push_back(mark.y);
    }
  for (auto& [kind, plot] : out) {
    plot.width = 400;
    plot.height = 340;
    plot.legend = false;
    plot.x_label = "time a frame in ms";
    plot.y_label = "RMSE";
    for (Mark& mark : plot.marks) mark.reason.clear();
    plot.x_values = xs;
    plot.y_values = ys;
  }
  return out;
}

std::vector<BenchPlot> bench_plots(const BenchResult& result) {
  std::vector<BenchPlot> out;
  std::set<std::string> used;
  for (std::size_t scene = 0; scene < result.scenes.size(); ++scene) {
    const bool drawn = result.timed && !finished_points(result, scene).empty();
    const std::string first = stem(result.scenes[scene].path);
    std::string name = first;
    for (int again = 2; !used.insert(name).second; ++again) name = fmt::format("{}-{}", first, again);
    out.push_back({name + "-total.svg", drawn ? svg_file(total_scatter(result, scene)) : ""});
    for (const ErrorKind kind : kAllKinds) {
      const std::optional<Scatter> plot = drawn ? kind_scatter(result, scene, kind) : std::nullopt;
      out.push_back({fmt::format("{}-{}.svg", name, kErrorKindNames[static_cast<std::size_t>(kind)]),
                     plot ? svg_file(*plot) : ""});
    }
  }
  return out;
}

}  // namespace sidelight
