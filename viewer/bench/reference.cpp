// SPDX-License-Identifier: MIT
#include "viewer/bench/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace sidelight {
namespace {

// Where brute force takes seconds, not hours: tests of a ray against a primitive.
constexpr double kAffordableTests = 1e8;
constexpr int kProbeWidth = 160;

double rays_an_eye_ray(const RenderStats& stats) {
  return static_cast<double>(stats.rays.total()) / static_cast<double>(stats.rays.primary);
}

double number(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

double rmse(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, const Scene& scene) {
  return measure(a, b, scene.width, scene.height).rms;
}

}  // namespace

std::string Reference::key(int n) const {
  const Scene& scene = stage_.scene();
  return fmt::format("reference image, {}, scene {}, {}x{}, {}x{} samples", SIDELIGHT_VERSION, scene.hash,
                     scene.width, scene.height, n, n);
}

// Tried out on the same view with about kProbeWidth samples in a row: on fewer pixels where there are many, and with
// more samples where there are few. Level by level while rays multiply, so that no step is a leap; else ever faster.
Model Reference::full_model() {
  const Scene& scene = stage_.scene();
  const int smaller = (scene.width + kProbeWidth - 1) / kProbeWidth;
  const Camera camera = make_camera(scene.camera, scene.width / smaller, std::max(scene.height / smaller, 1),
                                    std::max(kProbeWidth / scene.width, 1));
  Model affordable{{}, 1, 0, false};
  for (int depth = 1, step = 1;;) {
    const RenderStats stats = stage_.render_in_double({{}, depth, 0, false}, camera).stats;
    const double rays = rays_an_eye_ray(stats);
    if (rays > kMostRays) break;
    step = rays < 1.1 * rays_an_eye_ray_ ? 2 * step : 1;
    affordable.depth = depth;
    rays_an_eye_ray_ = rays;
    const bool all = stats.cut_weight < 0x1p-24 && depth >= scene.trace.depth;
    if (all || depth == kMostDepth) break;
    depth = std::min(depth + step, kMostDepth);
  }
  if (affordable.depth < scene.trace.depth)
    return {{}, scene.trace.depth, scene.trace.contribution_cut, false};
  return affordable;
}

Reference::Picture Reference::make(int n) {
  made_any_ = true;
  const Scene& scene = stage_.scene();
  Picture out;
  out.model = n == 1 ? full_model() : picture(1).model;
  const Camera camera = stage_.camera(n);
  Frame frame = stage_.render_in_double(out.model, camera);
  out.cut_weight = frame.stats.cut_weight;
  const double tests = rays_an_eye_ray_ * static_cast<double>(frame.pixels()) *
                       static_cast<double>(scene.primitive_object.size());
  Metadata notes{{"depth", fmt::format("{}", out.model.depth)},
                 {"cut", fmt::format("{}", out.model.cut)},
                 {"cut_weight", fmt::format("{}", out.cut_weight)}};
  if (n == 1 && tests <= kAffordableTests) {
    out.against_brute_force = rmse(frame.color, stage_.render_reference(out.model, camera).color, scene);
    notes.emplace_back("against_brute_force", fmt::format("{}", *out.against_brute_force));
  }
  cache_.keep(key(n), frame, notes);
  out.color = std::move(frame.color);
  return out;
}

const Reference::Picture& Reference::picture(int n) {
  if (const auto at = pictures_.find(n); at != pictures_.end()) return at->second;
  if (auto kept = cache_.find(key(n), stage_.scene().width, stage_.scene().height)) {
    Picture out;
    out.model = {{}, static_cast<int>(number(kept->notes["depth"])), number(kept->notes["cut"]), false};
    out.cut_weight = number(kept->notes["cut_weight"]);
    out.color = std::move(kept->color);
    if (const std::string& text = kept->notes["against_brute_force"]; !text.empty())
      out.against_brute_force = number(text);
    return pictures_.emplace(n, std::move(out)).first->second;
  }
  Picture made = make(n);
  return pictures_.emplace(n, std::move(made)).first->second;
}

ReferenceImage Reference::converge(const std::function<void(int n)>& progress) {
  ReferenceImage image;
  image.bound = kReferenceBound;
  for (int n = 1; n <= 16; n *= 2) {
    if (progress) progress(n);
    const Picture& now = picture(n);
    image.depth = now.model.depth;
    image.cut = now.model.cut;
    image.cut_weight = now.cut_weight;
    if (n == 1) {
      image.against_brute_force = now.against_brute_force;
      continue;
    }
    image.steps.push_back(rmse(picture(n / 2).color, now.color, stage_.scene()));
    image.n = n;
    image.converged = image.steps.back() < image.bound;
    if (image.converged) break;
  }
  image.remaining = remaining_error(image.steps);
  return image;
}

double remaining_error(const std::vector<double>& steps) {
  if (steps.empty()) return std::numeric_limits<double>::infinity();
  const double last = steps.back();
  if (last == 0) return 0;
  const double q = steps.size() > 1 ? last / steps[steps.size() - 2] : 0.5;
  return q < 1 ? last * q / (1 - q) : std::numeric_limits<double>::infinity();
}

}  // namespace sidelight
