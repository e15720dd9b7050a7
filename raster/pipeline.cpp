// SPDX-License-Identifier: MIT
// The z-buffer renderer, stage by stage: bin the primitives, then for each tile draw them into its z-buffer, and shade
// what is visible once. Object order: the z-buffer never asks what else a ray might meet.
#include <algorithm>
#include <vector>

#include "common/clock.h"
#include "common/float_state.h"
#include "common/parallel.h"
#include "raster/faulty_tile.h"
#include "raster/prepared.h"
#include "raster/resolve.h"
#include "raster/snap.h"
#include "raster/tile.h"
#include "raster/visible_bins.h"

namespace sidelight::raster {

std::shared_ptr<const Prepared> prepare(const Scene& scene, int) {
  return prepare_for(needs_of(scene), scene);
}
std::shared_ptr<const Prepared> prepare_for(const Needs& needs, const Scene& scene) {
  const StandardFloatState nearest_and_denormals;
  return std::make_shared<const Prepared>(scene, needs);
}

namespace {

// The same with the vertices on the grid, and that fault done with.
Frame render_snapped(const Prepared& prepared, const Camera& camera, RenderOptions options) {
  const Scene scene = snapped(prepared.scene, camera, *options.faults.snap_bits);
  options.faults.snap_bits.reset();
  return render(*prepare(scene), camera, options);
}

constexpr int kTileSamples = 96;  // along the edge of a tile, at most: its z-buffer stays in the second cache

int tile_edge(const RenderOptions& options, int n) {
  return std::max(1, std::min(options.tile, kTileSamples / n));
}

struct Job {
  const Prepared& prepared;
  const Camera& camera;
  const RenderOptions& options;
  TileGrid grid;
  int threads;
};

// What each thread counts as it goes, in lines of the cache that no other writes to.
struct alignas(64) ThreadCounts {
  VisibilityCounts visibility;
};
struct alignas(64) ThreadTimes {
  double draw_ms = 0, shade_ms = 0;
};

// shade_tile(tile, thread, resolve, counts) for every tile of the picture.
template <class ShadeTile>
void for_each_tile(const Job& job, Frame& frame, const ShadeTile& shade_tile) {
  const RenderOptions& options = job.options;
  const auto threads = static_cast<std::size_t>(job.threads);
  std::vector<ThreadCounts> counts(threads);
  std::vector<TileResolve> resolves;
  resolves.reserve(threads);
  while (resolves.size() < threads) resolves.emplace_back(job.prepared, job.camera, options);
  for_each_part(options, job.grid.count(), [&](int tile, int thread) {
    TileResolve& resolve = resolves[static_cast<std::size_t>(thread)];
    shade_tile(tile, thread, resolve, counts[static_cast<std::size_t>(thread)].visibility);
  });
  for (const ThreadCounts& of_thread : counts)
    frame.stats.add_counts({.rays = {}, .visibility = of_thread.visibility, .stages = {}});
}

void render_fast(const Job& job, Frame& frame) {
  const Scene& scene = job.prepared.scene;
  const VisibleBins bins(job.prepared, job.camera, job.grid, job.options.isa, job.threads);
  const auto threads = static_cast<std::size_t>(job.threads);
  std::vector<VisibleTile> tiles(threads);
  std::vector<ThreadTimes> times(threads);
  for_each_tile(job, frame, [&](int tile, int thread, TileResolve& resolve, VisibilityCounts& counts) {
    const Rect pixels = job.grid.tile(tile);
    VisibleTile& visible = tiles[static_cast<std::size_t>(thread)];
    ThreadTimes& spent = times[static_cast<std::size_t>(thread)];
    LapClock clock;
    const SampleBox samples = samples_of(pixels, job.camera.n);
    if (bins.empty(tile)) {
      resolve.shade_background(pixels);
    } else if (const std::uint32_t wall = bins.wall(samples, tile, counts); wall != kNone) {
      spent.draw_ms += clock.lap_ms();
      resolve.shade_wall(pixels, wall, frame, counts);
    } else {
      const TileView view = visible.clear(scene, job.camera, samples, counts);
      bins.draw(view, tile);
      spent.draw_ms += clock.lap_ms();
      resolve.shade(pixels, visible.primitives(view), frame, counts);
    }
    resolve.write(frame);
    spent.shade_ms += clock.lap_ms();
  });

  std::array<StageTime, 4> stages{{{"project"}, {"set_up"}, {"draw"}, {"shade"}}};
  for (const ThreadBins& of_thread : bins.threads()) {
    frame.stats.add_counts({.rays = {}, .visibility = of_thread.counts, .stages = {}});
    stages[0].ms += of_thread.project_ms;
    stages[1].ms += of_thread.set_up_ms;
  }
  for (const ThreadTimes& of_thread : times) {
    stages[2].ms += of_thread.draw_ms;
    stages[3].ms += of_thread.shade_ms;
  }
  frame.stats.stages.assign(stages.begin(), stages.end());
}

// Of each tile, ascending: the primitives that may show in it.
std::vector<std::vector<std::uint32_t>> bin_primitives(const Job& job) {
  const Scene& scene = job.prepared.scene;
  const SampleBox window = samples_of(job.grid.window, job.camera.n);
  std::vector<SampleBox> boxes(scene.primitive_object.size());
  parallel_blocks(boxes.size(), job.threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      boxes[i] = intersection(box_of_primitive(scene, job.camera, static_cast<std::uint32_t>(i)), window);
  });
  std::vector<std::vector<std::uint32_t>> bins(static_cast<std::size_t>(job.grid.count()));
  const int tile = job.camera.n * job.grid.edge;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const SampleBox& box = boxes[i];
    if (box.empty()) continue;
    for (int row = (box.y0 - window.y0) / tile; row <= (box.y1 - 1 - window.y0) / tile; ++row)
      for (int column = (box.x0 - window.x0) / tile; column <= (box.x1 - 1 - window.x0) / tile; ++column)
        bins[static_cast<std::size_t>(row * job.grid.columns() + column)].push_back(
            static_cast<std::uint32_t>(i));
  }
  return bins;
}

