// SPDX-License-Identifier: MIT
#include "viewer/commands/bench_json.h"

#include "common/error.h"
#include "viewer/commands/result_json.h"

namespace sidelight {
namespace {

Json measure_json(const ErrorMeasure& error) {
  const Json metrics = metrics_json(error.metrics);
  return {{"max", metrics["max"]},      {"p999", error.p999},
          {"mean", error.metrics.mean}, {"rmse", error.metrics.rms},
          {"relmse", error.relmse},     {"psnr", metrics["psnr"]},
          {"depth", error.depth},       {"non_finite", error.metrics.non_finite}};
}

// Of the whole picture, and within it of covered pixels.
Json error_json(const PictureError& error) {
  Json json = measure_json(error.whole);
  json["covered"] = measure_json(error.covered);
  return json;
}

Json config_json(const BenchPoint& point) {
  Json json = Json::object();
  for (const KnobValue& each : point.config) json[each.knob] = each.value;
  return json;
}

Json scene_json(const BenchScene& scene, bool timed) {
  Json json{{"path", printable(scene.path, 1000)},
            {"title", printable(scene.title, 1000)},
            {"hash", scene.hash},
            {"width", scene.width},
            {"height", scene.height},
            {"triangles", scene.triangles},
            {"spheres", scene.spheres},
            {"planes", scene.planes}};
  if (timed) json["load_ms"] = spread_json(scene.load_ms);
  if (timed) json["load_cpu_ms"] = spread_json(scene.load_cpu_ms);
  return json;
}

Json reference_json(const BenchScene& scene, bool timed) {
  const ReferenceImage& image = scene.reference;
  if (image.n == 0) return nullptr;
  Json json{{"scene", printable(scene.path, 1000)},
            {"samples", image.n * image.n},
            {"depth", image.depth},
            {"cut", image.cut},
            {"cut_weight", image.cut_weight},
            {"unsent_bound", image.unsent_bound},
            {"rmse_steps", image.steps},
            {"bound", image.bound},
            {"converged", image.converged},
            {"finer", image.finer},
            {"too_dear", image.too_dear},
            {"remaining", image.remaining},
            {"against_brute_force", or_null(image.against_brute_force)}};
  if (timed) json["ms"] = image.ms;
  return json;
}

Json point_json(const BenchResult& result, const BenchPoint& point) {
  Json json{{"scene", printable(result.scenes[point.scene].path, 1000)},
            {"config", config_json(point)},
            {"varied", point.varied},
            {"left_out", point.left_out.empty() ? Json(nullptr) : Json(point.left_out)},
            {"finished", point.finished}};
  if (!point.finished) return json;
  json["valid"] = point.failures.empty();
  json["failures"] = point.failures;
  json["on_front"] = result.timed ? Json(point.on_front) : Json(nullptr);
  json["mismatches"] = point.mismatches;
  if (result.timed) {
    json["time_ms"] = {{"build", spread_json(point.build_ms)}, {"frame", spread_json(point.frame_ms)}};
    json["cpu_ms"] = {{"build", spread_json(point.build_cpu_ms)}, {"frame", spread_json(point.cpu_ms)}};
    json["runs"] = point.runs;
    json["memory_mb"] = {{"build", point.build_memory_mb}, {"frame", point.frame_memory_mb}};
  }
  json["rays"] = point.rays;
  json["fragments"] = point.fragments;
  json["tests"] = point.tests;
  json["tests_per_ray"] = point.tests_per_ray;
  json["nodes_per_ray"] = point.nodes_per_ray;
  json["error"] = error_json(point.error);
  for (std::size_t kind = 0; kind < kErrorKinds; ++kind)
    json[std::string(kErrorKindNames[kind])] =
        point.by_kind[kind] ? error_json(*point.by_kind[kind]) : Json(nullptr);
  return json;
}

// Points by their number in `points`.
Json summary_json(const SceneSummary& summary) {
  return {{"standard", or_null(summary.standard)},
          {"fastest_exact", or_null(summary.fastest_exact)},
          {"most_accurate", or_null(summary.most_accurate)},
          {"equal_error_speedup", or_null(summary.equal_error_speedup)},
          {"equal_time_error", or_null(summary.equal_time_error)}};
}

Json ratio_json(const std::optional<RatioOverScenes>& ratio) {
  if (!ratio) return nullptr;
  return {{"geometric_mean", ratio->geometric_mean},
          {"worst", ratio->worst},
          {"worst_scene", ratio->worst_scene}};
}

Json over_scenes_json(const BenchResult& result) {
  Json json{{"equal_error_speedup", ratio_json(result.equal_error_speedup)},
            {"equal_time_error", ratio_json(result.equal_time_error)},
            {"configs", Json::array()}};
  for (const ConfigOverScenes& each : result.over_scenes)
    json["configs"].push_back({{"config", config_json(result.points[each.config])},
                               {"time", ratio_json(each.time)},
                               {"error", ratio_json(each.error)}});
  return json;
}

}  // namespace

std::string bench_json(const BenchResult& result) {
  Json json{{"command", printable(result.command, 4000)},
            {"version", result.version},
            {"machine", result.machine},
            {"interrupted", result.interrupted},
            {"scenes", Json::array()},
            {"reference", Json::array()},
            {"points", Json::array()}};
  for (const BenchScene& scene : result.scenes) {
    json["scenes"].push_back(scene_json(scene, result.timed));
    json["reference"].push_back(reference_json(scene, result.timed));
  }
  for (const BenchPoint& point : result.points) json["points"].push_back(point_json(result, point));
  json["summary"] = {{"scenes", Json::array()}};
  for (const SceneSummary& summary : result.summaries)
    json["summary"]["scenes"].push_back(summary_json(summary));
  json["summary"]["over_scenes"] = over_scenes_json(result);
  return json.dump(2) + "\n";
}

}  // namespace sidelight
