// SPDX-License-Identifier: MIT
// Set-up across triangles: boxes, culling and classes, and triangles of a few samples rasterized on the spot. After
// M. Abrash, "Rasterization on Larrabee", 2009, and F. Giesen, "Optimizing Software Occlusion Culling", 2013.
// Included only by kernels_scalar.cpp, kernels_avx2.cpp and kernels_avx512.cpp.
#pragma once

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

template <class F>
ScreenTriangle<F> triangle_at(const TriangleChunk& chunk, std::size_t i) {
  using I = Ints<F>;
  return screen_triangle<F>({load<I>(&chunk.x[0][i]), load<I>(&chunk.x[1][i]), load<I>(&chunk.x[2][i])},
                            {load<I>(&chunk.y[0][i]), load<I>(&chunk.y[1][i]), load<I>(&chunk.y[2][i])},
                            {load<F>(&chunk.w[0][i]), load<F>(&chunk.w[1][i]), load<F>(&chunk.w[2][i])});
}

// Boxes and kinds. Entries beyond size are set up too, from whatever they hold, and unused.
template <class F>
[[gnu::flatten]] void set_up_chunk(const ScreenSpace& space, const SampleBox& window, TriangleChunk& chunk) {
  using I = Ints<F>;
  using K = TriangleChunk;
  for (std::size_t i = 0; i < static_cast<std::size_t>(chunk.size); i += kLanes<F>) {
    const I xa = load<I>(&chunk.x[0][i]), xb = load<I>(&chunk.x[1][i]), xc = load<I>(&chunk.x[2][i]);
    const I ya = load<I>(&chunk.y[0][i]), yb = load<I>(&chunk.y[1][i]), yc = load<I>(&chunk.y[2][i]);
    const I left = lane_min(lane_min(xa, xb), xc), right = lane_max(lane_max(xa, xb), xc);
    const I top = lane_min(lane_min(ya, yb), yc), bottom = lane_max(lane_max(ya, yb), yc);
    const Box<I> box = box_of_places(space, left, top, right, bottom);
    const I x0 = lane_max(box.x0, I(window.x0)), y0 = lane_max(box.y0, I(window.y0));
    const I x1 = lane_min(box.x1, I(window.x1)), y1 = lane_min(box.y1, I(window.y1));
    store(x0, &chunk.x0[i]);
    store(y0, &chunk.y0[i]);
    store(x1, &chunk.x1[i]);
    store(y1, &chunk.y1[i]);

    const I sa = load<I>(&chunk.state[0][i]), sb = load<I>(&chunk.state[1][i]),
            sc = load<I>(&chunk.state[2][i]);
    const I unplaced(static_cast<int>(ScreenSpace::kUnplaced));
    const auto placed = ((sa | sb | sc) & unplaced) == I(0);
    const auto beyond = ((sa & sb & sc) & ~unplaced) != I(0);
    const auto seen = !beyond && !(placed && (x0 >= x1 || y0 >= y1));
    if (!any<I>(seen)) {
      store(I(K::kNothing), &chunk.kind[i]);
      continue;
    }
    const auto small = placed && right - left <= I(kSmallExtent) && bottom - top <= I(kSmallExtent);
    const auto tiny = x1 - x0 <= I(K::kTinyBox) && y1 - y0 <= I(K::kTinyBox);
    const ScreenTriangle<F> triangle = triangle_at<F>(chunk, i);
    const I by_side = select<I>(integer_mask<F>(triangle.front), I(K::kFront), I(K::kBack));
    const I of_small = select<I>(integer_mask<F>(triangle.sure_side), select<I>(tiny, I(K::kTiny), by_side),
                                 I(K::kDoubtful));
    store(select<I>(seen, select<I>(small, of_small, I(K::kLarge)), I(K::kNothing)), &chunk.kind[i]);
  }
}

// Entry `of` of the queue in each lane.
template <class V, class From>
V gathered(const From& from, const std::int32_t* queue) {
  return generate<V>([&](int lane) { return from[static_cast<std::size_t>(queue[lane])]; });
}

