// SPDX-License-Identifier: MIT
#include "viewer/bench/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace sidelight {
namespace {

// Where brute force takes seconds, not hours: tests of a ray against a primitive.
constexpr double kAffordableTests = 1e8;

double rays_of(const RenderStats& stats) {
  const RayCounts& rays = stats.rays;
  return static_cast<double>(rays.primary + rays.shadow + rays.reflection + rays.refraction);
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

// Tried out on a picture of a quarter of the size each way.
int Reference::full_depth() {
  const Scene& scene = stage_.scene();
  const Camera camera = make_camera(scene.camera, (scene.width + 3) / 4, (scene.height + 3) / 4, 1);
  const auto probe = [&](int depth) { return stage_.render_in_double({{}, depth, 0, false}, camera).stats; };
  int depth = scene.trace.depth;
  RenderStats stats = probe(depth);
  while (stats.cut_weight >= 0x1p-24 && depth < kMostDepth &&
         rays_of(stats) < kMostRays * static_cast<double>(stats.rays.primary)) {
    depth = std::min(depth + depth / 2 + 1, kMostDepth);
    stats = probe(depth);
  }
  rays_an_eye_ray_ = rays_of(stats) / static_cast<double>(stats.rays.primary);
  return depth;
}

Reference::Picture Reference::make(int n) {
  made_any_ = true;
  const Scene& scene = stage_.scene();
  Picture out;
  out.depth = n == 1 ? full_depth() : picture(1).depth;
  const Model full{{}, out.depth, 0, false};
  const Camera camera = stage_.camera(n);
  Frame frame = stage_.render_in_double(full, camera);
  out.cut_weight = frame.stats.cut_weight;
  const double tests = rays_an_eye_ray_ * static_cast<double>(frame.pixels()) *
                       static_cast<double>(scene.primitive_object.size());
  Metadata notes{{"depth", fmt::format("{}", out.depth)}, {"cut_weight", fmt::format("{}", out.cut_weight)}};
  if (n == 1 && tests <= kAffordableTests) {
    out.against_brute_force = rmse(frame.color, stage_.render_reference(full, camera).color, scene);
    notes.emplace_back("against_brute_force", fmt::format("{}", *out.against_brute_force));
  }
  cache_.keep(key(n), frame, notes);
  out.color = std::move(frame.color);
  return out;
}

const Reference::Picture& Reference::picture(int n) {
  if (const auto at = pictures_.find(n); at != pictures_.end()) return at->second;
  if (auto kept = cache_.find(key(n), stage_.scene().width, stage_.scene().height)) {
    Picture out{
        static_cast<int>(number(kept->notes["depth"])), number(kept->notes["cut_weight"]), {}, kept->color};
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
    image.depth = now.depth;
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
