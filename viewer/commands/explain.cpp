// SPDX-License-Identifier: MIT
// sidelight explain: why a pixel has its colour, in both renderers, term by term. The renderers' own code tells it
// (common/model/explanation.h); here it is only put into words, or into JSON.
#include <fmt/format.h>

#include <cmath>

#include "common/picture/frame.h"
#include "raster/raster.h"
#include "raytrace/raytrace.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/interrupt.h"
#include "viewer/commands/job.h"
#include "viewer/commands/result_json.h"
#include "viewer/report/explain_words.h"

namespace sidelight {
namespace {

struct ExplainFlags {
  JobFlags job;
  std::string pixel, sample, json;
};

// Of all samples together, a kilobyte or so of memory each and more as JSON; 4096 samples of the showcase need half of them.
constexpr std::size_t kMostRecords = std::size_t{1} << 18;

std::vector<ExplainedSample> explain_pixel(const Job& job, glm::ivec2 pixel,
                                           const std::vector<glm::ivec2>& samples) {
  const auto rasterizer = raster::prepare(job.scene, job.options.threads);
  const auto tracer = raytrace::prepare(job.scene, job.options.threads);
  std::vector<ExplainedSample> out;
  raytrace::ExplainBudget budget{kMostRecords, job.options.cancel};
  for (const glm::ivec2& sample : samples) {
    stop_if_interrupted();
    const int X = job.camera.n * pixel.x + sample.x, Y = job.camera.n * pixel.y + sample.y;
    out.push_back({sample.x, sample.y, raster::explain(*rasterizer, job.camera, X, Y),
                   raytrace::explain(*tracer, job.camera, X, Y, budget)});
  }
  return out;
}

// ---- As JSON, and in words ----

Json local_json(const Scene& scene, const LocalRecord& local) {
  const std::uint32_t primitive = local.hit.primitive;
  Json lights = Json::array();
  for (const LightRecord& light : local.lights) {
    Json one{{"light", light.light},
             {"cosine", light.cosine},
             {"highlight", light.highlight},
             {"attenuation", light.arriving},
             {"diffuse", triple_json(light.diffuse)},
             {"specular", triple_json(light.specular)},
             {"seen", light.seen},
             {"self_shadowed", light.self_shadowed}};
    one["blocker"] = light.blocker == kNone ? Json(nullptr) : Json(light.blocker);
    lights.push_back(one);
  }
  return {{"primitive", primitive},
          {"object", scene.primitive_object[primitive]},
          {"line", scene.objects[scene.primitive_object[primitive]].where.line},
          {"material", printable(scene.materials[local.surface.material].name, 1000)},
          {"depth", local.hit.t},
          {"point", triple_json(local.surface.point)},
          {"normal", triple_json(local.surface.normal)},
          {"c1", triple_json(local.local)},
          {"ambient", triple_json(local.ambient)},
          {"lights", lights}};
}

Json ray_json(const Scene& scene, const RayRecord& ray) {
  stop_if_interrupted();
  Json json{{"kind", ray_name(ray.kind)},
            {"sent", ray.sent},
            {"coefficient", triple_json(ray.coefficient)},
            {"falloff", ray.falloff},
            {"depth", ray.depth},
            {"path_weight", ray.path_weight},
            {"origin", triple_json(ray.origin)},
            {"direction", triple_json(ray.direction)},
            {"color", triple_json(ray.color)}};
  json["passed"] = Json::array();
  for (const Hit& hit : ray.passed)
    json["passed"].push_back({{"primitive", hit.primitive}, {"depth", hit.t}});
  if (ray.sent) json["background"] = ray.background;
  if (ray.sent && !ray.background) json["local"] = local_json(scene, ray.local);
  json["children"] = Json::array();
  for (const RayRecord& child : ray.children) json["children"].push_back(ray_json(scene, child));
  return json;
}

Json raster_json(const Scene& scene, const RasterRecord& record) {
  Json json{{"color", triple_json(record.color)}, {"fragments", Json::array()}};
  for (const FragmentRecord& f : record.fragments)
    json["fragments"].push_back({{"primitive", f.hit.primitive}, {"depth", f.hit.t}, {"kept", f.kept}});
  json["background"] = record.background;
  if (!record.background) json["local"] = local_json(scene, record.local);
  return json;
}

std::string explanation_text(const Job& job, glm::ivec2 pixel, const std::vector<ExplainedSample>& samples) {
  std::string out = fmt::format("pixel {},{} of {} at {}x{}\n", pixel.x, pixel.y,
                                printable(job.flags.scene, 1000), job.scene.width, job.scene.height);
  out += fmt::format("z-buffer    {}\n", color_text(mean_color(samples, Side::raster)));
  out += fmt::format("ray tracer  {}\n", color_text(mean_color(samples, Side::raytrace)));
  for (const ExplainedSample& sample : samples) {
    stop_if_interrupted();
    if (samples.size() > 1) out += fmt::format("sample {},{}\n", sample.i, sample.j);
    out += fmt::format("\nz-buffer: {}\n", color_text(sample.raster.color));
    out += raster_words(job.scene, sample.raster, 1);
    out += fmt::format("\nray tracer: {}\n", color_text(sample.raytrace.color));
    out += ray_words(job.scene, sample.raytrace, 1);
  }
  return out;
}

// {pixel, color: {raster, raytrace}, samples: [{sample, raster: {color, fragments, local}, raytrace: RAY}]} with RAY =
// {kind, sent, coefficient, falloff, depth, path_weight, origin, direction, passed, color, background or local,
// children: [RAY]} and local = {primitive, object, line, material, depth, point, normal, c1, ambient, lights}. The
// pixel's colours are the means of the samples given (as PixelMean takes them).
Json explanation_json(const Job& job, glm::ivec2 pixel, const std::vector<ExplainedSample>& samples) {
  Json json{{"scene", printable(job.flags.scene, 1000)},
            {"scene_hash", job.scene.hash},
            {"pixel", {pixel.x, pixel.y}},
            {"color",
             {{"raster", triple_json(mean_color(samples, Side::raster))},
              {"raytrace", triple_json(mean_color(samples, Side::raytrace))}}}};
  json["samples"] = Json::array();
  for (const ExplainedSample& s : samples)
    json["samples"].push_back({{"sample", {s.i, s.j}},
                               {"raster", raster_json(job.scene, s.raster)},
                               {"raytrace", ray_json(job.scene, s.raytrace)}});
  return json;
}

void check_finite(const std::vector<ExplainedSample>& samples, glm::ivec2 pixel) {
  for (const auto& [side, name] : {std::pair{Side::raster, "z-buffer"}, {Side::raytrace, "ray tracer"}}) {
    const glm::vec3 color = mean_color(samples, side);
    if (!std::isfinite(color.x) || !std::isfinite(color.y) || !std::isfinite(color.z))
      throw NumericalFault(fmt::format("{}: colour at pixel ({}, {})", name, pixel.x, pixel.y));
  }
}

int run_explain(const ExplainFlags& flags) {
  check_apart("SCENE", flags.job.scene, "--json", flags.json);
  const Job job = load_job(flags.job);
  const int n = job.camera.n;
  const glm::ivec2 pixel = parse_pixel(flags.pixel, job.scene.width, job.scene.height, "--pixel");
  std::vector<glm::ivec2> samples;
  if (!flags.sample.empty()) {
    samples.push_back(parse_pixel(flags.sample, n, n, "--sample", "i,j"));
  } else {
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) samples.emplace_back(i, j);
  }
  std::vector<ExplainedSample> explained;
  try {
    explained = explain_pixel(job, pixel, samples);
  } catch (const raytrace::TooManyRays& error) {
    throw UsageError(
        fmt::format("pixel {},{}: {}, more than {} with their lights; a lower --depth or a higher "
                    "--set trace.contribution_cut=C makes them fewer",
                    pixel.x, pixel.y, error.what(), kMostRecords));
  }

