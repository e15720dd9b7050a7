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

// A few small triangles of a tile, set up together: corner by corner what they are, and what drawing them reads.
struct SmallTriangles {
  static constexpr std::size_t kSize = 16;
  template <class T>
  using Each = std::array<T, kSize>;

  alignas(64) std::array<Each<std::int32_t>, 3> x, y;
  alignas(64) std::array<Each<float>, 3> w;

  alignas(64) Each<std::int32_t> x0, y0, x1, y1;  // box, cut to the tile
  alignas(64) Each<float> nearest;                // the greatest w
  // Of ScreenTriangle; 1 for true.
  alignas(64) std::array<Each<float>, 3> dx, dy;
  alignas(64) Each<float> doubt, w0, slope1, slope2, sure_side, sure_depth;
};

// What is left beyond the last repeats it.
template <class Set>
void load_small_triangles(const ScreenVertex* vertices, const Corners3* corners,
                          const SmallTriangle* triangles, std::size_t size, SmallTriangles& to) {
  for (std::size_t i = 0; i < SmallTriangles::kSize; ++i) {
    const Corners3& corner = corners[triangles[std::min(i, size - 1)].triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      const ScreenVertex& vertex = vertices[corner[k]];
      to.x[k][i] = vertex.x;
      to.y[k][i] = vertex.y;
      to.w[k][i] = vertex.w;
    }
  }
}

template <class F>
void set_up_small_triangles(const TileView& tile, const ScreenSpace& space, SmallTriangles& of) {
  using I = Ints<F>;
  for (std::size_t i = 0; i < SmallTriangles::kSize; i += kLanes<F>) {
    const std::array<I, 3> x{load<I>(&of.x[0][i]), load<I>(&of.x[1][i]), load<I>(&of.x[2][i])};
    const std::array<I, 3> y{load<I>(&of.y[0][i]), load<I>(&of.y[1][i]), load<I>(&of.y[2][i])};
    const std::array<F, 3> w{load<F>(&of.w[0][i]), load<F>(&of.w[1][i]), load<F>(&of.w[2][i])};
    const auto least_of = [](const auto& v) { return lane_min(lane_min(v[0], v[1]), v[2]); };
    const auto most_of = [](const auto& v) { return lane_max(lane_max(v[0], v[1]), v[2]); };
    const Box<I> box = box_of_places(space, I(least_of(x)), I(least_of(y)), I(most_of(x)), I(most_of(y)));
    store(I(lane_max(box.x0, I(tile.box.x0))), &of.x0[i]);
    store(I(lane_max(box.y0, I(tile.box.y0))), &of.y0[i]);
    store(I(lane_min(box.x1, I(tile.box.x1))), &of.x1[i]);
    store(I(lane_min(box.y1, I(tile.box.y1))), &of.y1[i]);
    store(F(most_of(w)), &of.nearest[i]);

    const ScreenTriangle<F> t = screen_triangle<F>(x, y, w);
    for (std::size_t k = 0; k < 3; ++k) {
      store(t.dx[k], &of.dx[k][i]);
      store(t.dy[k], &of.dy[k][i]);
    }
    store(t.doubt, &of.doubt[i]);
    store(t.w0, &of.w0[i]);
    store(t.slope1, &of.slope1[i]);
    store(t.slope2, &of.slope2[i]);
    store(select<F>(t.sure_side, F(1), F(0)), &of.sure_side[i]);
    store(select<F>(t.sure_depth, F(1), F(0)), &of.sure_depth[i]);
  }
}

template <class F>
void draw_small_triangle(const TileView& tile, const ScreenSpace& space, const SmallTriangles& of,
                         std::size_t i, std::uint32_t primitive) {
  const int x0 = of.x0[i], y0 = of.y0[i], x1 = of.x1[i], y1 = of.y1[i];
  if (hidden<F>(tile, x0, y0, x1, y1, of.nearest[i])) return;
  const Mask<F> sure_side(of.sure_side[i] != 0), sure_depth(of.sure_depth[i] != 0);
  const auto row = static_cast<float>(1 << space.bits);
  const F unit(row), doubt(of.doubt[i]);
  std::uint64_t fragments = 0;
  for (int X = x0 - (x0 - tile.box.x0) % kLanes<F>; X < x1; X += kLanes<F>) {
    // E_k = across_k - down_k, the one constant along a column, the other along a row.
    const F column = lane_numbers<F>() + F(static_cast<float>(X - x0));
    std::array<F, 3> across;
    for (std::size_t k = 0; k < 3; ++k)
      across[k] = (F(static_cast<float>(of.x[(k + 1) % 3][i] - space.place_of_column(x0))) - column * unit) *
                  F(of.dy[k][i]);
    const Mask<F> in_box = column >= F(0) && column < F(static_cast<float>(x1 - x0));
    std::array<float, 3> below;  // of each edge's first corner, in units; whole numbers, and exact
    for (std::size_t k = 0; k < 3; ++k)
      below[k] = static_cast<float>(of.y[(k + 1) % 3][i] - space.place_of_row(y0));
    for (int Y = y0; Y < y1; ++Y) {
      std::array<F, 3> e;
      for (std::size_t k = 0; k < 3; ++k) {
        e[k] = across[k] - F(below[k] * of.dx[k][i]);
        below[k] -= row;
      }
      const F least = lane_min(lane_min(e[0], e[1]), e[2]);
      const Mask<F> covered = in_box && sure_side && least > doubt;
      const Mask<F> doubtful = in_box && (!sure_side || lane_abs(least) <= doubt);
      F held;
      const F w = F(of.w0[i]) + (e[1] * F(of.slope1[i]) + e[2] * F(of.slope2[i]));
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
  constexpr std::size_t kSize = SmallTriangles::kSize;
  SmallTriangles together;
  for (std::size_t done = 0; done < size; done += kSize) {
    const std::size_t some = std::min(kSize, size - done);
    load_small_triangles<F>(vertices, corners, triangles + done, some, together);
    set_up_small_triangles<F>(tile, space, together);
    for (std::size_t i = 0; i < some; ++i)
      draw_small_triangle<F>(tile, space, together, i, triangles[done + i].primitive);
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
