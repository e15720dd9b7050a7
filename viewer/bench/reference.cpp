// SPDX-License-Identifier: MIT
#include "viewer/bench/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <glm/gtx/component_wise.hpp>
#include <span>

namespace sidelight {
namespace {

// Where brute force takes seconds, not hours: tests of a ray against a primitive.
constexpr double kAffordableTests = 1e8;
double number(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

double rmse(std::span<const glm::vec3> a, std::span<const glm::vec3> b, const Scene& scene) {
  return measure(a, b, scene.width, scene.height).rms;
}

}  // namespace

std::string Reference::key(int n) const {
  const Scene& scene = stage_.scene();
  return fmt::format("reference image, program {}, scene {}, {}x{}, {}x{} samples", program_hash(),
                     scene.hash, scene.width, scene.height, n, n);
}

Reference::Trial Reference::trial(int depth, double cut) {
  Trial out{{{}, depth, cut, false}};
  const RenderStats stats = stage_.render_in_double(out.model, stage_.trial_camera()).stats;
  out.unsent = stats.cut_weight;
  out.steps = steps_an_eye_ray(stats);
  out.all_sent = stats.cut_weight < 0x1p-24;
  return out;
}

// Level by level while rays multiply, so that no step is a leap; else ever faster.
Reference::Trial Reference::deepest(double cut) {
  constexpr double kAffordable = kReferenceSteps / (1 + 4 + 16);
  Trial best;
  for (int depth = 1, step = 1;;) {
    const Trial now = trial(depth, cut);
    if (now.steps > kAffordable) return best;
    step = now.steps < 1.1 * best.steps ? 2 * step : 1;
    best = now;
    if (now.all_sent || depth == kMostDepth) return best;
    depth = std::min(depth + step, kMostDepth);
  }
}

Model Reference::full_model() {
  Trial best = deepest(0);
  if (best.all_sent || best.model.depth == kMostDepth) return best.model;
  for (double cut = 0.125;; cut /= 2) {
    const Trial now = deepest(cut);
    if (now.unsent >= best.unsent && cut < 0.125) break;
    if (now.unsent < best.unsent) best = now;
  }
  const TraceSettings& own = stage_.scene().trace;
  const Trial asked = trial(own.depth, own.contribution_cut);
  return asked.unsent < best.unsent ? asked.model : best.model;
}

Reference::Picture Reference::make(int n) {
  made_any_ = true;
  const Scene& scene = stage_.scene();
  Picture out;
  out.model = n == 1 ? full_model() : picture(1).model;
  const Camera camera = stage_.camera(n);
  const double planned = n == 1 ? 0 : 4 * picture(n / 2).steps;
  Frame frame = stage_.render_in_double(out.model, camera, [&](double done) {
    if (progress_) progress_(spent_ + done * planned);
  });
  out.cut_weight = frame.stats.cut_weight;
  out.steps = steps_an_eye_ray(frame.stats) * n * n;
  const double tests =
      static_cast<double>(frame.stats.rays.total()) * static_cast<double>(scene.primitive_object.size());
  Metadata notes{{"depth", fmt::format("{}", out.model.depth)},
                 {"cut", fmt::format("{}", out.model.cut)},
                 {"cut_weight", fmt::format("{}", out.cut_weight)},
                 {"steps", fmt::format("{}", out.steps)}};
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
    out.steps = number(kept->notes["steps"]);
    out.color.assign(kept->color.begin(), kept->color.end());
    if (const std::string& text = kept->notes["against_brute_force"]; !text.empty())
      out.against_brute_force = number(text);
    return pictures_.emplace(n, std::move(out)).first->second;
  }
  Picture made = make(n);
  return pictures_.emplace(n, std::move(made)).first->second;
}

ReferenceImage Reference::converge(int finest, std::function<void(double steps)> progress) {
  progress_ = std::move(progress);
  spent_ = 0;
  ReferenceImage image;
  image.bound = kReferenceBound;
  const int most = std::max(16, 2 * finest);
  for (int n = 1; n <= most; n *= 2) {
    const Picture& now = picture(n);
    spent_ += now.steps;
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
    image.finer = n >= 2 * finest;
    const bool enough = image.converged && image.finer;
    image.too_dear = !enough && 2 * n <= most && spent_ + 4 * now.steps > kReferenceSteps;
    if (enough || image.too_dear) break;
  }
  image.unsent_bound = unsent_bound(stage_.scene(), image.cut_weight);
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

double unsent_bound(const Scene& scene, double cut_weight) {
  if (cut_weight == 0) return 0;
  double brightest = glm::compMax(scene.background);
  for (const Material& material : scene.materials) {
    glm::dvec3 local = material.ambient * scene.ambient;
    for (const Light& light : scene.lights) {
      if (!light.directional && light.attenuation.q0 == 0) return std::numeric_limits<double>::infinity();
      const double at_most = light.directional ? 1 : 1 / light.attenuation.q0;
      local += at_most * light.intensity * (material.diffuse + material.specular);
    }
    local *= material.local;
    for (int c = 0; c < 3; ++c) {
      const double given_on = material.reflect[c] + material.refract[c];
      if (given_on > 1 || (given_on == 1 && local[c] > 0)) return std::numeric_limits<double>::infinity();
      if (given_on < 1) brightest = std::max(brightest, local[c] / (1 - given_on));
    }
  }
  return cut_weight * brightest;
}

}  // namespace sidelight
