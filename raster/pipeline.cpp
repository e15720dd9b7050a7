// SPDX-License-Identifier: MIT
// The z-buffer renderer, stage by stage: bin the primitives, then for each tile draw them into its z-buffer, and shade
// what is visible once. Object order: the z-buffer never asks what else a ray might meet.
#include <vector>

#include "common/float_state.h"
#include "common/parallel.h"
#include "raster/bins.h"
#include "raster/prepared.h"
#include "raster/resolve.h"
#include "raster/tile.h"

namespace sidelight::raster {
std::shared_ptr<const Prepared> prepare(const Scene& scene, int) { return prepare_for(needs_of(scene), scene); }
std::shared_ptr<const Prepared> prepare_for(const Needs& needs, const Scene& scene) {
  const StandardFloatState nearest_and_denormals;
  return std::make_shared<const Prepared>(scene, needs);
}

Frame render(const Prepared& prepared, const Camera& camera, const RenderOptions& options) {
  const StandardFloatState nearest_and_denormals;
  Frame frame = make_frame(camera.width, camera.height, camera.n, options);
  const TileGrid grid{frame.window, options.tile};
  const int threads = thread_count(options.threads);
  std::vector<RenderStats> stats(static_cast<std::size_t>(threads));
  std::atomic<int> done{0};

  const Bins bins = bin_primitives(prepared.scene, camera, grid, threads);
  parallel_for(grid.count(), threads, [&](int tile, int thread) {
    if (options.cancel && *options.cancel) throw Interrupted();
    SignCounts& counts = stats[static_cast<std::size_t>(thread)].signs;
    NoFragments nothing;
    DepthTile depth(camera, grid.tile(tile), nothing, !frame.cost.empty());
    bins.for_each(tile, [&](std::uint32_t primitive) { depth.draw(prepared.scene, primitive, counts); });
    TileResolve resolve(prepared, camera, options.isa, grid.tile(tile));
    resolve.shade(depth, counts);
    resolve.write(frame);
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
  TileResolve resolve(prepared, camera, best_isa(), pixel);
  resolve.shade(depth, counts);

  RasterRecord record;
  record.fragments = std::move(fragments.fragments);
  record.color = resolve.sample(X, Y).color;
  if (const Hit& hit = depth.at(X, Y); hit.found()) {
    record.background = false;
    const Ray ray{camera.eye, camera.direction(X, Y)};
    record.local = record_local(scene, prepared.tables, ray, hit, counts);
  }
  return record;
}

}  // namespace sidelight::raster
