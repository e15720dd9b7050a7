// SPDX-License-Identifier: MIT
#include "viewer/report/bench_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viewer/bench/front.h"

namespace sidelight {
namespace {

// The knobs that make a point differ from its renderer's standard setting; BenchPoint::varied is their list.
std::vector<KnobValue> varied_values(const BenchPoint& point) {
  std::vector<KnobValue> out;
  const std::string list = ", " + point.varied + ", ";
  for (const KnobValue& each : point.config)
    if (list.find(", " + each.knob + ", ") != std::string::npos) out.push_back(each);
  return out;
}

std::string setting_words(const BenchResult& result, std::size_t index) {
  const BenchPoint& point = result.points[index];
  const double error = point.error.whole.metrics.rms;
  std::string out = fmt::format("{}: RMSE {}", config_name(point), error_words(error));
  if (result.timed) out += fmt::format(", {} ms", spread_words(point.frame_ms));
  if (!point.failures.empty()) out += fmt::format("; fails: {}", failure_words(point));
  return out;
}

bool same_time(const Spread& a, const Spread& b) { return !surely_faster(a, b) && !surely_faster(b, a); }

// "2.1 (worst 1.4: cube.toml)".
std::string ratio_words(const BenchResult& result, const RatioOverScenes& ratio) {
  const std::string worst =
      ratio.worst_scene < result.scenes.size() ? scene_name(result.scenes[ratio.worst_scene]) : "";
  return fmt::format("{:.3g} (worst {:.3g}: {})", ratio.geometric_mean, ratio.worst, worst);
}

}  // namespace

std::string knob_value(const BenchPoint& point, std::string_view knob) {
  for (const KnobValue& each : point.config)
    if (each.knob == knob) return each.value;
  return {};
}

std::string config_name(const BenchPoint& point) {
  std::string out = knob_value(point, "renderer");
  for (const auto& [knob, value] : varied_values(point)) out += fmt::format(" {}={}", knob, value);
  return out;
}

std::string mark_name(const BenchPoint& point) {
  std::string out;
  for (const auto& [knob, value] : varied_values(point))
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", knob, value);
  return out.empty() ? "default" : out;
}

std::string failure_words(const BenchPoint& point) {
  return fmt::format("{}", fmt::join(point.failures, "; "));
}

std::string scene_name(const BenchScene& scene) { return scene.title.empty() ? scene.path : scene.title; }

std::vector<std::size_t> finished_points(const BenchResult& result, std::size_t scene) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < result.points.size(); ++i)
    if (result.points[i].scene == scene && result.points[i].finished) out.push_back(i);
  if (result.timed)
    std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) {
      return result.points[a].frame_ms.median < result.points[b].frame_ms.median;
    });
  return out;
}

std::vector<std::size_t> unfinished_points(const BenchResult& result, std::size_t scene) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < result.points.size(); ++i)
    if (result.points[i].scene == scene && !result.points[i].finished) out.push_back(i);
  return out;
}

std::vector<std::size_t> scenes_worst_first(const BenchResult& result) {
  std::vector<std::size_t> out;
  for (std::size_t scene = 0; scene < result.scenes.size(); ++scene) out.push_back(scene);
  const std::optional<RatioOverScenes>& ratio =
      result.equal_error_speedup ? result.equal_error_speedup : result.equal_time_error;
  if (ratio && ratio->worst_scene < out.size()) {
    const auto worst = out.begin() + static_cast<std::ptrdiff_t>(ratio->worst_scene);
    std::rotate(out.begin(), worst, worst + 1);
  }
  return out;
}

std::string time_words(double ms) {
  if (ms >= 99.95) return fmt::format("{:.0f}", ms);
  if (ms >= 9.995) return fmt::format("{:.1f}", ms);
  return ms >= 0.995 ? fmt::format("{:.2f}", ms) : fmt::format("{:.3g}", ms);
}

std::string error_words(double error) { return error == 0 ? "0" : fmt::format("{:.2e}", error); }

std::string spread_words(const Spread& ms) {
  return fmt::format("{} ({}-{})", time_words(ms.median), time_words(ms.min), time_words(ms.max));
}

