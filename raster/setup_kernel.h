// SPDX-License-Identifier: MIT
// Set-up across triangles: boxes, culling and classes, and triangles of a few samples rasterized on the spot. After
// M. Abrash, "Rasterization on Larrabee", 2009, and F. Giesen, "Optimizing Software Occlusion Culling", 2013.
// Included only by kernels_scalar.cpp, kernels_avx2.cpp and kernels_avx512.cpp.
#pragma once

#include <bit>

#include "raster/kernels.h"
#include "raster/screen_triangle.h"

namespace sidelight::raster {

// As many vertices as D has lanes at a time; the last ones alone.
template <class D>
[[gnu::flatten]] void project_all(const ScreenSpace& space, const glm::dvec3* from, ScreenVertex* to,
                                  int size) {
  int i = 0;
  for (; i + kLanes<D> <= size; i += kLanes<D>) {
    const glm::dvec3* v = from + i;
    project_lanes<D>(space, generate<D>([v](int k) { return v[k].x; }),
                     generate<D>([v](int k) { return v[k].y; }), generate<D>([v](int k) { return v[k].z; }),
                     to + i);
  }
  if constexpr (kLanes < D >> 1)
    for (; i < size; ++i) to[i] = project(space, from[i]);
}

// ---- Tiny triangles ----

template <class F>
struct Boxes {
  Ints<F> x0, y0, x1, y1;
};

// The lanes of a row of boxes where something holds, as fragments: bit i kLanes + lane is sample i of the row.
template <class F>
std::size_t append(std::uint64_t bits, const Boxes<F>& boxes, int j,
                   const std::array<F, TinyFragments::kBox>& w, std::int32_t first, ScreenFragment* to) {
  constexpr int kCount = kLanes<F>;
  alignas(64) std::int32_t xs[kCount], ys[kCount];
  alignas(64) float ws[TinyFragments::kBox][kCount];
  store(boxes.x0, xs);
  store(boxes.y0, ys);
  for (std::size_t i = 0; i < w.size(); ++i) store(w[i], ws[i]);
  std::size_t size = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits), i = bit / kCount, lane = bit % kCount;
    to[size++] = {xs[lane] + i, ys[lane] + j, ws[i][lane], static_cast<std::uint32_t>(first + lane)};
  }
  return size;
}

// Every sample of the boxes, a triangle in each lane. `first`: the place of the first lane's triangle.
template <class F>
void rasterize_tiny(const ScreenSpace& space, const ScreenTriangle<F>& t, const std::array<Ints<F>, 3>& x,
                    const std::array<Ints<F>, 3>& y, const Boxes<F>& boxes, const Mask<F>& tiny,
                    std::int32_t first, TinyFragments& out) {
  using I = Ints<F>;
  constexpr int kBox = TinyFragments::kBox;
  const F width = to_real<F>(I(boxes.x1 - boxes.x0)), height = to_real<F>(I(boxes.y1 - boxes.y0));
  // E_k = across_k - down_k, the one constant along a column, the other along a row.
  std::array<std::array<F, 3>, kBox> across;
  for (int i = 0; i < kBox; ++i) {
    const I place = (boxes.x0 + I(i - space.center_x)) << space.bits;
    for (std::size_t k = 0; k < 3; ++k)
      across[static_cast<std::size_t>(i)][k] = to_real<F>(I(x[(k + 1) % 3] - place)) * t.dy[k];
  }
  for (int j = 0; j < kBox; ++j) {
    const Mask<F> row = tiny && F(static_cast<float>(j)) < height;
    if (!any<F>(row)) break;
    const I place = (boxes.y0 + I(j - space.center_y)) << space.bits;
    std::array<F, 3> down;
    for (std::size_t k = 0; k < 3; ++k) down[k] = to_real<F>(I(y[(k + 1) % 3] - place)) * t.dx[k];

    std::array<F, kBox> w;
    std::uint64_t covered = 0, doubtful = 0;
    for (int i = 0; i < kBox; ++i) {
      const auto column = static_cast<std::size_t>(i);
      const Mask<F> tried = row && F(static_cast<float>(i)) < width;
      const F e0 = across[column][0] - down[0], e1 = across[column][1] - down[1],
              e2 = across[column][2] - down[2];
      const F least = lane_min(lane_min(e0, e1), e2);
      w[column] = select<F>(t.sure_depth, t.w0 + (e1 * t.slope1 + e2 * t.slope2), F(0));
      covered |= std::uint64_t{mask_bits<F>(tried && least > t.doubt)} << (i * kLanes<F>);
      doubtful |= std::uint64_t{mask_bits<F>(tried && lane_abs(least) <= t.doubt)} << (i * kLanes<F>);
    }
    out.covered += append<F>(covered, boxes, j, w, first, &out.fragment[out.covered]);
    if (doubtful != 0) {
      w.fill(F(0));
      out.doubtful += append<F>(doubtful, boxes, j, w, first, &out.doubt[out.doubtful]);
    }
  }
}

