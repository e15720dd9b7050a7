// SPDX-License-Identifier: MIT
// sidelight render: one picture, its layers, its statistics.
#include <fmt/format.h>

#include <algorithm>

#include "viewer/bench/front.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/decimal.h"
#include "viewer/commands/progress.h"
#include "viewer/commands/renderers.h"
#include "viewer/commands/result_json.h"

namespace sidelight {
namespace {

struct RenderFlags {
  JobFlags job;
  std::string output, renderer = "raytrace", layers, stats;
  bool linear16 = false;
  int repeat = 0;
};

LayerMask parse_layers(const RenderFlags& flags, const Renderer& renderer) {
  LayerMask mask = 0;
  for (std::size_t at = 0; at < flags.layers.size();) {
    const std::size_t comma = std::min(flags.layers.find(',', at), flags.layers.size());
    const std::string name = flags.layers.substr(at, comma - at);
    at = comma + 1;
    const auto known = std::find(kLayerNames.begin(), kLayerNames.end(), name);
    if (name == "all") {
      mask |= renderer.layers;
    } else if (known != kLayerNames.end()) {
      mask |= 1u << (known - kLayerNames.begin());
    } else {
      throw UsageError(fmt::format("--layers: '{}' is not a layer; there are {} and all", name,
                                   fmt::join(kLayerNames, ", ")));
    }
  }
  if (mask & ~renderer.layers)
    throw UsageError(fmt::format("--layers {}: the renderer '{}'{} does not make all of these", flags.layers,
                                 renderer.name, flags.job.from_raster() ? " with --primary raster" : ""));
  return mask;
}

Json stats_json(const Job& job, const Renderer& renderer, const TimedFrame& timed,
                const std::vector<double>& frame_ms, const std::vector<double>& cpu) {
  const RenderStats& stats = timed.frame.stats;
  Json frame = spread_json(spread_of(frame_ms));
  frame["runs"] = frame_ms.size();
  const VisibilityCounts& counts = stats.visibility;
  Json json{{"renderer", renderer.name},
            {"primary", renderer.name.starts_with("raster") ? "raster" : job.flags.primary},
            {"scene", printable(job.flags.scene, 1000)},
            {"scene_hash", job.scene.hash},
            {"version", SIDELIGHT_VERSION},
            {"width", job.scene.width},
            {"height", job.scene.height}};
  add_crop(json, timed.frame.window, job.scene.width, job.scene.height);
  json.update(
      {{"spp", job.flags.spp},
       {"threads", job.options.threads},
       {"isa", isa_name(job.options.isa)},
       {"triangles", job.scene.triangles.size()},
       {"spheres", job.scene.spheres.size()},
       {"planes", job.scene.planes.size()},
       {"load_ms", job.load_ms},
       {"build_ms", timed.build_ms},
       {"frame_ms", frame},
       {"cpu_ms", spread_json(spread_of(cpu))},
       {"rays",
        {{"primary", stats.rays.primary},
         {"shadow", stats.rays.shadow},
         {"reflection", stats.rays.reflection},
         {"refraction", stats.rays.refraction}}},
       {"tests", counts.tests},
       {"exact", {{"filtered", counts.filtered}, {"double", counts.in_double}, {"exact", counts.exact}}},
       {"self_shadowed", stats.self_shadowed},
       {"cut_weight", stats.cut_weight},
       {"peak_memory_mb", peak_memory_mb()}});
  for (const StageTime& stage : stats.stages) json["stages_ms"][std::string(stage.name)] = stage.ms;
  if (job.options.faults.any()) json["faults"] = job.options.faults.text();
  return json;
}

int run_render(const RenderFlags& flags) {
  const bool exr = flags.output.ends_with(".exr"), png = flags.output.ends_with(".png");
  if (!exr && !png) throw UsageError("-o wants a file that ends in .exr or .png; got '" + flags.output + "'");
  if (!exr && !flags.layers.empty())
    throw UsageError("--layers needs an .exr file: a .png holds the colour only");
  if (!png && flags.linear16)
    throw UsageError("--linear16 is for .png files; an .exr is linear float already");
  check_apart("-o", flags.output, "--stats", flags.stats);
  check_apart("SCENE", flags.job.scene, "--stats", flags.stats);
  Job job = load_job(flags.job);
  const Renderer* renderer = &with_primary(job, *find_renderer(flags.renderer));
  check_makes_faults(renderer->name, job.options.faults);
  job.options.layers = parse_layers(flags, *renderer);
  check_memory(job, job.flags.from_raster() ? 2 : 1);

  ProgressBar bar(std::string(renderer->label), flags.job.quiet);
  job.options.progress = bar.callback();
  std::vector<double> frame_ms, cpu;
  TimedFrame timed;
  if (flags.repeat > 0) {
    timed = render_repeatedly(job, *renderer, flags.repeat, frame_ms, cpu);
  } else {
    const double cpu_start = cpu_ms();
    timed = render_once(job, *renderer, job.options);
    frame_ms = {timed.frame_ms};
    cpu = {cpu_ms() - cpu_start};
  }
  check_finite(timed.frame, renderer->label);

  const Metadata metadata = job_metadata(job, std::string(renderer->name));
  if (exr)
    write_exr(flags.output, timed.frame, metadata);
  else if (flags.linear16)
    write_png_linear16(flags.output, timed.frame, metadata);
  else
    write_png(flags.output, to_image8(timed.frame.color, timed.frame.width(), timed.frame.height()),
              metadata);

  if (!flags.stats.empty()) write_json(flags.stats, stats_json(job, *renderer, timed, frame_ms, cpu));
  return 0;
}

}  // namespace

void add_render_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<RenderFlags>();
  CLI::App* verb = app.add_subcommand("render", "one picture of a scene, by one renderer");
  add_job_flags(*verb, flags->job);
  add_fault_flags(*verb, flags->job.faults);
  verb->add_option("-o,--output", flags->output, "FILE.png (sRGB, 8 bit) or FILE.exr (linear float)")
      ->required();
  std::vector<std::string> names;
  for (const Renderer& r : kRenderers) names.emplace_back(r.name);
  verb->add_option("--renderer", flags->renderer, fmt::format("{}", fmt::join(names, ", ")))
      ->type_name("NAME")
      ->check(CLI::IsMember(names).description(""))
      ->capture_default_str();
  add_primary_flag(*verb, flags->job);
  verb->add_option("--layers", flags->layers,
                   "channels beside the colour, comma-separated, of those named below");
  verb->add_flag("--linear16", flags->linear16, "write the .png linear with 16 bits");
  verb->add_option("--repeat", flags->repeat, "render N times after a warm-up, the eye moving, for times")
      ->type_name("N")
      ->transform(decimal)
      ->check(CLI::Range(1, 100000).description(""));
  verb->add_option("--stats", flags->stats, "write times and counts as JSON to FILE, - for standard output");
  verb->footer(fmt::format(
      "Layers: {} all\n"
      "Examples:\n"
      "  sidelight render scenes/showcase.toml -o showcase.png\n"
      "  sidelight render scenes/showcase.toml -o raster.exr --renderer raster --layers depth,object",
      fmt::join(kLayerNames, " ")));
  verb->callback([flags, &exit_code] { exit_code = run_render(*flags); });
}

}  // namespace sidelight
