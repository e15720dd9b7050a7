// SPDX-License-Identifier: MIT
#include "viewer/commands/renderers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "viewer/bench/stage.h"
#include "viewer/commands/progress.h"

namespace sidelight {
namespace {

// How far the eye moves a frame while times are taken: 1e-3 of the scene's size, taken as its distance to what it
// looks at.
Camera moved_camera(const Job& job, int frame) {
  CameraSettings settings = job.scene.camera;
  const double size = glm::distance(settings.eye, settings.look_at);
  const glm::dvec3 step = 1e-3 * size * frame * job.camera.right / glm::length(job.camera.right);
  settings.eye += step;
  settings.look_at += step;
  return make_camera(settings, job.camera.width, job.camera.height, job.camera.n);
}

// A renderer whose scene-only work is kept between frames.
template <auto prepare, auto render>
FrameMaker fast(const Scene& scene, int threads) {
  return [prepared = prepare(scene, threads)](const Camera& camera, const RenderOptions& options) {
    return render(*prepared, camera, options);
  };
}

template <auto render>
FrameMaker reference(const Scene& scene, int) {
  return
      [&scene](const Camera& camera, const RenderOptions& options) { return render(scene, camera, options); };
}

FrameMaker from_raster(const Scene& scene, int threads) {
  return [finds = raster::prepare(scene, threads), traces = raytrace::prepare(scene, threads)](
             const Camera& camera, const RenderOptions& options) {
    return render_from_raster(*finds, *traces, camera, options);
  };
}

constexpr Renderer kRaytraceFromRaster{"raytrace", "ray tracer, from the z-buffer", kRaytraceLayers,
                                       from_raster};

}  // namespace

const std::array<Renderer, 4> kRenderers{
    {{"raster", "z-buffer", kRasterLayers | layer_bit(Layer::cost), fast<raster::prepare, raster::render>},
     {"raytrace", "ray tracer", kAllLayers, fast<raytrace::prepare, raytrace::render>},
     {"raster-reference", "z-buffer, reference", kRasterLayers, reference<raster::render_reference>},
     {"raytrace-reference", "ray tracer, reference", kRaytraceLayers,
      reference<raytrace::render_reference>}}};

const Renderer* find_renderer(std::string_view name) {
  const auto at =
      std::find_if(kRenderers.begin(), kRenderers.end(), [&](const Renderer& r) { return r.name == name; });
  return at == kRenderers.end() ? nullptr : &*at;
}

const Renderer& with_primary(const Job& job, const Renderer& renderer) {
  if (!job.flags.from_raster()) return renderer;
  if (renderer.name != "raytrace")
    throw UsageError(fmt::format("--primary raster is for the renderer 'raytrace'; got '{}'", renderer.name));
  if (job.options.faults.any())
    throw UsageError(
        fmt::format("--primary raster goes with no faults on purpose; got {}", job.options.faults.text()));
  return kRaytraceFromRaster;
}

TimedFrame render_once(const Job& job, const Renderer& renderer, const RenderOptions& options) {
  const double start = wall_ms();
  const FrameMaker make_frame = renderer.prepare(job.scene, options.threads);
  const double built = wall_ms();
  Frame frame = make_frame(job.camera, options);
  return {std::move(frame), built - start, wall_ms() - built};
}

TimedFrame render_repeatedly(const Job& job, const Renderer& renderer, int repeat,
                             std::vector<double>& frame_ms, std::vector<double>& frame_cpu_ms) {
  const double start = wall_ms();
  const FrameMaker make_frame = renderer.prepare(job.scene, job.options.threads);
  TimedFrame out;
  out.build_ms = wall_ms() - start;
  make_frame(job.camera, job.options);  // the warm-up
  for (int i = 1; i <= repeat; ++i) {
    const Camera camera = moved_camera(job, i);
    const double wall = wall_ms(), cpu = cpu_ms();
    make_frame(camera, job.options);
    frame_ms.push_back(wall_ms() - wall);
    frame_cpu_ms.push_back(cpu_ms() - cpu);
  }
  out.frame = make_frame(job.camera, job.options);
  return out;
}

void check_finite(const Frame& frame, std::string_view label) {
  if (const std::string fault = first_non_finite(frame); !fault.empty())
    throw NumericalFault(fmt::format("{}: {}", label, fault));
}

TimedFrame render_all_layers(const Job& job, const Renderer& renderer) {
  constexpr LayerMask kCost = layer_bit(Layer::cost);
  RenderOptions options = job.options;
  options.layers = renderer.layers & ~kCost;
  ProgressBar bar(std::string(renderer.label), job.flags.quiet);
  options.progress = bar.callback();
  TimedFrame timed = render_once(job, renderer, options);
  check_finite(timed.frame, renderer.label);
  if ((renderer.layers & kCost) == 0) return timed;
  // What a pixel costs is counted by the renderers' readable paths: apart, so that times are those of the fast ones.
  options.layers = kCost;
  options.keep_samples = false;
  options.progress = {};
  timed.frame.cost = render_once(job, renderer, options).frame.cost;
  return timed;
}

}  // namespace sidelight
