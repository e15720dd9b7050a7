// SPDX-License-Identifier: MIT
#include "raster/visible_tile.h"

#include <algorithm>
#include <limits>

#include "raster/screen_triangle.h"
#include "raster/setup.h"

namespace sidelight::raster {
namespace {

// intersect(), whose test is counted where the primitive is set up.
Hit hit_at(const TileView& tile, std::uint32_t primitive, int X, int Y, VisibilityCounts& counts) {
  const Hit hit =
      intersect(tile.scene, primitive, {tile.camera.eye, tile.camera.direction(X, Y)}, kRayStart, counts);
  --counts.tests;
  return hit;
}

// Keeps a hit that was found exactly where it comes before what the sample holds.
void keep_exactly(const TileView& tile, int X, int Y, const Hit& hit, float w) {
  const auto i = static_cast<std::size_t>(tile.index(X, Y));
  const float held = tile.w[i];
  if (w * kSurely < held) return;
  if (tile.primitive[i] != kNone && !(w > held * kSurely)) {
    VisibilityCounts not_counted;  // it was when it was drawn
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
  keep_exactly(tile, X, Y, hit, static_cast<float>(1 / hit.t));
}

void order_exactly(const TileView& tile, std::uint32_t primitive, int X, int Y, float w) {
  VisibilityCounts not_counted;  // the signs are, and so is the fragment
  const Hit hit = hit_at(tile, primitive, X, Y, not_counted);
  keep_exactly(tile, X, Y, hit, w > 0 ? w : static_cast<float>(1 / hit.t));
}

TileView VisibleTile::clear(const Scene& scene, const Camera& camera, const SampleBox& samples,
                            VisibilityCounts& counts) {
  constexpr int kColumns = TileView::kBlockColumns, kRows = TileView::kBlockRows;
  const int columns = samples.x1 - samples.x0, rows = samples.y1 - samples.y0;
  const int block_columns = (columns + kColumns - 1) / kColumns, block_rows = (rows + kRows - 1) / kRows;
  const auto blocks = static_cast<std::size_t>(block_columns) * static_cast<std::size_t>(block_rows);
  w_.assign(blocks * TileView::kBlock, 0.0f);
  primitive_.assign(blocks * TileView::kBlock, kNone);
  farthest_.assign(blocks, 0.0f);
  const TileView tile{scene,           camera, counts, samples, block_columns, w_.data(), primitive_.data(),
                      farthest_.data()};
  for (int y = 0; y < block_rows * kRows; ++y)
    for (int x = y < rows ? columns : 0; x < block_columns * kColumns; ++x)
      tile.w[tile.index(samples.x0 + x, samples.y0 + y)] = std::numeric_limits<float>::infinity();
  return tile;
}

// Whole rows of blocks: what that writes beyond the end of a row of samples the next row replaces.
const std::uint32_t* VisibleTile::primitives(const TileView& tile) {
  constexpr int kStamp = TileView::kStamp, kBlockColumns = TileView::kBlockColumns;
  const int columns = tile.box.x1 - tile.box.x0, rows = tile.box.y1 - tile.box.y0;
  rows_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) + kBlockColumns);
  std::uint32_t* to = rows_.data();
  for (int y = 0; y < rows; ++y, to += columns) {
    const std::uint32_t* from = tile.primitive + tile.index(tile.box.x0, tile.box.y0 + y);
    for (int x = 0; x < columns; x += kBlockColumns, from += TileView::kBlock)
      for (int i = 0; i < kBlockColumns; i += kStamp) store_four(load_four(from + i * kStamp), to + x + i);
  }
  return rows_.data();
}

void draw_fragments(const TileView& tile, const std::vector<ScreenFragment>& fragments) {
  for (const ScreenFragment& fragment : fragments) {
    const auto i = static_cast<std::size_t>(tile.index(fragment.X, fragment.Y));
    const float held = tile.w[i];
    if (fragment.w > held * kSurely) {
      tile.w[i] = fragment.w;
      tile.primitive[i] = fragment.primitive;
    } else if (fragment.w == 0 || !(fragment.w * kSurely < held)) {
      order_exactly(tile, fragment.primitive, fragment.X, fragment.Y, fragment.w);
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
      keep_exactly(tile, X, Y, hit, static_cast<float>(1 / hit.t));
    }
}

}  // namespace sidelight::raster
