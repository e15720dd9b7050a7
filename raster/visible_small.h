// SPDX-License-Identifier: MIT
// Small triangles into a tile's z-buffer: set up in lanes across triangles, then drawn in lanes across samples, a vector at
// a time (visible_keep.h). Which vectors their boxes touch is listed first: a loop over a list ends where it is foreseen
// to, and one triangle's vectors do not wait for another's.
#pragma once

#include <array>

#include "common/math/four.h"
#include "raster/visible_keep.h"

namespace sidelight::raster {

// Whether all samples of the blocks that a box touches surely hold something nearer than 1/t = w. (The box from the tile's
// first sample.)
template <class Set>
bool hidden(const TileView& tile, int x0, int y0, int x1, int y1, float w) {
  constexpr int kColumns = TileView::kBlockColumns, kRows = TileView::kBlockRows;
  for (int row = y0 / kRows; row <= (y1 - 1) / kRows; ++row)
    for (int column = x0 / kColumns; column <= (x1 - 1) / kColumns; ++column)
      if (!(w * kSurely < tile.farthest[row * tile.block_columns + column])) return false;
  return true;
}

// As many small triangles of a tile as F has lanes: corner by corner what they are, and what drawing them reads.
template <class F>
struct SmallTriangles {
  static constexpr auto kSize = static_cast<std::size_t>(kLanes<F>);
  template <class T>
  using Each = std::array<T, kSize>;

  // To whole vectors of four, of which only the first are used.
  alignas(64) std::array<std::array<std::int32_t, (kSize + 3) / 4 * 4>, 3> x, y, w;

