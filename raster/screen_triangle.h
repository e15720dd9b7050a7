// SPDX-License-Identifier: MIT
// A small triangle on the screen: edge functions and 1/t in float, with bounds. Set up across triangles or for one
// triangle, over lanes F. Its verdicts are certain or "doubtful", and doubtful samples are asked exactly
// (visibility.h): no bit of what is computed here reaches the frame.
//
// With all corners placed, E_k(s) = (x_i - s.x)(y_j - y_i) - (x_j - x_i)(y_i - s.y), k, i, j cyclic, has the sign of
// visibility.h's d . (a_i x a_j): the two differ by the factor of three positive depths, since (r, -u, f) is right-handed.
#pragma once

#include <array>

#include "common/math/lane_ops.h"
#include "common/model/ray_sheet.h"

namespace sidelight::raster {

// Coordinates are exact in float up to this extent in units.
inline constexpr int kSmallExtent = (1 << 24) - 4;

template <class F>
struct ScreenTriangle {
  std::array<F, 3> dx, dy;  // of edge k, from corner k + 1 to k + 2, turned so that E_k >= 0 inside
  F area;                   // E_0 + E_1 + E_2 > 0
  F doubt;                  // an |E_k| or area not above this may have either sign
  F w0, slope1, slope2;     // 1/t = w0 + E_1 slope1 + E_2 slope2
  Mask<F> front;            // the outward side is seen (visibility.h, view_side())
  Mask<F> sure_side, sure_depth;
};

// Bound. Let ex, ey < 2^24 be the extent of the corners; a sample of the box lies at most a unit outside. A corner is up
// to 3/4 unit off in x and y. E_k is bilinear: by the corner's offset from the sample it is off by
// (3/4) times |dx| + |dy| <= ex + ey, by the edge's two ends by 2 (3/4) times (ex + 1) + (ey + 1), and 4 (3/4)² in second
// order: 2.25 (ex + ey) + 5.25 in all. Differences are exact in float; the two products and their difference round by at
// most 4 * 2^-24 (ex + 1)(ey + 1) <= 2 (ex + ey) + 1. The area is a value of E_k, at a corner.
// Depth: the two lambdas E_k/area are off by 2 doubt/area each, times the range of w, plus 2^-21 w for roundings.
// `Set`, in the name only, keeps apart what is compiled for several instruction sets (tests/test_arrows.cpp).
template <class F, class Set = F>
ScreenTriangle<F> screen_triangle(const std::array<Ints<F>, 3>& x, const std::array<Ints<F>, 3>& y,
                                  const std::array<F, 3>& w) {
  ScreenTriangle<F> t;
  const auto span = [](const auto& v) {
    return to_real<F>(lane_max(lane_max(v[0], v[1]), v[2]) - lane_min(lane_min(v[0], v[1]), v[2]));
  };
  t.doubt = F(5) * ((span(x) + span(y)) + F(2));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    t.dx[k] = to_real<F>(Ints<F>(x[j] - x[i]));
    t.dy[k] = to_real<F>(Ints<F>(y[j] - y[i]));
  }
  const F area = t.dx[1] * t.dy[2] - t.dx[2] * t.dy[1];
  t.front = area < F(0);
  const F turn = select<F>(t.front, F(-1), F(1));
  for (std::size_t k = 0; k < 3; ++k) {
    t.dx[k] = turn * t.dx[k];
    t.dy[k] = turn * t.dy[k];
  }
  t.area = turn * area;
  t.sure_side = t.area > t.doubt;

  const F per_area = F(1) / select<F>(t.sure_side, t.area, F(1));
  const F w_max = lane_max(lane_max(w[0], w[1]), w[2]), w_min = lane_min(lane_min(w[0], w[1]), w[2]);
  t.w0 = w[0];
  t.slope1 = (w[1] - w[0]) * per_area;
  t.slope2 = (w[2] - w[0]) * per_area;
  const F error = F(4) * t.doubt * per_area * (w_max - w_min) + F(0x1p-21f) * w_max;
  t.sure_depth = t.sure_side && error <= F(kFloatDepthError) * w_min;
  return t;
}

}  // namespace sidelight::raster
