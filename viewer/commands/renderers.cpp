// SPDX-License-Identifier: MIT
#include "viewer/commands/renderers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "viewer/bench/raster_primary.h"
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

template <class RenderFrame>
Frame repeat_frames(const Job& job, int repeat, std::vector<double>& frame_ms, std::vector<double>& cpu,
                    const RenderFrame& render_frame) {
  for (int i = 0; i <= repeat; ++i) {  // frame 0 warms up
    const Camera camera = moved_camera(job, i);
    const double wall = wall_ms(), processor = cpu_ms();
    render_frame(camera);
    if (i == 0) continue;
    frame_ms.push_back(wall_ms() - wall);
    cpu.push_back(cpu_ms() - processor);
  }
  return render_frame(job.camera);
}

// A renderer whose scene-only work is kept between frames.
template <auto prepare, auto render>
struct Fast {
  static TimedFrame once(const Job& job, const Camera& camera, const RenderOptions& options) {
    const double start = wall_ms();
    const auto prepared = prepare(job.scene, options.threads);
    const double built = wall_ms();
    Frame frame = render(*prepared, camera, options);
    return {std::move(frame), built - start, wall_ms() - built};
  }
  static TimedFrame many(const Job& job, const RenderOptions& options, int repeat,
                         std::vector<double>& frame_ms, std::vector<double>& cpu) {
    const double start = wall_ms();
    const auto prepared = prepare(job.scene, options.threads);
    TimedFrame out;
    out.build_ms = wall_ms() - start;
    out.frame = repeat_frames(job, repeat, frame_ms, cpu,
                              [&](const Camera& camera) { return render(*prepared, camera, options); });
    return out;
  }
};

template <auto render>
struct Reference {
  static TimedFrame once(const Job& job, const Camera& camera, const RenderOptions& options) {
    const double start = wall_ms();
    Frame frame = render(job.scene, camera, options);
    return {std::move(frame), 0, wall_ms() - start};
  }
  static TimedFrame many(const Job& job, const RenderOptions& options, int repeat,
                         std::vector<double>& frame_ms, std::vector<double>& cpu) {
    TimedFrame out;
    out.frame = repeat_frames(job, repeat, frame_ms, cpu,
                              [&](const Camera& camera) { return render(job.scene, camera, options); });
    return out;
  }
};

struct PreparedBoth {
  std::shared_ptr<const raster::Prepared> finds;
  std::shared_ptr<const raytrace::Prepared> traces;
};
std::shared_ptr<const PreparedBoth> prepare_both(const Scene& scene, int threads) {
  return std::make_shared<const PreparedBoth>(
      PreparedBoth{raster::prepare(scene, threads), raytrace::prepare(scene, threads)});
}
Frame render_both(const PreparedBoth& prepared, const Camera& camera, const RenderOptions& options) {
  return render_from_raster(*prepared.finds, *prepared.traces, camera, options);
}

using Raster = Fast<raster::prepare, raster::render>;
using Raytrace = Fast<raytrace::prepare, raytrace::render>;
using RaytraceFromRaster = Fast<prepare_both, render_both>;
using RasterReference = Reference<raster::render_reference>;
using RaytraceReference = Reference<raytrace::render_reference>;

}  // namespace

const std::array<Renderer, 4> kRenderers{{
    {"raster", "z-buffer", kRasterLayers | layer_bit(Layer::cost), Raster::once, Raster::many},
    {"raytrace", "ray tracer", kAllLayers, Raytrace::once, Raytrace::many},
    {"raster-reference", "z-buffer, reference", kRasterLayers, RasterReference::once, RasterReference::many},
    {"raytrace-reference", "ray tracer, reference", kRaytraceLayers, RaytraceReference::once,
     RaytraceReference::many},
}};

const Renderer kRaytraceFromRaster{"raytrace", "ray tracer, from the z-buffer", kRaytraceLayers,
                                   RaytraceFromRaster::once, RaytraceFromRaster::many};

const Renderer* find_renderer(std::string_view name) {
  const auto at =
      std::find_if(kRenderers.begin(), kRenderers.end(), [&](const Renderer& r) { return r.name == name; });
  return at == kRenderers.end() ? nullptr : &*at;
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
  TimedFrame timed = renderer.render(job, job.camera, options);
  check_finite(timed.frame, renderer.label);
  if ((renderer.layers & kCost) == 0) return timed;
  // What a pixel costs is counted by the renderers' readable paths: apart, so that times are those of the fast ones.
  options.layers = kCost;
  options.keep_samples = false;
  options.progress = {};
  timed.frame.cost = renderer.render(job, job.camera, options).frame.cost;
  return timed;
}

}  // namespace sidelight
