// SPDX-License-Identifier: MIT
// Surfaces into a tile's z-buffer, a row of samples in as many lanes as F has. Included only by kernels_scalar.cpp,
// kernels_avx2.cpp and kernels_avx512.cpp.
#pragma once

#include <limits>

#include "raster/kernels.h"
#include "raster/screen_triangle.h"

namespace sidelight::raster {

// ask(X + lane, Y) in the lanes where `mask` holds.
template <class F, class Ask>
void for_each_lane(const Mask<F>& mask, int X, int Y, const Ask& ask) {
  alignas(64) float asked[kLanes<F>];
  store(select<F>(mask, F(1), F(0)), asked);
  for (int lane = 0; lane < kLanes<F>; ++lane)
    if (asked[lane] != 0) ask(X + lane, Y);
}

// Keeps the primitive where it is covered, sure, and surely nearer than what the samples hold. Returns where the order
// is doubtful. `held` becomes what they hold now. Without a branch: who wins is hard to foresee.
template <class F>
Mask<F> keep_nearer(const TileView& tile, int index, std::uint32_t primitive, const Mask<F>& covered,
                    const Mask<F>& sure, const F& w, F& held) {
  auto* const ids = reinterpret_cast<std::int32_t*>(tile.primitive + index);
  held = load<F>(tile.w + index);
  const Mask<F> nearer = covered && sure && w > held * F(kSurely);
  const Mask<F> farther = sure && w * F(kSurely) < held;
  held = select<F>(nearer, w, held);
  store(held, tile.w + index);
  const F id = from_bits<F>(Ints<F>(static_cast<std::int32_t>(primitive)));
  store(to_bits<F>(select<F>(nearer, id, from_bits<F>(load<Ints<F>>(ids)))), ids);
  return covered && !(nearer || farther);
}

// Asks exactly about the order where `mask` holds; lane 0 is sample (X, Y).
template <class F>
void order_lanes_exactly(const TileView& tile, std::uint32_t primitive, int X, int Y, const Mask<F>& mask,
                         const F& w, const Mask<F>& sure) {
  alignas(64) float ws[kLanes<F>];
  store(select<F>(sure, w, F(0)), ws);
  for_each_lane<F>(mask, X, Y, [&](int x, int y) { order_exactly(tile, primitive, x, y, ws[x - X]); });
}

// ---- Small triangles ----

// Whether all samples of the blocks that a box touches surely hold something nearer than 1/t = w.
template <class Set>
bool hidden(const TileView& tile, int x0, int y0, int x1, int y1, float w) {
  constexpr int kColumns = TileView::kBlockColumns, kRows = TileView::kBlockRows;
  const int first = (x0 - tile.box.x0) / kColumns, last = (x1 - 1 - tile.box.x0) / kColumns;
  for (int row = (y0 - tile.box.y0) / kRows; row <= (y1 - 1 - tile.box.y0) / kRows; ++row)
    for (int column = first; column <= last; ++column)
      if (!(w * kSurely < tile.farthest[row * tile.block_columns + column])) return false;
  return true;
}

template <class F>
void draw_small_triangle(const TileView& tile, const ScreenSpace& space, const ScreenVertex& a,
                         const ScreenVertex& b, const ScreenVertex& c, std::uint32_t primitive) {
  const std::array<std::int32_t, 3> x{a.x, b.x, c.x}, y{a.y, b.y, c.y};
  const Box<std::int32_t> box =
      box_of_places(space, lane_min(lane_min(a.x, b.x), c.x), lane_min(lane_min(a.y, b.y), c.y),
                    lane_max(lane_max(a.x, b.x), c.x), lane_max(lane_max(a.y, b.y), c.y));
  const int x0 = std::max(box.x0, tile.box.x0), x1 = std::min(box.x1, tile.box.x1);
  const int y0 = std::max(box.y0, tile.box.y0), y1 = std::min(box.y1, tile.box.y1);
  if (hidden<F>(tile, x0, y0, x1, y1, lane_max(lane_max(a.w, b.w), c.w))) return;
  const ScreenTriangle<float> t = screen_triangle<float, F>(x, y, {a.w, b.w, c.w});
  const Mask<F> sure_depth(t.sure_depth);

  const F unit(static_cast<float>(1 << space.bits)), doubt(t.doubt);
  std::uint64_t fragments = 0;
  for (int X = x0 - (x0 - tile.box.x0) % kLanes<F>; X < x1; X += kLanes<F>) {
    // E_k = across_k - down_k, the one constant along a column, the other along a row.
    std::array<F, 3> across;
    for (std::size_t k = 0; k < 3; ++k)
      across[k] = (F(static_cast<float>(x[(k + 1) % 3] - space.place_of_column(x0))) -
                   (lane_numbers<F>() + F(static_cast<float>(X - x0))) * unit) *
                  F(t.dy[k]);
    const F column = lane_numbers<F>() + F(static_cast<float>(X - x0));
    const Mask<F> in_box = column >= F(0) && column < F(static_cast<float>(x1 - x0));
    for (int Y = y0; Y < y1; ++Y) {
      std::array<F, 3> e;
      for (std::size_t k = 0; k < 3; ++k)
        e[k] = across[k] - F(static_cast<float>(y[(k + 1) % 3] - space.place_of_row(Y)) * t.dx[k]);
      const F least = lane_min(lane_min(e[0], e[1]), e[2]);
      Mask<F> covered = in_box && least > doubt, doubtful = in_box && lane_abs(least) <= doubt;
      if (!t.sure_side) {
        covered = in_box && !in_box;
        doubtful = in_box;
      }
      F held;
      const F w = F(t.w0) + (e[1] * F(t.slope1) + e[2] * F(t.slope2));
      const Mask<F> tied = keep_nearer<F>(tile, tile.index(X, Y), primitive, covered, sure_depth, w, held);
      fragments += static_cast<std::uint64_t>(count<F>(covered));
      if (any<F>(tied || doubtful)) {
        order_lanes_exactly<F>(tile, primitive, X, Y, tied, w, sure_depth);
        for_each_lane<F>(doubtful, X, Y, [&](int sx, int sy) { draw_exactly(tile, primitive, sx, sy, 3); });
      }
    }
  }
  tile.counts.fragments += fragments;
}

template <class F>
[[gnu::flatten]] void draw_small_triangles(const TileView& tile, const ScreenSpace& space,
                                           const ScreenVertex* vertices, const Corners3* corners,
                                           const SmallTriangle* triangles, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    const Corners3& corner = corners[triangles[i].triangle];
    draw_small_triangle<F>(tile, space, vertices[corner[0]], vertices[corner[1]], vertices[corner[2]],
                           triangles[i].primitive);
  }
}