// ---- Boxes and kinds ----

// Entries beyond size are set up too, from whatever they hold, and unused.
template <class F>
[[gnu::flatten]] void set_up_chunk(const ScreenSpace& space, const SampleBox& window, TriangleChunk& chunk,
                                   TinyFragments& out) {
  using I = Ints<F>;
  using K = TriangleChunk;
  out.covered = out.doubtful = 0;
  out.triangles = 0;
  I tests(0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(chunk.size); i += kLanes<F>) {
    const std::array<I, 3> x{load<I>(&chunk.x[0][i]), load<I>(&chunk.x[1][i]), load<I>(&chunk.x[2][i])};
    const std::array<I, 3> y{load<I>(&chunk.y[0][i]), load<I>(&chunk.y[1][i]), load<I>(&chunk.y[2][i])};
    const I left = lane_min(lane_min(x[0], x[1]), x[2]), right = lane_max(lane_max(x[0], x[1]), x[2]);
    const I top = lane_min(lane_min(y[0], y[1]), y[2]), bottom = lane_max(lane_max(y[0], y[1]), y[2]);
    const Box<I> box = box_of_places(space, left, top, right, bottom);
    const Boxes<F> in_window{lane_max(box.x0, I(window.x0)), lane_max(box.y0, I(window.y0)),
                             lane_min(box.x1, I(window.x1)), lane_min(box.y1, I(window.y1))};
    const auto& [x0, y0, x1, y1] = in_window;
    store(x0, &chunk.x0[i]);
    store(y0, &chunk.y0[i]);
    store(x1, &chunk.x1[i]);
    store(y1, &chunk.y1[i]);

    const I sa = load<I>(&chunk.state[0][i]), sb = load<I>(&chunk.state[1][i]),
            sc = load<I>(&chunk.state[2][i]);
    const I unplaced(static_cast<int>(ScreenSpace::kUnplaced));
    const auto placed = ((sa | sb | sc) & unplaced) == I(0);
    const auto beyond = ((sa & sb & sc) & ~unplaced) != I(0);
    const auto seen = !beyond && !(placed && (x0 >= x1 || y0 >= y1)) &&
                      lane_numbers<I>() < I(chunk.size - static_cast<int>(i));
    if (!any<I>(seen)) {
      store(I(K::kNothing), &chunk.kind[i]);
      continue;
    }
    const auto small = placed && right - left <= I(kSmallExtent) && bottom - top <= I(kSmallExtent);
    const ScreenTriangle<F> triangle =
        screen_triangle<F>(x, y, {load<F>(&chunk.w[0][i]), load<F>(&chunk.w[1][i]), load<F>(&chunk.w[2][i])});
    const I by_side = select<I>(integer_mask<F>(triangle.front), I(K::kFront), I(K::kBack));
    const I of_small = select<I>(integer_mask<F>(triangle.sure_side), by_side, I(K::kDoubtful));
    const auto tiny = seen && small && integer_mask<F>(triangle.sure_side) &&
                      x1 - x0 <= I(TinyFragments::kBox) && y1 - y0 <= I(TinyFragments::kBox);
    store(select<I>(seen && !tiny, select<I>(small, of_small, I(K::kLarge)), I(K::kNothing)), &chunk.kind[i]);
    if (!any<I>(tiny)) continue;
    out.triangles += static_cast<std::uint64_t>(count<I>(tiny));
    tests += select<I>(tiny, (x1 - x0) * (y1 - y0), I(0));
    rasterize_tiny<F>(space, triangle, x, y, in_window, real_mask<F>(tiny), static_cast<std::int32_t>(i),
                      out);
  }
  out.tests = sum<I>(tests);
}

}  // namespace sidelight::raster