std::string same_time_as(const BenchResult& result, const std::vector<std::size_t>& order, std::size_t at) {
  std::string out;
  const Spread& time = result.points[order[at]].frame_ms;
  const auto same = [&](std::size_t k) {
    return k < order.size() && k != at && same_time(time, result.points[order[k]].frame_ms);
  };
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (!same(k)) continue;
    const std::size_t first = k;
    while (same(k + 1)) ++k;
    if (!out.empty()) out += ", ";
    out += first == k ? fmt::format("{}", first + 1) : fmt::format("{}-{}", first + 1, k + 1);
  }
  return out;
}

std::vector<Fact> summary_facts(const BenchResult& result, std::size_t scene) {
  if (scene >= result.summaries.size()) return {};
  const SceneSummary& summary = result.summaries[scene];
  std::vector<Fact> out;
  const auto add = [&](const char* name, const std::optional<std::size_t>& index) {
    if (index && *index < result.points.size()) out.push_back({name, setting_words(result, *index)});
  };
  add("default setting", summary.standard);
  add("fastest exact", summary.fastest_exact);
  add("most accurate", summary.most_accurate);
  const auto add_ratio = [&](const char* name, const std::optional<double>& ratio, const char* words) {
    if (!ratio) return;
    out.push_back({name, *ratio == 1 ? "1: the default setting stands on the front"
                                     : fmt::format(fmt::runtime(words), *ratio)});
  };
  add_ratio("equal-error speed-up", summary.equal_error_speedup,
            "{0:.3g}: at the default's error the front takes 1/{0:.3g} of its time");
  add_ratio("equal-time error ratio", summary.equal_time_error,
            "{0:.3g}: in the default's time the front has {0:.3g} of its error");
  return out;
}

std::vector<Fact> facts_over_scenes(const BenchResult& result) {
  std::vector<Fact> out;
  if (result.scenes.size() < 2) return out;
  if (result.equal_error_speedup)
    out.push_back({"equal-error speed-up", ratio_words(result, *result.equal_error_speedup)});
  if (result.equal_time_error)
    out.push_back({"equal-time error ratio", ratio_words(result, *result.equal_time_error)});
  return out;
}

std::string reference_words(const ReferenceImage& reference) {
  if (reference.n == 0) return "The sweep was interrupted before the reference image was finished.";
  std::string out = fmt::format("{0}x{0} samples a pixel, all light in double", reference.n);
  if (reference.depth > 0) out += fmt::format(", {} rays along a path", reference.depth);
  if (reference.cut > 0) out += fmt::format(", none below a weight of {:g}", reference.cut);
  out += ". ";
  if (!reference.steps.empty()) {
    out += "RMSE from one number of samples to the next:";
    int n = 1;
    for (const double step : reference.steps) {
      out += fmt::format("{} {} (n = {} to {})", n == 1 ? "" : ",", error_words(step), n, 2 * n);
      n *= 2;
    }
    out += ". ";
  }
  out += reference.converged
             ? fmt::format("The last is below the bound of {}. ", error_words(reference.bound))
             : fmt::format("The bound of {} was not reached{}. ", error_words(reference.bound),
                           reference.too_dear ? ", and more samples would have taken too long" : "");
  out += std::isfinite(reference.remaining)
             ? fmt::format("Its own remaining error is estimated as {}. ", error_words(reference.remaining))
             : "Its own remaining error cannot be estimated, since the steps do not fall. ";
  if (!reference.finer)
    out +=
        "Pictures with more than half as many samples along a pixel's side were measured against too few: "
        "their "
        "errors are too small here. ";
  if (reference.cut_weight > 0)
    out +=
        fmt::format("Rays not sent even so have a mean weight of {}, {}. ", error_words(reference.cut_weight),
                    std::isfinite(reference.unsent_bound)
                        ? fmt::format("so that channels are too dark by {} in the mean at most",
                                      error_words(reference.unsent_bound))
                        : "which bounds nothing, since light here has no bound");
  out += reference.against_brute_force
             ? fmt::format(
                   "Its picture with one sample a pixel is {} (RMSE) away from that of raytrace-reference, "
                   "which tries every object on every ray.",
                   error_words(*reference.against_brute_force))
             : "It was not compared with raytrace-reference, which would take too long on this scene.";
  if (reference.ms > 0) out += fmt::format(" It took {:.3g} s to make.", reference.ms / 1e3);
  return out;
}

}  // namespace sidelight
