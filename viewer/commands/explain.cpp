// SPDX-License-Identifier: MIT
// sidelight explain: why a pixel has its colour, in both renderers, term by term. The renderers' own code tells it
// (common/model/explanation.h); here it is only put into words, or into JSON.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/picture/frame.h"
#include "raster/raster.h"
#include "raytrace/raytrace.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/explain_text.h"
#include "viewer/commands/interrupt.h"
#include "viewer/commands/job.h"
#include "viewer/commands/result_json.h"

namespace sidelight {
namespace {

struct ExplainFlags {
  JobFlags job;
  std::string pixel, sample, json;
};

std::vector<ExplainedSample> explain_pixel(const Job& job, glm::ivec2 pixel,
                                           const std::vector<glm::ivec2>& samples) {
  const auto rasterizer = raster::prepare(job.scene, job.options.threads);
  const auto tracer = raytrace::prepare(job.scene, job.options.threads);
  std::vector<ExplainedSample> out;
  for (const glm::ivec2& sample : samples) {
    stop_if_interrupted();
    const int X = job.camera.n * pixel.x + sample.x, Y = job.camera.n * pixel.y + sample.y;
    out.push_back({sample.x, sample.y, raster::explain(*rasterizer, job.camera, X, Y),
                   raytrace::explain(*tracer, job.camera, X, Y)});
  }
  return out;
}

void check_finite(const std::vector<ExplainedSample>& samples, glm::ivec2 pixel) {
  for (const auto& [side, name] : {std::pair{Side::raster, "z-buffer"}, {Side::raytrace, "ray tracer"}}) {
    const glm::vec3 color = mean_color(samples, side);
    if (!std::isfinite(color.x) || !std::isfinite(color.y) || !std::isfinite(color.z))
      throw NumericalFault(fmt::format("{}: colour at pixel ({}, {})", name, pixel.x, pixel.y));
  }
}

int run_explain(const ExplainFlags& flags) {
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
  const std::vector<ExplainedSample> explained = explain_pixel(job, pixel, samples);

  if (flags.json != "-") fmt::print("{}", explanation_text(job, pixel, explained));
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
