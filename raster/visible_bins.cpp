// SPDX-License-Identifier: MIT
#include "raster/visible_bins.h"

#include <algorithm>

#include "common/clock.h"
#include "common/parallel.h"
#include "raster/setup.h"

namespace sidelight::raster {
namespace {

constexpr std::uint32_t kBatch = 4 * TriangleChunk::kSize;  // triangles handed to a thread at a time
constexpr std::uint32_t kVertexBatch = 4096;

// Of each sample of a row, or of a column: which tile it is in, times `step`.
std::vector<std::uint32_t> tiles_of_samples(int samples, int edge, int step) {
  std::vector<std::uint32_t> tiles(static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i)
    tiles[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(i / edge * step);
  return tiles;
}

std::uint64_t area(const SampleBox& box) {
  return static_cast<std::uint64_t>(box.x1 - box.x0) * static_cast<std::uint64_t>(box.y1 - box.y0);
}

}  // namespace

struct VisibleBins::Workshop {
  TriangleChunk chunk{};
  TinyFragments tiny{};
  // Places in the chunk of what is left for the tiles; written one beyond its end.
  std::array<std::uint32_t, TriangleChunk::kSize + 1> queue{};
};

VisibleBins::VisibleBins(const Prepared& prepared, const Camera& camera, const TileGrid& grid, Isa isa,
                         int threads)
    : scene_(prepared.scene),
      corners_(prepared.corners.data()),
      kept_(prepared.bins),
      camera_(camera),
      kernels_(kernels_for(isa)),
      space_(camera),
      sheet_(lattice_sheet(camera)),
      window_(samples_of(grid.window, camera.n)),
      tile_columns_(tiles_of_samples(window_.x1 - window_.x0, camera.n * grid.edge, 1)),
      tile_rows_(tiles_of_samples(window_.y1 - window_.y0, camera.n * grid.edge, grid.columns())),
      tiles_in_row_(static_cast<std::size_t>(grid.columns())),
      vertices_(scene_.positions.size()),
      threads_(kept_.take(threads, grid.count())) {
  const auto vertices = static_cast<std::uint32_t>(scene_.positions.size());
  parallel_for(static_cast<int>((vertices + kVertexBatch - 1) / kVertexBatch), threads,
               [&](int item, int thread) {
                 LapClock clock;
                 const std::uint32_t first = static_cast<std::uint32_t>(item) * kVertexBatch;
                 kernels_.project(space_, &scene_.positions[first], &vertices_[first],
                                  static_cast<int>(std::min(kVertexBatch, vertices - first)));
                 threads_[static_cast<std::size_t>(thread)].project_ms += clock.lap_ms();
               });

  std::vector<std::unique_ptr<Workshop>> shops(threads_.size());
  const std::vector<Batch> work = batches();
  parallel_for(static_cast<int>(work.size()), threads, [&](int item, int thread) {
    LapClock clock;
    const auto t = static_cast<std::size_t>(thread);
    if (!shops[t]) shops[t] = std::make_unique<Workshop>();
    set_up_triangles(work[static_cast<std::size_t>(item)], *shops[t], threads_[t]);
    threads_[t].set_up_ms += clock.lap_ms();
  });
  LapClock clock;
  for (const Object& object : scene_.objects)
    if (object.kind != ObjectKind::mesh) set_up_other(object.first_primitive, threads_[0]);
  threads_[0].set_up_ms += clock.lap_ms();
}

std::vector<VisibleBins::Batch> VisibleBins::batches() const {
  std::vector<Batch> batches;
  for (const Object& object : scene_.objects) {
    if (object.kind != ObjectKind::mesh) continue;
    for (std::uint32_t done = 0; done < object.count; done += kBatch)
      batches.push_back(
          {object.first + done, object.first_primitive + done, std::min(kBatch, object.count - done)});
  }
  return batches;
}

// The records of four vertices become four x, four y, four w and four states; beyond the last triangle's, any.
void VisibleBins::load_chunk(const Corners3* corners, TriangleChunk& chunk) const {
  const auto record = [&](std::size_t triangle, std::size_t k) {
    return load_four(&vertices_[corners[triangle][k]]);
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(chunk.size); i += 4)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [x, y, w, state] =
          transposed(record(i, k), record(i + 1, k), record(i + 2, k), record(i + 3, k));
      store_four(x, &chunk.x[k][i]);
      store_four(y, &chunk.y[k][i]);
      store_four(w, &chunk.w[k][i]);
      store_four(state, &chunk.state[k][i]);
    }
}

void VisibleBins::set_up_triangles(const Batch& batch, Workshop& shop, ThreadBins& bins) const {
  TriangleChunk& chunk = shop.chunk;
  for (std::uint32_t done = 0; done < batch.size; done += TriangleChunk::kSize) {
    chunk.size = static_cast<int>(std::min<std::uint32_t>(TriangleChunk::kSize, batch.size - done));
    load_chunk(corners_ + batch.first_triangle + done, chunk);
    set_up_chunk(shop, batch.first_triangle + done, batch.first_primitive + done, bins);
  }
}

void VisibleBins::set_up_chunk(Workshop& shop, std::uint32_t first_triangle, std::uint32_t first_primitive,
                               ThreadBins& bins) const {
  TriangleChunk& chunk = shop.chunk;
  kernels_.set_up(space_, window_, chunk, shop.tiny);
  collect_fragments(shop.tiny, first_primitive, bins);
  bins.counts.tests += shop.tiny.tests;
  bins.counts.filtered += 3 * shop.tiny.tests + shop.tiny.triangles;

  // No branch: what becomes of the next triangle is hard to foresee.
  std::size_t size = 0;
  for (std::uint32_t place = 0; place < static_cast<std::uint32_t>(chunk.size); ++place) {
    shop.queue[size] = place;
    size += chunk.kind[place] != TriangleChunk::kNothing;
  }
  for (std::size_t q = 0; q < size; ++q) {
    const std::uint32_t place = shop.queue[q];
    const SampleBox box{chunk.x0[place], chunk.y0[place], chunk.x1[place], chunk.y1[place]};
    const SmallTriangle triangle{first_triangle + place, first_primitive + place};
    const std::int32_t kind = chunk.kind[place];
    if (kind != TriangleChunk::kFront && kind != TriangleChunk::kBack) {
      set_up_in_double(triangle.triangle, triangle.primitive, box, kind == TriangleChunk::kDoubtful, bins);
      continue;
    }
    bins.counts.tests += area(box);
    bins.counts.filtered += 3 * area(box) + 1;  // draw_exactly() takes back what it decides
    if (kind == TriangleChunk::kFront) {
      for_each_bin(bins, box, [&](TileBin& bin) { bin.front.push_back(triangle); });
      continue;
    }
    const float nearest = std::max({chunk.w[0][place], chunk.w[1][place], chunk.w[2][place]});
    for_each_bin(bins, box, [&](TileBin& bin) { bin.add_back(triangle, nearest); });
  }
}

void VisibleBins::collect_fragments(const TinyFragments& tiny, std::uint32_t first_primitive,
                                    ThreadBins& bins) const {
  const auto put = [&](ScreenFragment fragment) {
    bins.tiles[tile_row(fragment.Y) + tile_column(fragment.X)].fragments.push_back(fragment);
  };
  for (std::size_t i = 0; i < tiny.covered; ++i) {
    ScreenFragment fragment = tiny.fragment[i];
    fragment.primitive += first_primitive;
    put(fragment);
  }
  bins.counts.fragments += tiny.covered;
  for (std::size_t i = 0; i < tiny.doubtful; ++i) {
    ScreenFragment fragment = tiny.doubt[i];
    fragment.primitive += first_primitive;
    const Ray ray{camera_.eye, camera_.direction(fragment.X, fragment.Y)};
    const Hit hit = intersect(scene_, fragment.primitive, ray, kRayStart, bins.counts);
    --bins.counts.tests;
    bins.counts.filtered -= 3;
    if (!hit.found()) continue;
    ++bins.counts.fragments;
    fragment.w = static_cast<float>(1 / hit.t);
    put(fragment);
  }
}

// A triangle that floats on the screen cannot tell about: its side decided as visibility.h does.
void VisibleBins::set_up_in_double(std::uint32_t index, std::uint32_t primitive, const SampleBox& places,
                                   bool small, ThreadBins& bins) const {
  const Triangle& triangle = scene_.triangles[index];
  if (triangle.degenerate) return;
  const auto [v0, v1, v2] = corners(scene_, triangle);
  const TriangleView view = view_triangle(camera_.eye, v0, v1, v2);
  const std::array<std::uint32_t, 3>& vertex = triangle.vertex;
  const bool placed =
      ((vertices_[vertex[0]].state | vertices_[vertex[1]].state | vertices_[vertex[2]].state) &
       ScreenSpace::kUnplaced) == 0;
  const SampleBox box = placed ? places : intersection(box_of_points(camera_, view.a), window_);
  if (box.empty()) return;
  const int side = view_side(view, bins.counts);
  if (side == 0) return;  // seen exactly edge-on
  bins.counts.tests += area(box);
  bins.counts.filtered += 3 * area(box);
  const float nearest =
      placed ? std::max({vertices_[vertex[0]].w, vertices_[vertex[1]].w, vertices_[vertex[2]].w})
             : std::numeric_limits<float>::infinity();
  if (small) return for_each_bin(bins, box, [&](TileBin& bin) { bin.add_back({index, primitive}, nearest); });

  LargeSurface surface;
  surface.primitive = primitive;
  surface.box = box;
  surface.nearest = nearest;
  surface.edge = edge_sheets(sheet_, view, side);
  surface.depth = depth_sheet(sheet_, view, depth_plane(view, v0, v1, v2));
  const auto number = static_cast<std::uint32_t>(bins.large.size());
  bins.large.push_back(surface);
  for_each_bin(bins, box, [&](TileBin& bin) { bin.large.push_back(number); });
}

void VisibleBins::set_up_other(std::uint32_t primitive, ThreadBins& bins) const {
  const SampleBox box = intersection(box_of_primitive(scene_, camera_, primitive), window_);
  if (box.empty()) return;
  bins.counts.tests += area(box);
  const PrimitiveRef ref = primitive_ref(scene_, primitive);
  if (ref.kind == ObjectKind::sphere) {
    const auto number = static_cast<std::uint32_t>(bins.spheres.size());
    bins.spheres.push_back({primitive, box});
    return for_each_bin(bins, box, [&](TileBin& bin) { bin.spheres.push_back(number); });
  }
  LargeSurface surface;  // a plane: nearest 0, so that it is drawn last and what stands before it hides it
  surface.primitive = primitive;
  surface.box = box;
  surface.bounded = false;
  surface.depth = depth_sheet(sheet_, scene_.planes[ref.index]);
  if (!surface.depth.sure) return;  // the eye lies in it
  const auto number = static_cast<std::uint32_t>(bins.large.size());
  bins.large.push_back(surface);
  for_each_bin(bins, box, [&](TileBin& bin) { bin.large.push_back(number); });
}

bool VisibleBins::empty(int tile) const {
  return std::all_of(threads_.begin(), threads_.end(), [&](const ThreadBins& bins) {
    return bins.tiles[static_cast<std::size_t>(tile)].empty();
  });
}

// Those of a tile, the near ones before the far.
std::vector<const LargeSurface*> VisibleBins::large_surfaces(int tile) const {
  std::vector<const LargeSurface*> large;
  for (const ThreadBins& bins : threads_)
    for (const std::uint32_t number : bins.tiles[static_cast<std::size_t>(tile)].large)
      large.push_back(&bins.large[number]);
  std::sort(large.begin(), large.end(), [](const LargeSurface* a, const LargeSurface* b) {
    return a->nearest > b->nearest || (a->nearest == b->nearest && a->primitive < b->primitive);
  });
  return large;
}

std::uint32_t VisibleBins::wall(const SampleBox& samples, int tile, VisibilityCounts& counts) const {
  float nearest = 0;
  for (const ThreadBins& bins : threads_) {
    const TileBin& bin = bins.tiles[static_cast<std::size_t>(tile)];
    if (!bin.front.empty() || !bin.fragments.empty() || !bin.spheres.empty()) return kNone;
    nearest = std::max(nearest, bin.nearest_back);
  }
  const LargeSurface* const wall = kernels_.find_wall(samples, large_surfaces(tile), nearest);
  if (!wall) return kNone;
  counts.fragments += area(samples);
  return wall->primitive;
}

// Large surfaces first: they hide whole blocks. Back faces last: where front faces of closed meshes fill a block, they are
// hidden, and where they fill the tile most often all at once.
void VisibleBins::draw(const TileView& view, int tile) const {
  const auto t = static_cast<std::size_t>(tile);
  for (const ThreadBins& bins : threads_)
    for (const std::uint32_t number : bins.tiles[t].spheres)
      draw_sphere(view, bins.spheres[number].primitive, bins.spheres[number].box);
  for (const LargeSurface* surface : large_surfaces(tile)) kernels_.draw_large(view, *surface);
  const auto draw_small = [&](const std::vector<SmallTriangle>& small) {
    kernels_.draw_small(view, space_, vertices_.data(), corners_, small.data(), small.size());
  };
  for (const ThreadBins& bins : threads_) draw_small(bins.tiles[t].front);
  for (const ThreadBins& bins : threads_) draw_fragments(view, bins.tiles[t].fragments);
  const float farthest = kernels_.find_farthest(view);
  for (const ThreadBins& bins : threads_)
    if (!(bins.tiles[t].nearest_back * kSurely < farthest)) draw_small(bins.tiles[t].back);
}

}  // namespace sidelight::raster