  alignas(64) Each<std::int32_t> x0, y0, x1, y1;  // box, cut to the tile and from its first sample
  alignas(64) Each<float> nearest;                // the greatest w
  // Of edge k its first corner, in units from the box's first sample; and of ScreenTriangle.
  alignas(64) std::array<Each<float>, 3> from_x, from_y, dx, dy;
  alignas(64) Each<float> doubt;  // infinite where the side is not sure: all is in doubt
  alignas(64) Each<float> w0;     // not a number where depth is not sure
  alignas(64) Each<float> slope1, slope2;
  alignas(64) Each<float> columns, rows;  // of the box
};

// The last one again where there are too few.
template <class F>
void load_small_triangles(const ScreenVertex* vertices, const Corners3* corners,
                          const SmallTriangle* triangles, std::size_t size, SmallTriangles<F>& to) {
  for (std::size_t i = 0; i < SmallTriangles<F>::kSize; i += 4) {
    const auto corners_of = [&](std::size_t place) -> const Corners3& {
      return corners[triangles[std::min(place, size - 1)].triangle];
    };
    const Corners3 &a = corners_of(i), &b = corners_of(i + 1), &c = corners_of(i + 2), &d = corners_of(i + 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto columns = transposed(load_four(&vertices[a[k]]), load_four(&vertices[b[k]]),
                                      load_four(&vertices[c[k]]), load_four(&vertices[d[k]]));
      store_four(columns[0], &to.x[k][i]);
      store_four(columns[1], &to.y[k][i]);
      store_four(columns[2], &to.w[k][i]);
    }
  }
}

template <class F>
void set_up_small_triangles(const TileView& tile, const ScreenSpace& space, SmallTriangles<F>& of) {
  using I = Ints<F>;
  const std::array<I, 3> x{load<I>(&of.x[0][0]), load<I>(&of.x[1][0]), load<I>(&of.x[2][0])};
  const std::array<I, 3> y{load<I>(&of.y[0][0]), load<I>(&of.y[1][0]), load<I>(&of.y[2][0])};
  const auto real = [&](std::size_t k) { return from_bits<F>(load<I>(&of.w[k][0])); };
  const std::array<F, 3> w{real(0), real(1), real(2)};
  const auto least_of = [](const auto& v) { return lane_min(lane_min(v[0], v[1]), v[2]); };
  const auto most_of = [](const auto& v) { return lane_max(lane_max(v[0], v[1]), v[2]); };
  const Box<I> box = box_of_places(space, I(least_of(x)), I(least_of(y)), I(most_of(x)), I(most_of(y)));
  const I x0 = lane_max(box.x0, I(tile.box.x0)), x1 = lane_min(box.x1, I(tile.box.x1));
  const I y0 = lane_max(box.y0, I(tile.box.y0)), y1 = lane_min(box.y1, I(tile.box.y1));
  store(I(x0 - I(tile.box.x0)), of.x0.data());
  store(I(y0 - I(tile.box.y0)), of.y0.data());
  store(I(x1 - I(tile.box.x0)), of.x1.data());
  store(I(y1 - I(tile.box.y0)), of.y1.data());
  store(to_real<F>(I(x1 - x0)), of.columns.data());
  store(to_real<F>(I(y1 - y0)), of.rows.data());
  store(F(most_of(w)), of.nearest.data());

  const ScreenTriangle<F> t = screen_triangle<F>(x, y, w);
  const I left = (x0 - I(space.center_x)) << space.bits, top = (y0 - I(space.center_y)) << space.bits;
  for (std::size_t k = 0; k < 3; ++k) {
    store(to_real<F>(I(x[(k + 1) % 3] - left)), of.from_x[k].data());
    store(to_real<F>(I(y[(k + 1) % 3] - top)), of.from_y[k].data());
    store(t.dx[k], of.dx[k].data());
    store(t.dy[k], of.dy[k].data());
  }
  using Limits = std::numeric_limits<float>;
  store(select<F>(t.sure_side, t.doubt, F(Limits::infinity())), of.doubt.data());
  store(select<F>(t.sure_depth, t.w0, F(Limits::quiet_NaN())), of.w0.data());
  store(t.slope1, of.slope1.data());
  store(t.slope2, of.slope2.data());
}

// A vector of samples and which of the triangles set up together is to be drawn there, in 32 bits.
struct TriangleVector {
  static constexpr int kLaneBits = 4, kColumnBits = 12;
  std::uint32_t number;
  std::size_t lane() const { return number % (1u << kLaneBits); }
  int column() const { return static_cast<int>((number >> kLaneBits) % (1u << kColumnBits)); }
  int row() const { return static_cast<int>(number >> (kLaneBits + kColumnBits)); }
};

// E_k at samples of triangles, each F of the triangle or of a sample. across, down: the sample from the box's first one, in
// units. Rounding is monotonic, and so is this, in across and in down.
template <class F>
F edge_value(const F& from_x, const F& from_y, const F& dx, const F& dy, const F& across, const F& down) {
  return (from_x - across) * dy - (from_y - down) * dx;
}

// Whether a vector may have a sample that is not surely outside: one vector of each triangle, its first sample from the box's.
template <class F>
Mask<F> may_show(const SmallTriangles<F>& of, const F& unit, const F& column, const F& row) {
  const F left = column * unit, right = left + F(kVectorColumns<F> - 1) * unit;
  const F top = row * unit, bottom = top + F(kVectorRows<F> - 1) * unit;
  const F inside = -load<F>(of.doubt.data());
  Mask<F> may(true);
  for (std::size_t k = 0; k < 3; ++k) {
    const F dx = load<F>(of.dx[k].data()), dy = load<F>(of.dy[k].data());
    const F most = edge_value<F>(load<F>(of.from_x[k].data()), load<F>(of.from_y[k].data()), dx, dy,
                                 select<F>(dy > F(0), left, right), select<F>(dx > F(0), bottom, top));
    may = may && most >= inside;
  }
  return may;
}

// draw(vector) for each vector in the boxes of these triangles that may show one.
template <class F, class Draw>
void for_each_vector(const ScreenSpace& space, const SmallTriangles<F>& of, const Mask<F>& triangles,
                     const Draw& draw) {
  using I = Ints<F>;
  constexpr int kWide = std::countr_zero(static_cast<unsigned>(kVectorColumns<F>)),
                kHigh = std::countr_zero(static_cast<unsigned>(kVectorRows<F>));
  constexpr std::size_t kMost = 512;
  std::array<std::int32_t, kMost> list;
  std::size_t size = 0;
  const auto draw_all = [&] {
    for (std::size_t v = 0; v < size; ++v) draw(TriangleVector{static_cast<std::uint32_t>(list[v])});
    size = 0;
  };
  const F unit(static_cast<float>(1 << space.bits));
  const I x0 = load<I>(of.x0.data()), y0 = load<I>(of.y0.data());
  const I first = x0 >> kWide, last = (load<I>(of.x1.data()) - I(1)) >> kWide;
  const I last_row = (load<I>(of.y1.data()) - I(1)) >> kHigh;
  const I lanes = lane_numbers<I>();
  I column = first, row = y0 >> kHigh;
  for (Mask<F> left = triangles; any<F>(left); left = left && real_mask<F>(row <= last_row)) {
    if (size + kLanes < F >> kMost) draw_all();
    const Mask<F> some =
        may_show<F>(of, unit, to_real<F>(I((column << kWide) - x0)), to_real<F>(I((row << kHigh) - y0)));
    const I number = lanes | (column << TriangleVector::kLaneBits) |
                     (row << (TriangleVector::kLaneBits + TriangleVector::kColumnBits));
    size += store_some<F>(left && some, number, &list[size]);
    const auto row_ends = column == last;
    row = select<I>(row_ends, row + I(1), row);
    column = select<I>(row_ends, first, column + I(1));
  }
  draw_all();
}

template <class F>
std::uint64_t draw_vector(const TileView& tile, const ScreenSpace& space, const SmallTriangles<F>& of,
                          const TriangleVector& vector, std::uint32_t primitive) {
  const std::size_t i = vector.lane();
  const int x = vector.column() * kVectorColumns<F>, y = vector.row() * kVectorRows<F>;
  const F column = lane_columns<F>() + F(static_cast<float>(x - of.x0[i]));
  const F row = lane_rows<F>() + F(static_cast<float>(y - of.y0[i]));
  const F unit(static_cast<float>(1 << space.bits));
  const F across = column * unit, down = row * unit;
  std::array<F, 3> e;
  for (std::size_t k = 0; k < 3; ++k)
    e[k] =
        edge_value<F>(F(of.from_x[k][i]), F(of.from_y[k][i]), F(of.dx[k][i]), F(of.dy[k][i]), across, down);
  const F least = lane_min(lane_min(e[0], e[1]), e[2]), doubt(of.doubt[i]);
  const Mask<F> in_box =
      (column >= F(0) && column < F(of.columns[i])) && (row >= F(0) && row < F(of.rows[i]));
  const Mask<F> covered = in_box && least > doubt;
  const Mask<F> doubtful = in_box && lane_abs(least) <= doubt;
  const F w = F(of.w0[i]) + (e[1] * F(of.slope1[i]) + e[2] * F(of.slope2[i]));
  const int X = tile.box.x0 + x, Y = tile.box.y0 + y;
  F held;
  const Mask<F> tied = keep_nearer<F>(tile, tile.index(X, Y), primitive, covered, w, held);
  if (any<F>(tied || doubtful)) {
    order_lanes_exactly<F>(tile, primitive, X, Y, tied, w);
    for_each_lane<F>(doubtful, X, Y, [&](int sx, int sy, int) { draw_exactly(tile, primitive, sx, sy, 3); });
  }
  return static_cast<std::uint64_t>(count<F>(covered));
}

template <class F>
[[gnu::flatten]] void draw_small_triangles(const TileView& tile, const ScreenSpace& space,
                                           const ScreenVertex* vertices, const Corners3* corners,
                                           const SmallTriangle* triangles, std::size_t size) {
  constexpr std::size_t kSize = SmallTriangles<F>::kSize;
  SmallTriangles<F> together;
  std::uint64_t fragments = 0;
  for (std::size_t done = 0; done < size; done += kSize) {
    const std::size_t some = std::min(kSize, size - done);
    load_small_triangles<F>(vertices, corners, triangles + done, some, together);
    set_up_small_triangles<F>(tile, space, together);
    alignas(64) std::array<float, kSize> seen{};
    for (std::size_t i = 0; i < some; ++i)
      seen[i] = !hidden<F>(tile, together.x0[i], together.y0[i], together.x1[i], together.y1[i],
                           together.nearest[i]);
    for_each_vector<F>(space, together, load<F>(seen.data()) != F(0), [&](const TriangleVector& vector) {
      fragments += draw_vector<F>(tile, space, together, vector, triangles[done + vector.lane()].primitive);
    });
  }
  tile.counts.fragments += fragments;
}

// Beyond the tile all is infinite.
template <class F>
[[gnu::flatten]] float find_farthest_of_blocks(const TileView& tile) {
  const int rows = (tile.box.y1 - tile.box.y0 + TileView::kBlockRows - 1) / TileView::kBlockRows;
  const float* w = tile.w;
  float of_all = std::numeric_limits<float>::infinity();
  for (int block = 0; block < rows * tile.block_columns; ++block, w += TileView::kBlock) {
    F far(std::numeric_limits<float>::infinity());
    for (int i = 0; i < TileView::kBlock; i += kLanes<F>) far = lane_min(far, load<F>(w + i));
    tile.farthest[block] = least<F>(far);
    of_all = lane_min(of_all, tile.farthest[block]);
  }
  return of_all;
}

}  // namespace sidelight::raster
