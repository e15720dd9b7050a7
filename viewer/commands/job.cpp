// SPDX-License-Identifier: MIT
#include "viewer/commands/job.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "common/parallel.h"
#include "common/scene/tessellate.h"
#include "common/scene/toml.h"
#include "viewer/commands/decimal.h"
#include "viewer/commands/interrupt.h"
#include "viewer/report/shell_word.h"

namespace sidelight {
namespace {

// "640x480" with 'x', "0,0,10,10" with ',': whole numbers and nothing else; empty if the text is not that.
std::vector<int> numbers(const std::string& text, char separator) {
  std::vector<int> out;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    int value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || (next != end && *next != separator)) return {};
    out.push_back(value);
    if (next == end) return out;
    at = next + 1;
  }
}

void apply_size(const JobFlags& flags, Scene& scene) {
  if (flags.size.empty()) return;
  const glm::ivec2 size = parse_size(flags.size, "-r");
  scene.width = size.x;
  scene.height = size.y;
}

Rect parse_crop(const JobFlags& flags, const Scene& scene) {
  if (flags.crop.empty()) return {};
  const std::vector<int> c = numbers(flags.crop, ',');
  const bool inside = c.size() == 4 && 0 <= c[0] && c[0] < c[2] && c[2] <= scene.width && 0 <= c[1] &&
                      c[1] < c[3] && c[3] <= scene.height;
  if (!inside)
    throw UsageError(
        fmt::format("--crop wants x0,y0,x1,y1 with 0 <= x0 < x1 <= {} and 0 <= y0 < y1 <= {}; got '{}'",
                    scene.width, scene.height, flags.crop));
  return {c[0], c[1], c[2], c[3]};
}

Isa parse_isa_flag(const JobFlags& flags) {
  if (flags.isa.empty()) return best_isa();
  const std::optional<Isa> isa = parse_isa(flags.isa);
  if (!isa) throw UsageError("--isa wants scalar, avx2 or avx512; got '" + flags.isa + "'");
  if (!machine_has(*isa)) throw UsageError("--isa " + flags.isa + ": this machine does not have it");
  return *isa;
}

// "trace.depth=2"
Settings::value_type parse_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw UsageError("--set wants KEY=VALUE, as in --set trace.depth=2; got '" + text + "'");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void apply_trace(const JobFlags& flags, TraceSettings& trace) {
  if (flags.depth != 0) trace.depth = flags.depth;
  if (flags.no_shadows || flags.local) trace.shadows = false;
  if (flags.no_reflection || flags.local) trace.reflection = false;
  if (flags.no_refraction || flags.local) trace.refraction = false;
}

// Puts the faults on and says so: on stderr, and in the title, which every picture and page shows.
void apply_faults(const JobFlags& flags, Job& job) {
  const Faults faults = job.options.faults = parse_faults(flags.faults, job.scene.camera);
  if (!faults.any()) return;
  if (!flags.quiet) fmt::print(stderr, "faults on purpose: {}\n", faults.text());
  const std::string title = job.scene.title.empty() ? flags.scene : job.scene.title;
  job.scene.title = fmt::format("FAULTS ON PURPOSE ({}): {}", faults.text(), title);
  if (!faults.tessellate) return;
  job.untessellated = job.scene;
  job.scene = tessellated(job.scene, *faults.tessellate);
}

double needed_bytes(const Scene& scene, int n, const RenderOptions& options, int pairs) {
  return pairs * static_cast<double>(frame_bytes(scene.width, scene.height, n, options));
}
double machine_bytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

glm::ivec2 parse_size(const std::string& text, const char* flag, int longest) {
  const std::vector<int> size = numbers(text, 'x');
  if (size.size() != 2 || std::min(size[0], size[1]) < 1 || std::max(size[0], size[1]) > longest)
    throw UsageError(fmt::format("{0} wants WxH with sides from 1 to {1}, as in {0} 640x480; got '{2}'", flag,
                                 longest, text));
  return {size[0], size[1]};
}

glm::ivec2 parse_pixel(const std::string& text, int width, int height, const char* flag, const char* names) {
  const std::vector<int> at = numbers(text, ',');
  const bool inside = at.size() == 2 && at[0] >= 0 && at[1] >= 0 && at[0] < width && at[1] < height;
  if (!inside)
    throw UsageError(fmt::format("{} wants two numbers {} from 0,0 to {},{}; got '{}'", flag, names,
                                 width - 1, height - 1, text));
  return {at[0], at[1]};
}