  if (flags.json != "-") {
    const std::string text = explanation_text(job, pixel, explained);
    stop_if_interrupted();
    fmt::print("{}", text);
  }
  if (!flags.json.empty()) write_json(flags.json, explanation_json(job, pixel, explained));
  check_finite(explained, pixel);
  return 0;
}

}  // namespace

void add_explain_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<ExplainFlags>();
  CLI::App* verb =
      app.add_subcommand("explain", "why a pixel has its colour, in both renderers, term by term");
  add_job_flags(*verb, flags->job);
  remove_flags(*verb, {"--crop", "--isa"});  // pixels count from the whole picture's corner
  verb->add_option("--pixel", flags->pixel, "the pixel x,y (y down)")->required();
  verb->add_option("--sample", flags->sample, "one of its samples i,j; else all of them");
  verb->add_option("--set", flags->job.set,
                   "a value of the scene file first, as trace.depth=2; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb->add_option("--json", flags->json,
                   "write it as JSON to FILE, - for standard output instead of the text");
  verb->footer(
      "Examples:\n"
      "  sidelight explain scenes/showcase.toml --pixel 380,290\n"
      "  sidelight explain scenes/07-mirrors.toml --pixel 320,200 --depth 3");
  verb->callback([flags, &exit_code] { exit_code = run_explain(*flags); });
}

}  // namespace sidelight
