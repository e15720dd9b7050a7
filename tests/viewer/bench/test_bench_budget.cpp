// SPDX-License-Identifier: MIT
// What a sweep may cost: the reference image and the default sweep end where they would take too long, and say so.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <mutex>

#include "common/scene/toml.h"
#include "tests/support/lit.h"
#include "tests/support/text.h"
#include "viewer/bench/reference.h"
#include "viewer/bench/sweep.h"

using namespace sidelight;
using test::contains;

namespace {

// Where rays multiply at every surface.
const std::string kNestedGlass = SIDELIGHT_SOURCE_DIR "/scenes/10-nested-glass.toml";

SweepPlan plan_of(const std::string& scene, bool limited) {
  SweepPlan plan;
  plan.scenes = {scene};
  plan.size = glm::ivec2(32, 24);
  plan.configs = sweep_configs("default");
  plan.timed = false;
  plan.limited = limited;
  return plan;
}

}  // namespace

TEST_CASE("budget: the default sweep leaves out the slowest by name, and no standard setting") {
  const BenchResult result = run_sweep(plan_of(kNestedGlass, true));
  std::size_t left_out = 0, finished = 0;
  double dearest_finished = 0;
  Scene scene = load_scene(kNestedGlass);
  scene.width = 32;
  scene.height = 24;
  Stage stage(scene);
  for (const BenchPoint& point : result.points) {
    CAPTURE(point.varied);
    CHECK(point.finished == point.left_out.empty());
    left_out += !point.left_out.empty();
    finished += point.finished;
    if (point.varied.empty()) CHECK(point.finished);
    if (point.finished && !point.varied.empty())
      dearest_finished = std::max(dearest_finished, stage.trial_steps(setting_of(point.config)));
    if (!point.left_out.empty()) CHECK(contains(point.left_out, "steps a pixel"));
  }
  CHECK(left_out >= 1);
  CHECK(finished > left_out);
  CHECK(dearest_finished < kRoundSteps);
}

TEST_CASE("budget: a reference image of rays that multiply cuts the weakest, and bounds what it left out") {
  Scene scene = load_scene(kNestedGlass);
  scene.width = 32;
  scene.height = 24;
  Stage stage(scene);
  Reference reference(stage, PictureCache(""));
  double told = 0;
  std::mutex mutex;
  const ReferenceImage image = reference.converge(1, [&](double steps) {
    const std::lock_guard lock(mutex);
    told = std::max(told, steps);
  });
  CHECK(image.cut > 0);
  CHECK(image.cut_weight > 0);
  // No more than what the scene itself leaves out, where it was tried out.
  const auto unsent = [&](const Model& model) {
    return stage.render_in_double(model, stage.trial_camera()).stats.cut_weight;
  };
  CHECK(unsent({{}, image.depth, image.cut, false}) <= unsent(stage.model_of({})));
  CHECK(std::isfinite(image.unsent_bound));
  CHECK(image.unsent_bound >= image.cut_weight * 0.1);
  CHECK(image.n >= 4);
  CHECK((image.converged || image.too_dear));
  double spent = 0;
  for (int n = 1; n <= image.n; n *= 2) spent += reference.picture(n).steps;
  // A trial with fewer pixels told what n = 1 takes; half as much again is allowed for that.
  CHECK(spent <= 1.5 * kReferenceSteps);
  CHECK(told > 0.5 * spent);
  CHECK(told <= 1.01 * spent);
}

TEST_CASE("budget: what rays not sent can bring is the brightest surface or background, or has no bound") {
  Scene scene;
  scene.background = {0.1, 0.2, 0.5};
  CHECK(unsent_bound(scene, 0) == 0);
  CHECK(unsent_bound(scene, 0.5) == 0.25);
  Light lamp;
  lamp.position = {0, 1, 0};
  lamp.intensity = {1, 1, 2};
  lamp.attenuation = {0.5, 1, 0};  // at most twice the intensity
  scene.lights = {lamp};
  scene.ambient = glm::dvec3(1);
  Material bright;
  bright.ambient = glm::dvec3(0.25);
  bright.diffuse = glm::dvec3(0.5);
  bright.local = glm::dvec3(0.5);
  bright.reflect = glm::dvec3(0.5);
  add_material(scene, bright);
  // Two such mirrors face to face bring the local light, halved by c1, as a geometric series of 1/2.
  CHECK(unsent_bound(scene, 0.5) == 0.5 * 2 * (0.5 * (0.25 + 2 * 2 * 0.5)));
  Material clear;  // brings what is behind it
  clear.refract = glm::dvec3(1);
  add_material(scene, clear);
  CHECK(unsent_bound(scene, 0.5) == 0.5 * 2 * (0.5 * (0.25 + 2 * 2 * 0.5)));
  scene.materials[0].refract = glm::dvec3(0.5);
  CHECK(std::isinf(unsent_bound(scene, 0.5)));
  scene.materials[0].local = scene.materials[0].refract = glm::dvec3(0);
  scene.lights[0].attenuation = {0, 1, 0};
  CHECK(std::isinf(unsent_bound(scene, 0.5)));
}

TEST_CASE("budget: the progress of a sweep goes from 0 to 1 over all its scenes") {
  SweepPlan plan = plan_of(SIDELIGHT_SOURCE_DIR "/scenes/07-mirrors.toml", true);
  plan.scenes.push_back(SIDELIGHT_SOURCE_DIR "/scenes/02-diffuse.toml");
  plan.configs = product_configs({"samples=1,4"});
  plan.timed = true;
  std::vector<double> told;
  std::mutex mutex;
  plan.progress = [&](double done) {
    const std::lock_guard lock(mutex);
    told.push_back(done);
  };
  const BenchResult result = run_sweep(plan);
  REQUIRE(told.size() > 2 * 4 * 7);
  CHECK(told.front() < 0.5);
  CHECK(std::abs(told.back() - 1) < 1e-9);
  CHECK(*std::max_element(told.begin(), told.end()) < 1 + 1e-9);
}
