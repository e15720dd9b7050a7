// SPDX-License-Identifier: MIT
// A loaded scene in all the forms that settings ask for (tessellated, local light only), each prepared once, and the
// pictures of it: a setting's, and in double those that its errors are measured against.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>

#include "raster/raster.h"
#include "raytrace/raytrace.h"
#include "viewer/bench/knobs.h"

namespace sidelight {

// What a picture is of, apart from its samples and its rounding.
struct Model {
  std::optional<int> tessellate;
  int depth = 1;
  double cut = 0;
  bool local = false;  // no shadows, no secondary rays: all that a z-buffer knows
  auto operator<=>(const Model&) const = default;
};

// The work behind a picture, the same on any machine: rays sent, nodes of the hierarchy that they entered and primitives
// tried on them. Of one eye ray: that times the samples of a pixel are the steps of a pixel. A z-buffer sends none.
double steps_an_eye_ray(const RenderStats& stats);

// The ray tracer with the z-buffer's answer to what each sample shows, in place of eye rays. Both name the same surface at
// the same depth, so not one bit of the picture changes; what does is who did the work. The one place where a picture
// takes both renderers: neither knows of the other.
// Layers: kAllLayers but cost, which counts the tests of eye rays. No faults. Its time is that of both renderers, told
// apart in stats.stages (the z-buffer shades what it finds, too); its counts are the ray tracer's.
Frame render_from_raster(const raster::Prepared& finds, const raytrace::Prepared& traces,
                         const Camera& camera, const RenderOptions& options);

class Stage {
 public:
  // Rendering throws Interrupted when `cancel`, which may be null, is raised.
  explicit Stage(Scene scene, std::atomic<bool>* cancel = nullptr);

  const Scene& scene() const { return scene_; }
  Camera camera(int n) const { return make_camera(scene_.camera, scene_.width, scene_.height, n); }
  // The same view with about 80 samples in a row: on fewer pixels where there are many, and with more samples where there
  // are few. To try out what a picture will cost.
  Camera trial_camera() const;
  Model model_of(const Setting& setting) const;
  // The scene in the setting's form: its primitives have other numbers where spheres are tessellated.
  const Scene& scene_of(const Setting& setting) { return form(setting.faults.tessellate, false).scene; }

  // The setting's picture: its colours, and the primitive and depth of every sample if they are to be kept.
  Frame render(const Setting& setting, bool keep_samples);
  // Of a pixel of that picture, tried out as its recursion takes them. 0 for the z-buffer.
  double trial_steps(const Setting& setting);
  // What a renderer does once a scene. Settings with the same key share it.
  using BuildKey = std::tuple<bool, bool, std::optional<int>>;  // raster, from_raster, tessellate
  static BuildKey build_key(const Setting& setting) {
    return {setting.raster, setting.from_raster, setting.faults.tessellate};
  }
  void build_again(const Setting& setting);  // for its time only; what is kept stays

  // The ray tracer's picture of the model with light in double; `progress`, which may be empty, hears how far it is.
  Frame render_in_double(const Model& model, const Camera& camera,
                         std::function<void(double done)> progress = {});
  // The same by brute force.
  Frame render_reference(const Model& model, const Camera& camera);

 private:
  struct Form {
    Scene scene;
    std::shared_ptr<const raster::Prepared> for_raster;
    std::shared_ptr<const raytrace::Prepared> for_raytrace;
  };
  Form& form(std::optional<int> tessellate, bool local);
  const raytrace::Prepared& prepared_for(const Model& model);
  const raster::Prepared& prepared_for_raster(std::optional<int> tessellate);

  Scene scene_;
  std::atomic<bool>* cancel_;
  std::map<std::pair<std::optional<int>, bool>, Form> forms_;
};

}  // namespace sidelight
