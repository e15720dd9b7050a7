// SPDX-License-Identifier: MIT
#include "raster/visible_tile.h"

#include <algorithm>

#include "raster/screen_triangle.h"
#include "raster/setup.h"

namespace sidelight::raster {
namespace {

// intersect(), whose test is counted where the primitive is set up.
Hit hit_at(const TileView& tile, std::uint32_t primitive, int X, int Y, SignCounts& counts) {
  const Hit hit =
      intersect(tile.scene, primitive, {tile.camera.eye, tile.camera.direction(X, Y)}, kRayStart, counts);
  --counts.tests;
  return hit;
}

// Keeps a hit that was found exactly where it comes before what the sample holds.
void keep_exactly(const TileView& tile, int X, int Y, const Hit& hit) {
  const auto i = static_cast<std::size_t>(tile.index(X, Y));
  const float w = static_cast<float>(1 / hit.t), held = tile.w[i];
  if (w * kSurely < held) return;
  if (tile.primitive[i] != kNone && !(w > held * kSurely)) {
    SignCounts not_counted;  // it was when it was drawn
    if (!before(hit, hit_at(tile, tile.primitive[i], X, Y, not_counted))) return;
  }
  tile.w[i] = w;
  tile.primitive[i] = hit.primitive;
}

}  // namespace

void draw_exactly(const TileView& tile, std::uint32_t primitive, int X, int Y, int filtered) {
  tile.counts.filtered -= static_cast<std::uint64_t>(filtered);
  const Hit hit = hit_at(tile, primitive, X, Y, tile.counts);
  if (!hit.found()) return;
  ++tile.counts.fragments;
  keep_exactly(tile, X, Y, hit);
}

void order_exactly(const TileView& tile, std::uint32_t primitive, int X, int Y) {
  SignCounts not_counted;  // the signs are, and so is the fragment
  keep_exactly(tile, X, Y, hit_at(tile, primitive, X, Y, not_counted));
}

TileView VisibleTile::clear(const Scene& scene, const Camera& camera, const SampleBox& samples,
                            SignCounts& counts) {
  const int columns = samples.x1 - samples.x0, rows = samples.y1 - samples.y0;
  const int block_columns = (columns + TileView::kBlockColumns - 1) / TileView::kBlockColumns;
  const int block_rows = (rows + TileView::kBlockRows - 1) / TileView::kBlockRows;
  const auto size =
      static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) + TileView::kBlockColumns;
  w_.assign(size, 0.0f);
  primitive_.assign(size, kNone);
  farthest_.assign(static_cast<std::size_t>(block_columns) * static_cast<std::size_t>(block_rows), 0.0f);
  return {scene,           camera, counts, samples, columns, block_columns, w_.data(), primitive_.data(),
          farthest_.data()};
}

void draw_fragments(const TileView& tile, const std::vector<ScreenFragment>& fragments) {
  for (const ScreenFragment& fragment : fragments) {
    const auto i = static_cast<std::size_t>(tile.index(fragment.X, fragment.Y));
    const float held = tile.w[i];
    if (fragment.w > held * kSurely) {
      tile.w[i] = fragment.w;
      tile.primitive[i] = fragment.primitive;
    } else if (fragment.w == 0 || !(fragment.w * kSurely < held)) {
      order_exactly(tile, fragment.primitive, fragment.X, fragment.Y);
    }
  }
}

// Solved at each sample it may cover.
void draw_sphere(const TileView& tile, std::uint32_t primitive, const SampleBox& box) {
  const SampleBox inside = intersection(box, tile.box);
  for (int Y = inside.y0; Y < inside.y1; ++Y)
    for (int X = inside.x0; X < inside.x1; ++X) {
      const Hit hit = hit_at(tile, primitive, X, Y, tile.counts);
      if (!hit.found()) continue;
      ++tile.counts.fragments;
      keep_exactly(tile, X, Y, hit);
    }
}

}  // namespace sidelight::raster
