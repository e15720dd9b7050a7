// SPDX-License-Identifier: MIT
// Small triangles into a tile's z-buffer, set up sixteen at a time.
#pragma once

#include <array>

#include "raster/visible_keep.h"

namespace sidelight::raster {

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

}  // namespace sidelight::raster