template <class F>
[[gnu::flatten]] void find_farthest_of_blocks(const TileView& tile) {
  constexpr int kColumns = TileView::kBlockColumns, kRows = TileView::kBlockRows;
  const F infinite(std::numeric_limits<float>::infinity());
  for (int Y0 = tile.box.y0, row = 0; Y0 < tile.box.y1; Y0 += kRows, ++row)
    for (int X0 = tile.box.x0, column = 0; X0 < tile.box.x1; X0 += kColumns, ++column) {
      F far = infinite;
      for (int Y = Y0; Y < std::min(Y0 + kRows, tile.box.y1); ++Y)
        for (int X = X0; X < std::min(X0 + kColumns, tile.box.x1); X += kLanes<F>) {
          const Mask<F> in_tile = lane_numbers<F>() < F(static_cast<float>(tile.box.x1 - X));
          far = lane_min(far, select<F>(in_tile, load<F>(tile.w + tile.index(X, Y)), infinite));
        }
      tile.farthest[row * tile.block_columns + column] = least<F>(far);
    }
}

// ---- Large surfaces ----

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

template <class F>
bool has_sure_depth(const LargeSurface& surface, const Anchored& w) {
  return surface.depth.sure && lane_abs(w.high) < 1e30f && lane_abs(w.low) < 1e30f;
}
template <class F>
bool surely_behind(const LargeSurface& surface, const Anchored& w, float farthest) {
  return has_sure_depth<F>(surface, w) && w.high * kSurely < farthest;
}

