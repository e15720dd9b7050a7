// SPDX-License-Identifier: MIT
// sidelight bench: speed against error, over the knobs of both renderers.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "viewer/bench/front.h"
#include "viewer/bench/sweep.h"
#include "viewer/commands/bench_json.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/interrupt.h"
#include "viewer/commands/job.h"
#include "viewer/commands/progress.h"
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
  make_folder(flags.folder);
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
      "Ctrl-C ends it with what is finished. Reference images are kept in ~/.cache/sidelight.\n"
      "Examples:\n"
      "  sidelight bench scenes/06-shadows.toml -o out/bench -r 64x48\n"
      "  sidelight bench scenes/02-diffuse.toml -o out/bench -r 64x48 --set samples=1,4 --set "
      "isa=scalar,best",
      knob_lines));
  verb->callback([flags, &exit_code] { exit_code = run_bench(*flags); });
}

}  // namespace sidelight
