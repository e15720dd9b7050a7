// SPDX-License-Identifier: MIT
// The z-buffer renderer, stage by stage: bin the primitives, then for each tile draw them into its z-buffer, and shade
// what is visible once. Object order: the z-buffer never asks what else a ray might meet.
#include <vector>

#include "common/float_state.h"
#include "common/parallel.h"
#include "raster/bins.h"
#include "raster/faulty_tile.h"
#include "raster/prepared.h"
#include "raster/resolve.h"
#include "raster/snap.h"
#include "raster/tile.h"
#include "raster/visible_bins.h"

namespace sidelight::raster {
std::shared_ptr<const Prepared> prepare(const Scene& scene, int) { return prepare_for(needs_of(scene), scene); }
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

// A tile's visible primitives as hits.
struct VisibleHits {
  const TileView& tile;

  Hit at(int X, int Y) const {
    const std::uint32_t primitive = tile.primitive[tile.index(X, Y)];
    if (primitive == kNone) return {};
    SignCounts not_counted;
    return intersect(tile.scene, primitive, {tile.camera.eye, tile.camera.direction(X, Y)}, kRayStart, not_counted);
  }
  std::uint32_t tests(int, int) const { return 0; }
};

}  // namespace

Frame render(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  const StandardFloatState nearest_and_denormals;
  if (options.faults.snap_bits) return render_snapped(prepared, camera, options);
  Frame frame = make_frame(camera.width, camera.height, camera.n, options);
  const TileGrid grid{frame.window, options.tile};
  const int threads = thread_count(options.threads);
  std::vector<RenderStats> stats(static_cast<std::size_t>(threads));
  std::atomic<int> done{0};

  // Faults and the count of each pixel's tests are for the readable twin.
  if (!(options.faults.depth_format || options.faults.float_precision || !frame.cost.empty())) {
    const VisibleBins bins(prepared.scene, camera, grid, options.isa, threads);
    std::vector<VisibleTile> tiles(static_cast<std::size_t>(threads));
    parallel_for(grid.count(), threads, [&](int tile, int thread) {
      if (options.cancel && *options.cancel) throw Interrupted();
      SignCounts& counts = stats[static_cast<std::size_t>(thread)].signs;
      const Rect pixels = grid.tile(tile);
      VisibleTile& visible = tiles[static_cast<std::size_t>(thread)];
      const TileView view = visible.clear(prepared.scene, camera, TileGrid{pixels}.samples(camera.n), counts);
      bins.draw(view, tile);
      TileResolve resolve(prepared, camera, options.isa, pixels);
      resolve.shade(VisibleHits{view}, counts);
      resolve.write(frame);
      if (options.progress) options.progress(static_cast<double>(++done) / grid.count());
    });
    for (std::size_t t = 0; t < stats.size(); ++t) {
      frame.stats.add_counts(stats[t]);
      frame.stats.add_counts({.rays = {}, .signs = bins.threads()[t].counts});
    }
    return frame;
  }

  const Bins bins = bin_primitives(prepared.scene, camera, grid, threads);
  std::vector<TileResolve> resolves(static_cast<std::size_t>(threads), {prepared, camera, options});
  const auto draw_and_shade = [&](auto& depth, int tile, int thread) {
    SignCounts& counts = stats[static_cast<std::size_t>(thread)].signs;
    bins.for_each(tile, [&](std::uint32_t primitive) { depth.draw(prepared.scene, primitive, counts); });
    TileResolve& resolve = resolves[static_cast<std::size_t>(thread)];
    resolve.shade_hits(grid.tile(tile), depth, counts);
    resolve.write(frame);
  };
  parallel_for(grid.count(), threads, [&](int tile, int thread) {
    if (options.cancel && *options.cancel) throw Interrupted();
    if (options.faults.depth_format || options.faults.float_precision) {
      FaultyTile depth(camera, grid.tile(tile), options.faults);
      draw_and_shade(depth, tile, thread);
    } else {
      NoFragments nothing;
      DepthTile depth(camera, grid.tile(tile), nothing, !frame.cost.empty());
      draw_and_shade(depth, tile, thread);
    }
    if (options.progress) options.progress(static_cast<double>(++done) / grid.count());
  });

  for (const RenderStats& s : stats) frame.stats.add_counts(s);
  return frame;
}

RasterRecord explain(const Prepared& prepared, const Camera& camera, int X, int Y) {
  const StandardFloatState nearest_and_denormals;
  const Scene& scene = prepared.scene;
  const int n = camera.n, x = X / n, y = Y / n;
  const Rect pixel{x, y, x + 1, y + 1};
  SignCounts counts;
  FragmentsOfSample fragments{X, Y};
  DepthTile depth(camera, pixel, fragments);
  for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive)
    depth.draw(scene, primitive, counts);
  TileResolve resolve(prepared, camera, RenderOptions{});
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
