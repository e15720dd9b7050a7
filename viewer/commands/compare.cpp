// SPDX-License-Identifier: MIT
// sidelight compare: both pictures of a scene, the picture of their difference, and the account of it.
#include "common/picture/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>

#include "common/picture/layer_picture.h"
#include "common/picture/signed_difference.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/faulty.h"
#include "viewer/commands/renderers.h"
#include "viewer/commands/result_json.h"
#include "viewer/report/compare_report.h"
#include "viewer/window/offscreen.h"

namespace sidelight {
namespace {

struct CompareFlags {
  JobFlags job;
  std::string folder;
  bool all_modes = false;
};

Json cause_json(const Cause& cause) { return {{"pixels", cause.pixels}, {"energy", cause.energy}}; }

std::string comparison_json(const Job& job, const Comparison& result, const Spoiled& spoiled,
                            const TimedFrame& rastered, const TimedFrame& traced) {
  Json json{{"width", result.width}, {"height", result.height}};
  add_crop(json, traced.frame.window, job.scene.width, job.scene.height);
  json.update({{"primary", job.flags.primary},
               {"covered", result.covered},
               {"visibility_mismatches", result.visibility_mismatches},
               {"unexplained", result.unexplained},
               {"ledger_max_residual", result.ledger_max_residual},
               {"causes",
                {{"shadow", cause_json(result.shadow)},
                 {"reflection", cause_json(result.reflection)},
                 {"refraction", cause_json(result.refraction)}}},
               {"metrics", metrics_json(result.metrics)}});
  const auto times_json = [](const TimedFrame& t) {
    return Json{{"build", t.build_ms}, {"frame", t.frame_ms}};
  };
  if (!job.flags.no_times)
    json["time_ms"] = {{"raster", times_json(rastered)}, {"raytrace", times_json(traced)}};
  json["faults"] = Json::object();
  for (const FaultCount& each : spoiled.by_fault)
    json["faults"][std::string(fault_name(each.fault))] = each.pixels;
  return json.dump(2) + "\n";
}

Image8 picture(const Frame& frame) { return to_image8(frame.color, frame.width(), frame.height()); }

Times times(const TimedFrame& timed) { return {timed.build_ms, timed.frame_ms}; }

Labels labels(const Job& job, const TimedFrame& rastered, const TimedFrame& traced) {
  Labels out;
  out.title = job.scene.title.empty() ? job.flags.scene : job.scene.title;
  out.right.name = traced_name(job.scene.trace);
  if (!job.flags.no_times) {
    out.left.times = times(rastered);
    out.right.times = times(traced);
  }
  return out;
}

void write_pictures(const Job& job, const std::string& folder, const TimedFrame& rastered,
                    const TimedFrame& traced) {
  const int width = rastered.frame.width(), height = rastered.frame.height();
  const Metadata raster_metadata = job_metadata(job, "raster"),
                 trace_metadata = job_metadata(job, "raytrace");
  const Metadata both = job_metadata(job, "raster, raytrace");
  write_png(folder + "/raster.png", picture(rastered.frame), raster_metadata);
  write_png(folder + "/raytrace.png", picture(traced.frame), trace_metadata);
  write_png(folder + "/difference.png",
            to_image8(absolute_difference(rastered.frame, traced.frame), width, height), both);
  write_png(folder + "/causes.png", to_image8(cause_map(rastered.frame, traced.frame), width, height), both);
  write_exr(folder + "/raster.exr", rastered.frame, raster_metadata);
  write_exr(folder + "/raytrace.exr", traced.frame, trace_metadata);
}

// Whether it was; pictures that are too large to be drawn beside each other are left out. One of an earlier run goes.
bool write_side_by_side(const Job& job, const std::string& folder, const TimedFrame& rastered,
                        const TimedFrame& traced) {
  const std::string file = folder + "/side_by_side.png";
  std::error_code none_there;
  std::filesystem::remove(file, none_there);
  const Labels words = labels(job, rastered, traced);
  const glm::ivec2 size = side_by_side_size({traced.frame.width(), traced.frame.height()}, words);
  if (std::max(size.x, size.y) > kLongestOffscreen) {
    if (!job.flags.quiet)
      fmt::print(stderr, "no side_by_side.png, which would be {}x{}: sides are up to {}\n", size.x, size.y,
                 kLongestOffscreen);
    return false;
  }
  const Image8 both = side_by_side(picture(rastered.frame), picture(traced.frame), words);
  write_png(file, both, job_metadata(job, "raster, raytrace"));
  return true;
}

constexpr std::array<const char*, 4> kLedgerPictures{"ledger_1_raster", "ledger_2_minus_shadow",
                                                     "ledger_3_plus_reflection", "ledger_4_plus_refraction"};

// What write_all_modes wrote for an earlier run, and the folder if it held nothing else.
void remove_all_modes(const std::string& folder) {
  std::vector<std::string> names(kLedgerPictures.begin(), kLedgerPictures.end());
  names.emplace_back("signed_difference");
  for (const std::string_view layer : kLayerNames)
    for (const char* renderer : {"raster", "raytrace"})
      names.push_back(fmt::format("{}_{}", renderer, layer));
  std::error_code none_there;
  bool removed = false;
  for (const std::string& name : names)
    removed |= std::filesystem::remove(fmt::format("{}/{}.png", folder, name), none_there);
  if (removed && !std::filesystem::is_symlink(folder, none_there))
    std::filesystem::remove(folder, none_there);
}

void write_layers(const Job& job, const std::string& folder, const Renderer& renderer, const Frame& frame) {
  const Metadata metadata = job_metadata(job, std::string(renderer.name));
  for (int i = 0; i < kLayers; ++i) {
    const auto layer = static_cast<Layer>(i);
    if (!(renderer.layers & layer_bit(layer))) continue;
    const std::string_view name = kLayerNames[static_cast<std::size_t>(i)];
    write_png(fmt::format("{}/{}_{}.png", folder, renderer.name, name), layer_picture(frame, layer),
              metadata);
  }
}

// Everything that the comparison knows, as pictures for slides: into `folder`, which is made, as 8-bit PNG
//   raster_LAYER.png, raytrace_LAYER.png   each layer that the frame's renderer makes (layer_picture.h)
//   ledger_1_raster.png, ...               the left picture becoming the right one (ledger_sums in compare.h)
//   signed_difference.png                  where the right picture is brighter or darker (signed_difference.h)
void write_all_modes(const Job& job, const std::string& folder, const Renderer& raster, const Frame& rastered,
                     const Renderer& raytrace, const Frame& traced) {
  make_folder(folder);
  write_layers(job, folder, raster, rastered);
  write_layers(job, folder, raytrace, traced);

  const Metadata both = job_metadata(job, "raster, raytrace");
  const auto write = [&](const std::string& name, std::span<const glm::vec3> linear) {
    write_png(folder + "/" + name, to_image8(linear, traced.width(), traced.height()), both);
  };
  const auto sums = ledger_sums(rastered, traced);
  for (std::size_t k = 0; k < sums.size(); ++k) write(fmt::format("{}.png", kLedgerPictures[k]), sums[k]);
  write("signed_difference.png", signed_difference(rastered, traced));
}

std::string report(const Job& job, const Comparison& result, const Spoiled& spoiled,
                   const TimedFrame& rastered, const TimedFrame& traced) {
  const Metrics::Max& max = result.metrics.max;
  CompareReport out{job.scene,
                    rastered.frame,
                    traced.frame,
                    result,
                    job_metadata(job, "raster, raytrace"),
                    fmt::format("{} --pixel {},{}", command_line(job, "explain"), max.x, max.y),
                    command_line(job, "view") + fault_arguments(job.options.faults),
                    {},
                    {},
                    {}};
  for (const FaultCount& each : spoiled.by_fault)
    out.faults.emplace_back(fault_name(each.fault), each.pixels);
  out.from_raster = job.flags.from_raster();
  if (!job.flags.no_times) {
    out.raster_times = times(rastered);
    out.traced_times = times(traced);
  }
  return compare_report(out);
}

// What a person wants to read first; on stderr, as stdout is for data.
void print_summary(const Job& job, const Comparison& result, const Spoiled& spoiled) {
  fmt::print(stderr, "{}x{}: {} visibility mismatches, {} unexplained pixels\n", result.width, result.height,
             result.visibility_mismatches, result.unexplained);
  const auto line = [](const char* name, const Cause& cause) {
    fmt::print(stderr, "  {:<10} {:>8} pixels, energy {:.4g}\n", name, cause.pixels, cause.energy);
  };
  line("shadow", result.shadow);
  line("reflection", result.reflection);
  line("refraction", result.refraction);
  for (const FaultCount& each : spoiled.by_fault)
    fmt::print(
        stderr,
        "  the fault {} spoils {} pixels, which are in neither count; {} of them show another surface\n",
        fault_name(each.fault), each.pixels, each.other_surface);
  if (job.flags.from_raster())
    fmt::print(stderr, "  the ray tracer took the z-buffer's surfaces: that they agree says nothing\n");
  if (result.visibility_mismatches > 0)
    fmt::print(stderr, "  first mismatch at pixel {},{}\n", result.mismatch_x, result.mismatch_y);
  if (result.unexplained > 0)
    fmt::print(stderr, "  first unexplained pixel at {},{}\n", result.unexplained_x, result.unexplained_y);
}

int run_compare(const CompareFlags& flags) {
  Job job = load_job(flags.job);
  const Renderer& raster = *find_renderer("raster");
  const Renderer& raytrace = with_primary(job, *find_renderer("raytrace"));
  job.options.layers = raytrace.layers;
  job.options.keep_samples = true;
  check_memory(job, job.options.faults.any() ? kSpoiledPairs : job.flags.from_raster() ? 2 : 1);
  const OutputFolder folder(flags.folder);

  const TimedFrame rastered = render_all_layers(job, raster);
  const TimedFrame traced = render_all_layers(job, raytrace);
  const Spoiled spoiled = find_spoiled(job, rastered.frame, traced.frame);
  const Comparison result = compare(rastered.frame, traced.frame, job.scene.lights.size(), spoiled.mask);
  write_pictures(job, flags.folder, rastered, traced);
  write_text_file(flags.folder + "/compare.json", comparison_json(job, result, spoiled, rastered, traced));
  write_text_file(flags.folder + "/report.html", report(job, result, spoiled, rastered, traced));
  remove_all_modes(flags.folder + "/modes");
  if (flags.all_modes)
    write_all_modes(job, flags.folder + "/modes", raster, rastered.frame, raytrace, traced.frame);
  if (!flags.job.quiet) print_summary(job, result, spoiled);
  const bool both =
      write_side_by_side(job, flags.folder, rastered, traced);  // last: all else needs no OpenGL
  if (!flags.job.quiet)
    fmt::print(stderr, "wrote {}/report.html, {}causes.png, compare.json and more\n", printable(flags.folder),
               both ? "side_by_side.png, " : "");
  return result.agrees() ? 0 : 1;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<CompareFlags>();
  CLI::App* verb =
      app.add_subcommand("compare", "both pictures of a scene, their difference, and the reason for it");
  add_job_flags(*verb, flags->job);
  add_primary_flag(*verb, flags->job);
  add_fault_flags(*verb, flags->job.faults);
  verb->add_option("-o,--output", flags->folder, "folder DIR for the report, the pictures and compare.json")
      ->required();
  verb->add_flag("--no-times", flags->job.no_times, "leave times out, so that equal runs give equal files");
  verb->add_flag("--all-modes", flags->all_modes,
                 "also each layer and each step of the ledger, as pictures in DIR/modes");
  verb->footer(
      "DIR/report.html, opened by a double click, shows and explains it all.\n"
      "Exit code 1 if any sample or pixel is not accounted for, or a fault on purpose spoils one.\n"
      "Examples:\n"
      "  sidelight compare scenes/showcase.toml -o out/showcase\n"
      "  sidelight compare scenes/06-shadows.toml -o out/shadows -r 320x240 --spp 9 --all-modes");
  verb->callback([flags, &exit_code] { exit_code = run_compare(*flags); });
}

}  // namespace sidelight