// Appends the lanes where `mask` holds; `to` must have room for all lanes.
template <class F>
std::size_t append(const Mask<F>& mask, const Ints<F>& X, const Ints<F>& Y, const F& w,
                   const std::int32_t* queue, ScreenFragment* to) {
  constexpr int kCount = kLanes<F>;
  alignas(64) std::int32_t xs[kCount], ys[kCount], taken[kCount];
  alignas(64) float ws[kCount];
  store(X, xs);
  store(Y, ys);
  store(w, ws);
  store(select<Ints<F>>(integer_mask<F>(mask), Ints<F>(1), Ints<F>(0)), taken);
  std::size_t size = 0;
  for (int lane = 0; lane < kCount; ++lane) {
    to[size] = {xs[lane], ys[lane], ws[lane], static_cast<std::uint32_t>(queue[lane])};
    size += static_cast<std::size_t>(taken[lane]);
  }
  return size;
}

// Every sample of up to 3 x 3, of as many triangles as F has lanes at a time.
template <class F>
[[gnu::flatten]] void rasterize_tiny_queue(const ScreenSpace& space, const TriangleChunk& chunk,
                                           const std::int32_t* queue, int size, TinyFragments& out) {
  using I = Ints<F>;
  out.covered = out.doubtful = 0;
  for (int first = 0; first < size; first += kLanes<F>) {
    // The last vector is filled up with the queue's last triangle, in lanes that are off.
    std::int32_t at[kLanes<F>];
    for (int lane = 0; lane < kLanes<F>; ++lane) at[lane] = queue[std::min(first + lane, size - 1)];
    const auto corner = [&](const auto& of, auto zero) {
      using V = decltype(zero);
      return std::array<V, 3>{gathered<V>(of[0], at), gathered<V>(of[1], at), gathered<V>(of[2], at)};
    };
    const std::array<I, 3> x = corner(chunk.x, I{}), y = corner(chunk.y, I{});
    const ScreenTriangle<F> t = screen_triangle<F>(x, y, corner(chunk.w, F{}));
    const I x0 = gathered<I>(chunk.x0, at), y0 = gathered<I>(chunk.y0, at);
    const F width = to_real<F>(I(gathered<I>(chunk.x1, at) - x0));
    const F height = to_real<F>(I(gathered<I>(chunk.y1, at) - y0));
    const Mask<F> on = lane_numbers<F>() < F(static_cast<float>(size - first));

    for (int j = 0; j < TriangleChunk::kTinyBox; ++j) {
      const Mask<F> row = on && F(static_cast<float>(j)) < height;
      if (!any<F>(row)) break;
      const I Y = y0 + I(j), place_y = (Y - I(space.center_y)) << space.bits;
      for (int i = 0; i < TriangleChunk::kTinyBox; ++i) {
        const Mask<F> tried = row && F(static_cast<float>(i)) < width;
        if (!any<F>(tried)) break;
        const I X = x0 + I(i), place_x = (X - I(space.center_x)) << space.bits;
        const auto edge = [&](std::size_t k) {
          const std::size_t from = (k + 1) % 3;
          return to_real<F>(I(x[from] - place_x)) * t.dy[k] - to_real<F>(I(y[from] - place_y)) * t.dx[k];
        };
        const F e0 = edge(0), e1 = edge(1), e2 = edge(2);
        const F least = lane_min(lane_min(e0, e1), e2);
        const F w = t.w0 + (e1 * t.slope1 + e2 * t.slope2);
        const Mask<F> covered = tried && least > t.doubt;
        if (any<F>(covered))
          out.covered +=
              append<F>(covered, X, Y, select<F>(t.sure_depth, w, F(0)), at, &out.fragment[out.covered]);
        const Mask<F> doubtful = tried && lane_abs(least) <= t.doubt;
        if (any<F>(doubtful)) out.doubtful += append<F>(doubtful, X, Y, F(0), at, &out.doubt[out.doubtful]);
      }
    }
  }
}

}  // namespace sidelight::raster