// With the z-buffer that a student reads, which also has the faults and counts each pixel's tests.
void render_readable(const Job& job, Frame& frame) {
  const Scene& scene = job.prepared.scene;
  const Faults& faults = job.options.faults;
  const auto bins = bin_primitives(job);
  for_each_tile(job, frame, [&](int tile, int, TileResolve& resolve, VisibilityCounts& counts) {
    const Rect pixels = job.grid.tile(tile);
    const auto draw_and_shade = [&](auto&& depth) {
      for (const std::uint32_t primitive : bins[static_cast<std::size_t>(tile)])
        depth.draw(scene, primitive, counts);
      resolve.shade_hits(pixels, depth, counts);
      resolve.write(frame);
    };
    NoFragments nothing;
    if (faults.depth_format || faults.float_precision)
      draw_and_shade(FaultyTile(job.camera, pixels, faults));
    else
      draw_and_shade(DepthTile(job.camera, pixels, nothing, !frame.cost.empty()));
  });
}

}  // namespace

Frame render(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  const StandardFloatState nearest_and_denormals;
  if (options.faults.snap_bits) return render_snapped(prepared, camera, options);
  Frame frame = make_frame_to_write(camera.width, camera.height, camera.n, options, kRasterLayers);
  const Job job{
      prepared, camera, options, {frame.window, tile_edge(options, camera.n)}, thread_count(options.threads)};
  if (options.faults.depth_format || options.faults.float_precision || !frame.cost.empty())
    render_readable(job, frame);
  else
    render_fast(job, frame);
  return frame;
}

RasterRecord explain(const Prepared& prepared, const Camera& camera, int X, int Y) {
  const StandardFloatState nearest_and_denormals;
  const Scene& scene = prepared.scene;
  const int n = camera.n, x = X / n, y = Y / n;
  const Rect pixel{x, y, x + 1, y + 1};
  VisibilityCounts counts;
  FragmentsOfSample fragments{X, Y};
  DepthTile depth(camera, pixel, fragments);
  for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive)
    depth.draw(scene, primitive, counts);
  RenderOptions options;
  TileResolve resolve(prepared, camera, options);
  resolve.shade_hits(pixel, depth, counts);

  RasterRecord record;
  record.fragments = std::move(fragments.fragments);
  record.color = resolve.color(X, Y);
  if (const Hit& hit = depth.at(X, Y); hit.found()) {
    record.background = false;
    const Ray ray{camera.eye, camera.direction(X, Y)};
    record.local = record_local(scene, prepared.tables, ray, hit, counts);
  }
  return record;
}

}  // namespace sidelight::raster
