// SPDX-License-Identifier: MIT
// The ray tracer: pixel order. For each sample its eye ray, and what the recursion brings back along it.
#include <vector>

#include "common/float_state.h"
#include "common/parallel.h"
#include "common/picture/pixel.h"
#include "raytrace/whitted.h"

namespace sidelight::raytrace {
namespace {

template <class Real>
Sample to_sample(const Traced<Real>& traced) {
  Sample sample;
  sample.color = glm::vec3(traced.color);
  sample[Layer::ambient] = glm::vec3(traced.ambient);
  sample[Layer::diffuse] = glm::vec3(traced.diffuse);
  sample[Layer::specular] = glm::vec3(traced.specular);
  sample[Layer::shadow] = glm::vec3(traced.shadow);
  sample[Layer::reflection] = glm::vec3(traced.mirrored);
  sample[Layer::refraction] = glm::vec3(traced.refracted);
  if (!traced.hit.found()) return sample;
  sample.object = 1 + traced.object;
  sample.primitive = 1 + traced.hit.primitive;
  sample.t = traced.hit.t;
  sample.normal = traced.normal;
  return sample;
}

Path eye_path(const Camera& camera, const Media& eye_media, int X, int Y) {
  Path path;
  path.ray = {camera.eye, camera.direction(X, Y)};
  path.media = eye_media;
  return path;
}

template <class Real>
void trace_row(const Prepared& prepared, const Camera& camera, const Media& eye_media, const RenderOptions& options, int y,
               Frame& frame, RenderStats& stats) {
  const int n = camera.n;
  NoRecorder<Real> nothing;
  Whitted<Real, NoRecorder<Real>> whitted(prepared, stats, nothing, options.faults, options.isa);
  PixelWriter pixel(frame, camera.depth_scale());
  for (int x = frame.window.x0; x < frame.window.x1; ++x) {
    for (int Y = n * y; Y < n * (y + 1); ++Y)
      for (int X = n * x; X < n * (x + 1); ++X) {
        ++stats.rays.primary;
        const std::uint64_t tests_before = stats.signs.tests;
        Sample sample = to_sample(whitted.trace(eye_path(camera, eye_media, X, Y)));
        sample.tests = stats.signs.tests - tests_before;
        pixel.add(sample);
      }
    pixel.write(x, y);
  }
}

}  // namespace

std::shared_ptr<const Prepared> prepare(const Scene& scene, int threads) {
  return prepare_for(needs_of(scene), scene, threads);
}
std::shared_ptr<const Prepared> prepare_for(const Needs& needs, const Scene& scene, int threads) {
  const StandardFloatState nearest_and_denormals;
  return std::make_shared<const Prepared>(scene, needs, threads);
}

namespace {

template <class Real>
Frame render_in(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  const StandardFloatState nearest_and_denormals;
  Frame frame = make_frame(camera.width, camera.height, camera.n, options);
  const Media eye_media = media_at(prepared, camera.eye);
  // Statistics by row, so that their sums do not depend on which thread did what.
  std::vector<RenderStats> stats(static_cast<std::size_t>(frame.height()));
  std::atomic<int> done{0};
  parallel_for(frame.height(), options.threads, [&](int row, int) {
    if (options.cancel && *options.cancel) throw Interrupted();
    trace_row<Real>(prepared, camera, eye_media, options, frame.window.y0 + row, frame,
                    stats[static_cast<std::size_t>(row)]);
    if (options.progress) options.progress(static_cast<double>(++done) / frame.height());
  });
  for (const RenderStats& s : stats) {
    frame.stats.add_counts(s);
    frame.stats.cut_weight += s.cut_weight;
  }
  frame.stats.cut_weight /= static_cast<double>(frame.pixels()) * camera.n * camera.n;
  return frame;
}

}  // namespace

Frame render(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  return render_in<float>(prepared, camera, options);
}
Frame render_in_double(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  return render_in<double>(prepared, camera, options);
}

RayRecord explain(const Prepared& prepared, const Camera& camera, int X, int Y) {
  const StandardFloatState nearest_and_denormals;
  RenderStats stats;
  TreeRecorder recorder;
  Whitted<float, TreeRecorder> whitted(prepared, stats, recorder);
  whitted.trace(eye_path(camera, media_at(prepared, camera.eye), X, Y));
  return recorder.root();
}

}  // namespace sidelight::raytrace
