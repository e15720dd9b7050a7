// SPDX-License-Identifier: MIT
#include "viewer/bench/judge_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <span>

namespace sidelight {
namespace {

// A power of two that makes all but the greatest differences visible.
double gain_for(const ErrorMeasure& error) {
  if (error.p999 <= 0) return 1;
  return std::exp2(std::clamp(std::floor(std::log2(0.5 / error.p999)), 0.0, 24.0));
}

Image8 difference_picture(std::span<const glm::vec3> a, std::span<const glm::vec3> b, double gain, int width,
                          int height) {
  std::vector<glm::vec3> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = static_cast<float>(gain) * glm::abs(a[i] - b[i]);
  return to_image8(out, width, height);
}

void add_counts(const Frame& frame, BenchPoint& point) {
  const RenderStats& stats = frame.stats;
  point.rays = stats.rays.total();
  point.fragments = stats.visibility.fragments;
  point.tests = stats.visibility.tests;
  if (point.rays == 0) return;
  point.tests_per_ray = static_cast<double>(stats.visibility.tests) / static_cast<double>(point.rays);
  point.nodes_per_ray = static_cast<double>(stats.visibility.nodes) / static_cast<double>(point.rays);
}

}  // namespace

std::span<const glm::vec3> PictureJudge::truth_of(const Model& model, int n) {
  const auto [at, added] = truths_.try_emplace({model, n});
  if (added) at->second = stage_.render_in_double(model, stage_.camera(n)).color;
  return at->second;
}

void PictureJudge::judge(const Setting& setting, BenchPoint& point) {
  const Scene& scene = stage_.scene();
  const int width = scene.width, height = scene.height;
  const Frame frame = stage_.render(setting, true);
  add_counts(frame, point);

  // Gates: what is seen, and whether all of it is a number.
  const VisibleError visible = visible_.compare(setting, frame);
  const auto error_against = [&](std::span<const glm::vec3> picture, std::span<const glm::vec3> truth) {
    return picture_error(picture, truth, visible.covered, width, height);
  };
  const std::span<const glm::vec3> reference = reference_.picture(reference_n_).color;
  point.error = error_against(frame.color, reference);
  point.error.whole.depth = point.error.covered.depth = visible.depth_error;
  point.mismatches = visible.mismatches;
  if (point.mismatches > 0)
    point.failures.push_back(fmt::format("samples that show another surface: {}", point.mismatches));
  if (const std::uint64_t bad = point.error.whole.metrics.non_finite; bad > 0)
    point.failures.push_back(fmt::format("values that are not finite: {}", bad));

  // By kind.
  const std::span<const glm::vec3> truth = truth_of(stage_.model_of(setting), setting.n);
  const std::span<const glm::vec3> full = reference_.picture(setting.n).color;
  const auto kind = [&](ErrorKind which) -> std::optional<PictureError>& {
    return point.by_kind[static_cast<std::size_t>(which)];
  };
  kind(ErrorKind::arithmetic) = error_against(frame.color, truth);
  kind(ErrorKind::model) = error_against(truth, full);
  if (setting.n < reference_n_) kind(ErrorKind::sampling) = error_against(full, reference);
  // A depth is off by the model where facets stand for a sphere, else by arithmetic.
  PictureError& depth = *kind(setting.faults.tessellate ? ErrorKind::model : ErrorKind::arithmetic);
  depth.whole.depth = depth.covered.depth = visible.depth_error;

  point.picture = to_image8(frame.color, width, height);
  point.difference_gain = gain_for(point.error.whole);
  point.difference = difference_picture(frame.color, reference, point.difference_gain, width, height);
}

}  // namespace sidelight
