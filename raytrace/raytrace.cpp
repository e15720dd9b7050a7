// SPDX-License-Identifier: MIT
// The ray tracer: pixel order. For each sample its eye ray, and what the recursion brings back along it: tile by tile in
// waves, or, for what those do not do, sample by sample.
#include "raytrace/raytrace.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "common/float_state.h"
#include "common/parallel.h"
#include "common/picture/pixel.h"
#include "raytrace/wave.h"
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
void trace_row(const Prepared& prepared, const Camera& camera, const Media& eye_media,
               const RenderOptions& options, int y, Frame& frame, RenderStats& stats,
               std::vector<double>& cut) {
  NoRecorder<Real> nothing;
  Whitted<Real, NoRecorder<Real>> whitted(prepared, stats, nothing, options.faults, options.isa);
  write_row(frame, camera.depth_scale(), y, [&](int X, int Y) {
    ++stats.rays.primary;
    const std::uint64_t tests_before = stats.visibility.tests;
    const Traced<Real> traced = whitted.trace(eye_path(camera, eye_media, X, Y));
    if (!cut.empty()) cut[frame.index(X / camera.n, y)] += traced.cut_weight;
    Sample sample = to_sample(traced);
    sample.tests = stats.visibility.tests - tests_before;
    return sample;
  });
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

constexpr int kWaveSamples = 32;  // along the edge of a tile: enough to fill lanes, few enough for the cache

// part(index, thread, statistics) of each, with the statistics of each apart, so that their sums do not depend on which
// thread did what.
template <class Part>
void trace_parts(int size, const RenderOptions& options, RenderStats& sum, const Part& part) {
  std::vector<RenderStats> stats(static_cast<std::size_t>(size));
  for_each_part(options, size,
                [&](int index, int thread) { part(index, thread, stats[static_cast<std::size_t>(index)]); });
  for (const RenderStats& s : stats) sum.add_counts(s);
}

void trace_in_waves(const Prepared& prepared, const Camera& camera, const Media& eye_media,
                    const RenderOptions& options, Frame& frame, std::vector<double>& cut) {
  const int edge = std::max(1, std::min(options.tile, (kWaveSamples + camera.n - 1) / camera.n));
  const TileGrid grid{frame.window, edge};
  Clearings clearings(prepared);
  std::vector<std::unique_ptr<Wave>> waves(static_cast<std::size_t>(thread_count(options.threads)));
  trace_parts(grid.count(), options, frame.stats, [&](int tile, int thread, RenderStats& stats) {
    std::unique_ptr<Wave>& wave = waves[static_cast<std::size_t>(thread)];
    if (!wave) wave = std::make_unique<Wave>(prepared, camera, eye_media, options, clearings);
    wave->trace(grid.tile(tile), stats);
    wave->write(frame, cut);
  });
}

template <class Real>
Frame render_in(const Prepared& prepared, const Camera& camera, const RenderOptions& options, bool in_waves) {
  const StandardFloatState nearest_and_denormals;
  const bool secondary = prepared.needs.secondary_rays();
  constexpr LayerMask kBySecondary = layer_bit(Layer::reflection) | layer_bit(Layer::refraction);
  const LayerMask written = secondary ? kRaytraceLayers : kRaytraceLayers & ~kBySecondary;
  Frame frame = in_waves ? make_frame_to_write(camera.width, camera.height, camera.n, options, written)
                         : make_frame(camera.width, camera.height, camera.n, options);
  const Media eye_media = media_at(prepared, camera.eye);
  // Weights not sent, by pixel, so that their sum does not depend on tiles.
  std::vector<double> cut(secondary ? frame.pixels() : 0);
  if (in_waves)
    trace_in_waves(prepared, camera, eye_media, options, frame, cut);
  else
    trace_parts(frame.height(), options, frame.stats, [&](int row, int, RenderStats& stats) {
      trace_row<Real>(prepared, camera, eye_media, options, frame.window.y0 + row, frame, stats, cut);
    });
  for (const double weight : cut) frame.stats.cut_weight += weight;
  frame.stats.cut_weight /= static_cast<double>(frame.pixels()) * camera.n * camera.n;
  return frame;
}

}  // namespace

Frame render(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  const bool in_waves = !options.faults.shadow_offset && !options.faults.float_precision &&
                        (options.layers & layer_bit(Layer::cost)) == 0;
  if (options.primary && !in_waves)
    throw UsageError("surfaces found by another renderer go with no faults and no layer cost");
  return render_in<float>(prepared, camera, options, in_waves);
}
Frame render_in_double(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  return render_in<double>(prepared, camera, options, false);
}

Frame render_recursively(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  return render_in<float>(prepared, camera, options, false);
}

RayRecord explain(const Prepared& prepared, const Camera& camera, int X, int Y) {
  ExplainBudget all{std::numeric_limits<std::size_t>::max()};
  return explain(prepared, camera, X, Y, all);
}

RayRecord explain(const Prepared& prepared, const Camera& camera, int X, int Y, ExplainBudget& budget) {
  const StandardFloatState nearest_and_denormals;
  RenderStats stats;
  TreeRecorder recorder(budget);
  Whitted<float, TreeRecorder> whitted(prepared, stats, recorder);
  whitted.trace(eye_path(camera, media_at(prepared, camera.eye), X, Y));
  return recorder.root();
}

}  // namespace sidelight::raytrace
