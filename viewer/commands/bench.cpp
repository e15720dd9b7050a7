// SPDX-License-Identifier: MIT
// sidelight bench: speed against error, over the knobs of both renderers.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "viewer/bench/front.h"
#include "viewer/bench/sweep.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/decimal.h"
#include "viewer/commands/interrupt.h"
#include "viewer/commands/job.h"
#include "viewer/commands/progress.h"
#include "viewer/commands/result_json.h"
#include "viewer/report/bench_plot.h"
#include "viewer/report/bench_report.h"
#include "viewer/report/shell_word.h"

namespace sidelight {
namespace {

struct BenchFlags {
  JobFlags job;  // size, quiet, no_times
  std::vector<std::string> scenes, set;
  std::string folder, sweep;
  int runs = 7;
};

std::vector<Config> configs_of(const BenchFlags& flags) {
  if (flags.set.empty()) return sweep_configs(flags.sweep.empty() ? "default" : flags.sweep);
  if (!flags.sweep.empty()) throw UsageError("--sweep and --set exclude each other");
  return product_configs(flags.set);
}

// What was asked for, but where it is written to.
std::string command_of(const BenchFlags& flags) {
  std::string line = "sidelight bench";
  for (const std::string& scene : flags.scenes) line += ' ' + shell_file(scene);
  if (!flags.job.size.empty()) line += " -r " + flags.job.size;
  if (!flags.sweep.empty()) line += " --sweep " + flags.sweep;
  for (const std::string& set : flags.set) line += " --set " + shell_word(set);
  if (flags.runs != BenchFlags().runs) line += fmt::format(" --runs {}", flags.runs);
  if (flags.job.no_times) line += " --no-times";
  return line;
}

BenchResult sweep(const BenchFlags& flags, const std::vector<Config>& configs) {
  RenderOptions options;
  options.keep_samples = true;
  int finest = 1;
  for (const Config& config : configs) finest = std::max(finest, setting_of(config).n);

  ProgressBar progress("bench", flags.job.quiet);
  SweepPlan plan;
  plan.scenes = flags.scenes;
  plan.configs = configs;
  plan.runs = flags.runs;
  plan.timed = !flags.job.no_times;
  plan.limited = flags.set.empty() && (flags.sweep.empty() || flags.sweep == "default");
  plan.cache = PictureCache(program_hash().empty() ? "" : usual_cache_folder());
  plan.cancel = &interrupt_flag();
  plan.progress = progress.callback();
  if (!flags.job.size.empty()) plan.size = parse_size(flags.job.size, "-r");
  plan.loaded = [&](const Scene& scene) {
    check_memory(scene, finest, options);
    if (flags.job.quiet) return;
    for (const std::string& warning : scene.warnings) fmt::print(stderr, "{}\n", printable(warning, 2000));
  };
  return run_sweep(plan);
}

// ---- bench.json ----

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

// {scenes, machine, reference, points: [{scene, config, valid, on_front, mismatches, time_ms: {build, frame}, error,
// arithmetic, model, sampling, ...}], summary}; one entry of `reference` and `summary.scenes` a scene. Points and
// scenes are named by their numbers from 0 in the summary. Without times (--no-times) nothing depends on them: no time_ms
// and no memory, and on_front is null. Numbers that are infinite are null.
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

// ---- The verb ----

// The one place where outputs are written. Gives the number of plots.
int write_outputs(const BenchResult& result, const std::string& folder) {
  write_text_file(folder + "/bench.json", bench_json(result));
  write_text_file(folder + "/bench.csv", bench_csv(result));
  write_text_file(folder + "/report.html", bench_report(result));
  int plots = 0;
  for (const BenchPlot& plot : bench_plots(result)) {
    const std::string file = folder + "/" + plot.name;
    if (!plot.svg.empty()) {
      write_text_file(file, plot.svg);
      ++plots;
      continue;
    }
    std::error_code ignored;
    std::filesystem::remove(file, ignored);  // an earlier run's, which would look like this one's
  }
  return plots;
}

int run_bench(const BenchFlags& flags) {
  const std::vector<Config> configs = configs_of(flags);
  const OutputFolder folder(flags.folder);
  BenchResult result = sweep(flags, configs);
  result.command = command_of(flags);
  judge(result);
  const int plots = write_outputs(result, flags.folder);
  fmt::print("{}", bench_table(result));
  if (!flags.job.quiet)
    fmt::print(stderr, "wrote {}/report.html, bench.json, bench.csv and {} plots{}\n",
               printable(flags.folder), plots, result.timed ? "" : ", which want times");
  if (result.interrupted) throw Interrupted();
  return 0;
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<BenchFlags>();
  CLI::App* verb =
      app.add_subcommand("bench", "speed against error: what each setting costs, and what it buys");
  verb->add_option("SCENE", flags->scenes, "scene files (TOML)")->required()->type_name("");
  verb->add_option("-o,--output", flags->folder,
                   "folder DIR for report.html, bench.json, bench.csv and plots")
      ->required();
  verb->add_option("-r,--resolution", flags->job.size, "picture size WxH, instead of each scene's");
  verb->add_option("--sweep", flags->sweep, "which settings: default, or one knob of those below")
      ->type_name("NAME");
  verb->add_option("--set", flags->set, "knob=value,value: instead, all products of these; may be repeated")
      ->type_name("K=V,V")
      ->allow_extra_args(false);
  verb->add_option("--runs", flags->runs, "timed runs of each setting, after a warm-up; 7 or more")
      ->type_name("N")
      ->transform(decimal)
      ->check(CLI::Range(7, 100000).description(""))
      ->capture_default_str();
  add_quiet_flag(*verb, flags->job);
  verb->add_flag("--no-times", flags->job.no_times, "take no times, so that equal runs give equal files");
  std::string knob_lines;
  for (const Knob& knob : knobs())
    knob_lines +=
        fmt::format("  {:<13} {} error: {}\n", knob.name,
                    knob.moves ? kErrorKindNames[static_cast<std::size_t>(*knob.moves)] : "no", knob.wanted);
  verb->footer(fmt::format(
      "Knobs, the kind of error each moves, and its values:\n{}"
      "The default sweep leaves out, by name, the slowest settings of a scene that would take it beyond\n"
      "two minutes at 640x480 on two cores; --sweep and --set leave out none.\n"
      "Ctrl-C ends it with what is finished.\n"
      "Reference images are kept in $XDG_CACHE_HOME/sidelight, else in ~/.cache/sidelight.\n"
      "Examples:\n"
      "  sidelight bench scenes/06-shadows.toml -o out/bench -r 64x48\n"
      "  sidelight bench scenes/02-diffuse.toml -o out/bench -r 64x48 --set samples=1,4 --set "
      "isa=scalar,best",
      knob_lines));
  verb->callback([flags, &exit_code] { exit_code = run_bench(*flags); });
}

}  // namespace sidelight