void check_apart(const char* name, const std::string& file, const char* written_name,
                 const std::string& written) {
  namespace fs = std::filesystem;
  const auto place = [](const std::string& path) {  // whether the file is there or not
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  if (!file.empty() && !written.empty() && place(file) == place(written))
    throw UsageError(
        fmt::format("{} and {} want two files; got '{}' and '{}'", name, written_name, file, written));
}

void add_render_flags(CLI::App& verb, JobFlags& flags) {
  verb.add_option("--spp", flags.spp, "samples per pixel, a square number: 1, 4, 9, ...")->transform(decimal);
  verb.add_option("--depth", flags.depth, "rays along a path, the eye ray included; 1 to 1000")
      ->transform(decimal)
      ->type_name("N")
      ->check(CLI::Range(1, 1000).description(""));
  verb.add_flag("--no-shadows", flags.no_shadows, "every light reaches every surface");
  verb.add_flag("--no-reflection", flags.no_reflection, "no mirror rays");
  verb.add_flag("--no-refraction", flags.no_refraction, "no refracted rays");
  verb.add_flag("--local", flags.local, "all three: local light only, as the z-buffer");
  verb.add_option("-j", flags.threads, "threads, 0 = all cores")
      ->transform(decimal)
      ->check(CLI::Range(0, 1024));
  verb.add_option("--isa", flags.isa, "force scalar, avx2 or avx512 (the picture is the same)");
}

void add_primary_flag(CLI::App& verb, JobFlags& flags) {
  verb.add_option("--primary", flags.primary,
                  "rays, or raster: the z-buffer finds what the ray tracer's samples show")
      ->type_name("WHO")
      ->check(CLI::IsMember({"rays", "raster"}).description(""))
      ->capture_default_str();
}

void add_quiet_flag(CLI::App& verb, JobFlags& flags) {
  verb.add_flag("-q,--quiet", flags.quiet, "quiet: errors only");
}

void remove_flags(CLI::App& verb, std::initializer_list<const char*> names) {
  for (const char* name : names) verb.remove_option(verb.get_option(name));
}

void add_job_flags(CLI::App& verb, JobFlags& flags) {
  verb.add_option("SCENE", flags.scene, "scene file (TOML)")->required();
  verb.add_option("-r,--resolution", flags.size, "picture size WxH, instead of the scene's");
  verb.add_option("--crop", flags.crop, "only pixels x0,y0,x1,y1 (half-open, y down)");
  add_render_flags(verb, flags);
  add_quiet_flag(verb, flags);
}

Job load_job(const JobFlags& flags, const Settings& set) {
  Job job;
  job.flags = flags;
  job.options.isa = parse_isa_flag(flags);
  job.options.threads = thread_count(flags.threads);
  job.options.cancel = &interrupt_flag();
  const int n = samples_per_edge(flags.spp);
  if (n == 0 || n > 64)
    throw UsageError(
        fmt::format("--spp wants a square number from 1 to 4096 (1, 4, 9, 16, ...); got {}", flags.spp));

  const double start = wall_ms();
  Settings settings = set;
  for (const std::string& each : flags.set) settings.push_back(parse_setting(each));
  job.scene = load_scene_with(flags.scene, settings, &job.files);
  job.load_ms = wall_ms() - start;
  stop_if_interrupted();
  if (!flags.quiet)
    for (const std::string& warning : job.scene.warnings)
      fmt::print(stderr, "{}\n", printable(warning, 2000));

  apply_size(flags, job.scene);
  apply_trace(flags, job.scene.trace);
  apply_faults(flags, job);
  job.options.crop = parse_crop(flags, job.scene);
  job.camera = make_camera(job.scene.camera, job.scene.width, job.scene.height, n);
  return job;
}

void check_memory(const Job& job, int pairs) { check_memory(job.scene, job.camera.n, job.options, pairs); }

void check_memory(const Scene& scene, int n, const RenderOptions& options, int pairs) {
  if (!fits_memory(scene, n, options, pairs))
    throw InputError(
        {scene.file, 0, 0},
        fmt::format(
            "a picture of {}x{} with {} samples per pixel needs {:.1f} GB; this machine has {:.1f} GB",
            scene.width, scene.height, n * n, needed_bytes(scene, n, options, pairs) / 1e9,
            machine_bytes() / 1e9));
}

bool fits_memory(const Scene& scene, int n, const RenderOptions& options, int pairs) {
  // Lattice coordinates are ints, with room for 2nW.
  const bool too_fine = std::max(scene.width, scene.height) > 500'000'000 / n;
  return !too_fine && needed_bytes(scene, n, options, pairs) <= 0.8 * machine_bytes();
}

Metadata job_metadata(const Job& job, const std::string& renderer) {
  return picture_metadata(job.flags, job.scene, job.options.faults, renderer);
}

Metadata picture_metadata(const JobFlags& flags, const Scene& scene, const Faults& faults,
                          const std::string& renderer) {
  const TraceSettings& trace = scene.trace;
  const auto on = [](bool value) { return std::string(value ? "on" : "off"); };
  Metadata metadata{{"program", "sidelight " SIDELIGHT_VERSION},
                    {"renderer", renderer},
                    {"scene", printable(flags.scene, 1000)},
                    {"scene_hash", scene.hash},
                    {"title", printable(scene.title, 1000)},
                    {"size", fmt::format("{}x{}", scene.width, scene.height)},
                    {"samples_per_pixel", std::to_string(flags.spp)},
                    {"depth", std::to_string(trace.depth)},
                    {"contribution_cut", fmt::format("{}", trace.contribution_cut)},
                    {"shadows", on(trace.shadows)},
                    {"reflection", on(trace.reflection)},
                    {"refraction", on(trace.refraction)}};
  if (flags.from_raster()) metadata.emplace_back("primary", flags.primary);
  if (faults.any()) metadata.emplace_back("faults", faults.text());
  return metadata;
}

std::string command_line(const Job& job, std::string_view verb) {
  const JobFlags& flags = job.flags;
  std::string line = fmt::format("sidelight {} {}", verb, shell_file(flags.scene));
  if (!flags.size.empty()) line += " -r " + flags.size;
  if (flags.spp != 1) line += fmt::format(" --spp {}", flags.spp);
  if (flags.depth != 0) line += fmt::format(" --depth {}", flags.depth);
  if (flags.no_shadows) line += " --no-shadows";
  if (flags.no_reflection) line += " --no-reflection";
  if (flags.no_refraction) line += " --no-refraction";
  if (flags.local) line += " --local";
  return line;
}

}  // namespace sidelight