// The block whose first sample is (X0, Y0).
template <class F>
void draw_block(const TileView& tile, const LargeSurface& surface, int X0, int Y0, float& farthest) {
  constexpr int kColumns = TileView::kBlockColumns;
  const Anchored w = anchored<F>(surface.depth.w, surface.depth.error, X0, Y0);
  if (surely_behind<F>(surface, w, farthest)) return;  // hidden: all samples hold something nearer
  const bool sure = has_sure_depth<F>(surface, w);

  // Edges that the whole block is inside of need no test; one that it is outside of needs no block.
  std::array<Anchored, 3> edge;
  int edges = 0;
  if (surface.bounded)
    for (const EdgeSheet& each : surface.edge) {
      edge[static_cast<std::size_t>(edges)] = anchored<F>(each.value, each.error, X0, Y0);
      const Anchored& e = edge[static_cast<std::size_t>(edges)];
      if (e.high < 0) return;
      edges += !(e.low > 0);
    }

  // Below `floor` w is not within kFloatDepthError of itself.
  const float floor = sure ? w.bound * (1 / kFloatDepthError) : std::numeric_limits<float>::infinity();
  const int x1 = std::min(surface.box.x1, tile.box.x1) - X0,
            y1 = std::min({surface.box.y1, tile.box.y1, Y0 + 8}) - Y0;
  F least_held(std::numeric_limits<float>::infinity());
  for (int j = std::max(surface.box.y0 - Y0, 0); j < y1; ++j)
    for (int i = 0; i < std::min(x1, kColumns); i += kLanes<F>) {
      const F column = lane_numbers<F>() + F(static_cast<float>(i));
      const auto value = [&](const Anchored& a) {
        return F(a.value + static_cast<float>(j) * a.y) + column * F(a.x);
      };
      Mask<F> covered =
          column < F(static_cast<float>(x1)) && column >= F(static_cast<float>(surface.box.x0 - X0));
      const Mask<F> in_box = covered;
      Mask<F> doubtful = covered;
      for (std::size_t k = 0; k < static_cast<std::size_t>(edges); ++k) {
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
      const int index = tile.index(X0 + i, Y0 + j);
      F held;
      const Mask<F> sure_depth = depth > F(floor);
      const Mask<F> tied = keep_nearer<F>(tile, index, surface.primitive, covered, sure_depth, depth, held);
      tile.counts.fragments += static_cast<std::uint64_t>(count<F>(covered));
      if (any<F>(tied || doubtful)) {
        order_lanes_exactly<F>(tile, surface.primitive, X0 + i, Y0 + j, tied, depth, sure_depth);
        for_each_lane<F>(doubtful, X0 + i, Y0 + j, [&](int X, int Y) {
          draw_exactly(tile, surface.primitive, X, Y, surface.bounded ? 3 : 0);
        });
      }
      least_held = lane_min(least_held, select<F>(in_box, held, F(std::numeric_limits<float>::infinity())));
    }
  if (edges > 0) return;
  farthest = least<F>(least_held);
}

template <class F>
[[gnu::flatten]] void draw_large_surface(const TileView& tile, const LargeSurface& surface) {
  const int x0 = std::max(surface.box.x0, tile.box.x0), x1 = std::min(surface.box.x1, tile.box.x1);
  const int y0 = std::max(surface.box.y0, tile.box.y0), y1 = std::min(surface.box.y1, tile.box.y1);
  if (x0 >= x1) return;
  const auto for_each_block = [&](const auto& visit) {
    for (int row = (y0 - tile.box.y0) / TileView::kBlockRows; tile.box.y0 + row * TileView::kBlockRows < y1;
         ++row)
      for (int column = (x0 - tile.box.x0) / TileView::kBlockColumns;
           tile.box.x0 + column * TileView::kBlockColumns < x1; ++column)
        visit(tile.box.x0 + column * TileView::kBlockColumns, tile.box.y0 + row * TileView::kBlockRows,
              tile.farthest[row * tile.block_columns + column]);
  };
  // Layers behind a wall are dropped a whole tile at a time.
  float farthest = std::numeric_limits<float>::infinity();
  for_each_block([&](int, int, float of_block) { farthest = lane_min(farthest, of_block); });
  if (farthest > 0) {
    const Anchored w = anchored<F>(surface.depth.w, surface.depth.error, x0, y0,
                                   static_cast<float>(x1 - 1 - x0), static_cast<float>(y1 - 1 - y0));
    if (surely_behind<F>(surface, w, farthest)) return;
  }
  for_each_block([&](int X, int Y, float& of_block) { draw_block<F>(tile, surface, X, Y, of_block); });
}

}  // namespace sidelight::raster
