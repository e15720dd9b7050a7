// SPDX-License-Identifier: MIT
// What small triangles (visible_small.h) and large surfaces (visible_large.h) share when they are drawn into a tile's
// z-buffer, a row of samples in as many lanes as F has. All three are included only by kernels_scalar.cpp,
// kernels_avx2.cpp and kernels_avx512.cpp.
#pragma once

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

}  // namespace sidelight::raster
