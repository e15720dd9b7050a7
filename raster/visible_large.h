// SPDX-License-Identifier: MIT
// Large surfaces into a tile's z-buffer, block by block; and which of them fill a tile, so that it needs none.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "raster/visible_keep.h"

namespace sidelight::raster {

// An affine function over a block of (columns + 1) x (rows + 1) samples, anchored in double at its first sample and
// stepped in float from there.
// Bound. With M = |value| + columns |x| + rows |y|, value, x and y are rounded to float, their products with whole
// numbers once more, and two sums are made of them: at most 2^-24 (3|value| + 3 columns |x| + 4 rows |y|) <= 2^-22 M.
// Twice that leaves room for low and high.
struct Anchored {
  float value, x, y;
  float bound;      // on the error at any sample of the block
  float low, high;  // bounds of the true values in the block
};

template <class F>
Anchored anchored(const Affine& affine, double error, int X, int Y,
                  float columns = TileView::kBlockColumns - 1, float rows = TileView::kBlockRows - 1) {
  Anchored a;
  a.value = static_cast<float>(affine.at(X, Y));
  a.x = static_cast<float>(affine.x);
  a.y = static_cast<float>(affine.y);
  const float dx = columns * a.x, dy = rows * a.y;
  a.bound =
      0x1p-21f * ((lane_abs(a.value) + lane_abs(dx)) + lane_abs(dy)) + 1.0001f * static_cast<float>(error);
  a.low = a.value + (lane_min(dx, 0.0f) + lane_min(dy, 0.0f)) - a.bound;
  a.high = a.value + (lane_max(dx, 0.0f) + lane_max(dy, 0.0f)) + a.bound;
  return a;
}

// Over all samples of a box.
template <class F>
Anchored anchored(const Affine& affine, double error, const SampleBox& box) {
  return anchored<F>(affine, error, box.x0, box.y0, static_cast<float>(box.x1 - 1 - box.x0),
                     static_cast<float>(box.y1 - 1 - box.y0));
}

template <class F>
SampleBox both(const SampleBox& a, const SampleBox& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

template <class F>
Anchored depth_in(const LargeSurface& surface, const SampleBox& box) {
  return anchored<F>(surface.depth.w, surface.depth.error, box);
}

template <class F>
bool has_sure_depth(const LargeSurface& surface, const Anchored& w) {
  return surface.depth.sure && lane_abs(w.high) < 1e30f && lane_abs(w.low) < 1e30f;
}
template <class F>
bool surely_behind(const LargeSurface& surface, const Anchored& w, float farthest) {
  return has_sure_depth<F>(surface, w) && w.high * kSurely < farthest;
}

// Whether no sample of a box is inside of all edges.
template <class F>
bool surely_beside(const LargeSurface& surface, const SampleBox& box) {
  return surface.bounded && std::ranges::any_of(surface.edge, [&](const EdgeSheet& each) {
           return anchored<F>(each.value, each.error, box).high < 0;
         });
}

// Edges of a surface that some samples may not be inside of.
struct OpenEdges {
  std::array<const EdgeSheet*, 3> edge;
  std::size_t size = 0;
  std::span<const EdgeSheet* const> all() const { return std::span(edge).first(size); }
};

// The block whose first sample is (X0, Y0); `open` in the tile.
template <class F>
void draw_block(const TileView& tile, const LargeSurface& surface, const OpenEdges& open, int X0, int Y0,
                float& farthest) {
  const Anchored w = anchored<F>(surface.depth.w, surface.depth.error, X0, Y0);
  if (surely_behind<F>(surface, w, farthest)) return;  // hidden: all samples hold something nearer
  const bool sure = has_sure_depth<F>(surface, w);

  // Edges that the whole block is inside of need no test; one that it is outside of needs no block.
  std::array<Anchored, 3> edge;
  std::size_t edges = 0;
  for (const EdgeSheet* each : open.all()) {
    edge[edges] = anchored<F>(each->value, each->error, X0, Y0);
    if (edge[edges].high < 0) return;
    edges += !(edge[edges].low > 0);
  }

  // Below `floor` w is not within kFloatDepthError of itself.
  const float floor = sure ? w.bound * (1 / kFloatDepthError) : std::numeric_limits<float>::infinity();
  const F not_sure(std::numeric_limits<float>::quiet_NaN());
  const auto in_block = [&](int place, int first) { return F(static_cast<float>(place - first)); };
  const F x0 = in_block(surface.box.x0, X0), x1 = in_block(std::min(surface.box.x1, tile.box.x1), X0);
  const F y0 = in_block(surface.box.y0, Y0), y1 = in_block(std::min(surface.box.y1, tile.box.y1), Y0);
  F least_held(std::numeric_limits<float>::infinity());
  std::uint64_t fragments = 0;
  for (int j = 0; j < TileView::kBlockRows; j += kVectorRows<F>)
    for (int i = 0; i < TileView::kBlockColumns; i += kVectorColumns<F>) {
      const F column = lane_columns<F>() + F(static_cast<float>(i));
      const F row = lane_rows<F>() + F(static_cast<float>(j));
      const auto value = [&](const Anchored& a) { return (F(a.value) + row * F(a.y)) + column * F(a.x); };
      Mask<F> covered = (row >= y0 && row < y1) && (column >= x0 && column < x1);
      Mask<F> doubtful = covered;
      for (std::size_t k = 0; k < edges; ++k) {
        const F e = value(edge[k]);
        covered = covered && e > F(edge[k].bound);
        doubtful = doubtful && e >= F(-edge[k].bound);
      }
      doubtful = doubtful && !covered;
      const F depth = value(w);
      if (!surface.bounded) {
        // A plane is met where w > 0, surely or not.
        doubtful = covered && lane_abs(depth) <= F(w.bound);
        if (!sure) doubtful = covered;
        covered = covered && !doubtful && depth > F(0);
      }
      const int X = X0 + i, Y = Y0 + j;
      F held;
      const F sure_depth = select<F>(depth > F(floor), depth, not_sure);
      const Mask<F> tied =
          keep_nearer<F>(tile, tile.index(X, Y), surface.primitive, covered, sure_depth, held);
      fragments += static_cast<std::uint64_t>(count<F>(covered));
      if (any<F>(tied || doubtful)) {
        order_lanes_exactly<F>(tile, surface.primitive, X, Y, tied, sure_depth);
        for_each_lane<F>(doubtful, X, Y, [&](int sx, int sy, int) {
          draw_exactly(tile, surface.primitive, sx, sy, surface.bounded ? 3 : 0);
        });
      }
      least_held = lane_min(least_held, held);
    }
  tile.counts.fragments += fragments;
  if (edges > 0) return;
  farthest = least<F>(least_held);
}

// Whether all samples of a box surely meet the surface, w being its depth there.
template <class F>
bool surely_covers(const LargeSurface& surface, const SampleBox& box, const Anchored& w) {
  return has_sure_depth<F>(surface, w) && w.low > 0 &&
         (!surface.bounded || std::ranges::all_of(surface.edge, [&](const EdgeSheet& each) {
           return anchored<F>(each.value, each.error, box).low > 0;
         }));
}

// Of surfaces, near before far, the one that all samples of a box surely meet, surely before the others and before whatever
// is nowhere nearer than `nearest`, by w; null if there is none. (Its least w is no float that was kept, so it is nearer
// to 1/t than kSurely asks.)
template <class F>
[[gnu::flatten]] const LargeSurface* find_wall(const SampleBox& box,
                                               std::span<const LargeSurface* const> surfaces, float nearest) {
  const LargeSurface* wall = nullptr;
  float farthest = 0;  // the wall's least w
  for (const LargeSurface* each : surfaces) {
    const Anchored w = depth_in<F>(*each, both<F>(each->box, box));
    if (wall && surely_behind<F>(*each, w, farthest)) continue;
    if (surely_beside<F>(*each, box)) continue;
    if (wall || !surely_covers<F>(*each, box, w) || !(nearest * kSurely < w.low)) return nullptr;
    wall = each;
    farthest = w.low;
  }
  return wall;
}

template <class F>
[[gnu::flatten]] void draw_large_surface(const TileView& tile, const LargeSurface& surface) {
  const SampleBox box = both<F>(surface.box, tile.box);
  if (box.empty()) return;
  const auto for_each_block = [&](const auto& visit) {
    for (int row = (box.y0 - tile.box.y0) / TileView::kBlockRows;
         tile.box.y0 + row * TileView::kBlockRows < box.y1; ++row)
      for (int column = (box.x0 - tile.box.x0) / TileView::kBlockColumns;
           tile.box.x0 + column * TileView::kBlockColumns < box.x1; ++column)
        visit(tile.box.x0 + column * TileView::kBlockColumns, tile.box.y0 + row * TileView::kBlockRows,
              tile.farthest[row * tile.block_columns + column]);
  };
  // What lies behind all that the tile holds is dropped at once.
  float farthest = std::numeric_limits<float>::infinity();
  for_each_block([&](int, int, float of_block) { farthest = lane_min(farthest, of_block); });
  if (farthest > 0 && surely_behind<F>(surface, depth_in<F>(surface, box), farthest)) return;
  OpenEdges open;
  if (surface.bounded)
    for (const EdgeSheet& each : surface.edge) {
      const Anchored e = anchored<F>(each.value, each.error, box);
      if (e.high < 0) return;
      if (!(e.low > 0)) open.edge[open.size++] = &each;
    }
  for_each_block([&](int X, int Y, float& of_block) { draw_block<F>(tile, surface, open, X, Y, of_block); });
}

}  // namespace sidelight::raster
