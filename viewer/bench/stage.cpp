// SPDX-License-Identifier: MIT
#include "viewer/bench/stage.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/clock.h"
#include "common/scene/tessellate.h"

namespace sidelight {

double steps_an_eye_ray(const RenderStats& stats) {
  if (stats.rays.primary == 0) return 0;
  return static_cast<double>(stats.rays.total() + stats.visibility.nodes + stats.visibility.tests) /
         static_cast<double>(stats.rays.primary);
}

Frame render_from_raster(const raster::Prepared& finds, const raytrace::Prepared& traces,
                         const Camera& camera, const RenderOptions& options) {
  RenderOptions samples = options;
  samples.layers = 0;
  samples.keep_samples = true;
  samples.progress = {};
  LapClock clock;
  const Frame found = raster::render(finds, camera, samples);
  const double raster_ms = clock.lap_ms();
  RenderOptions from_there = options;
  from_there.primary = &found;
  Frame frame = raytrace::render(traces, camera, from_there);
  frame.stats.stages = {{"raster", raster_ms}, {"raytrace", clock.lap_ms()}};
  return frame;
}

Stage::Stage(Scene scene, std::atomic<bool>* cancel) : scene_(std::move(scene)), cancel_(cancel) {}

Camera Stage::trial_camera() const {
  constexpr int kWidth = 80;
  const int smaller = (scene_.width + kWidth - 1) / kWidth;
  return make_camera(scene_.camera, scene_.width / smaller, std::max(scene_.height / smaller, 1),
                     std::max(kWidth / scene_.width, 1));
}

Model Stage::model_of(const Setting& setting) const {
  if (setting.raster) return {setting.faults.tessellate, 1, 0, true};
  return {setting.faults.tessellate, setting.depth.value_or(scene_.trace.depth),
          setting.cut.value_or(scene_.trace.contribution_cut), false};
}

Stage::Form& Stage::form(std::optional<int> tessellate, bool local) {
  const auto [at, added] = forms_.try_emplace({tessellate, local});
  Form& form = at->second;
  if (!added) return form;
  form.scene = tessellate ? tessellated(scene_, *tessellate) : scene_;
  if (local) form.scene.trace.shadows = form.scene.trace.reflection = form.scene.trace.refraction = false;
  return form;
}

// What is prepared depends on the scene's shapes and switches; depth and cut are read anew for every frame.
const raytrace::Prepared& Stage::prepared_for(const Model& model) {
  Form& it = form(model.tessellate, model.local);
  if (!it.for_raytrace) it.for_raytrace = raytrace::prepare(it.scene);
  it.scene.trace.depth = model.depth;
  it.scene.trace.contribution_cut = model.cut;
  return *it.for_raytrace;
}

// The z-buffer has no use for the switches.
const raster::Prepared& Stage::prepared_for_raster(std::optional<int> tessellate) {
  Form& it = form(tessellate, false);
  if (!it.for_raster) it.for_raster = raster::prepare(it.scene);
  return *it.for_raster;
}

Frame Stage::render(const Setting& setting, bool keep_samples) {
  const Camera view = camera(setting.n);
  RenderOptions options;
  options.threads = setting.threads;
  options.isa = setting.isa;
  options.faults = setting.faults;
  if (options.faults.depth_format)
    options.faults.set_usual_planes(glm::distance(scene_.camera.eye, scene_.camera.look_at));
  options.keep_samples = keep_samples;
  options.cancel = cancel_;
  const Model model = model_of(setting);
  if (setting.raster) return raster::render(prepared_for_raster(model.tessellate), view, options);
  const raytrace::Prepared& prepared = prepared_for(model);
  if (!setting.from_raster) return raytrace::render(prepared, view, options);
  return render_from_raster(prepared_for_raster(model.tessellate), prepared, view, options);
}

double Stage::trial_steps(const Setting& setting) {
  if (setting.raster) return 0;
  // By the recursion: packets of the few rays tried out here have less in common than the picture's, and count more.
  return steps_an_eye_ray(render_in_double(model_of(setting), trial_camera()).stats) * setting.n * setting.n;
}

void Stage::build_again(const Setting& setting) {
  const Scene& scene = form(setting.faults.tessellate, false).scene;
  if (setting.raster || setting.from_raster) raster::prepare(scene, setting.threads);
  if (!setting.raster) raytrace::prepare(scene, setting.threads);
}

Frame Stage::render_in_double(const Model& model, const Camera& camera,
                              std::function<void(double done)> progress) {
  RenderOptions options;
  options.cancel = cancel_;
  options.progress = std::move(progress);
  return raytrace::render_in_double(prepared_for(model), camera, options);
}

Frame Stage::render_reference(const Model& model, const Camera& camera) {
  RenderOptions options;
  options.cancel = cancel_;
  prepared_for(model);
  return raytrace::render_reference(form(model.tessellate, model.local).scene, camera, options);
}

}  // namespace sidelight
