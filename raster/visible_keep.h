// SPDX-License-Identifier: MIT
// What small triangles (visible_small.h) and large surfaces (visible_large.h) share when they are drawn into a tile's
// z-buffer, as many samples at a time as F has lanes. All three are included only by kernels_scalar.cpp,
// kernels_avx2.cpp and kernels_avx512.cpp.
#pragma once

#include <bit>

#include "raster/kernels.h"
#include "raster/screen_triangle.h"

namespace sidelight::raster {

// A vector is a stamp, its upper rows, or a sample of it.
template <class F>
inline constexpr int kVectorColumns = std::min(kLanes<F>, TileView::kStamp);
template <class F>
inline constexpr int kVectorRows = kLanes<F> / kVectorColumns<F>;

// Of each lane's sample, from the vector's first.
template <class F>
F lane_columns() {
  return generate<F>([](int lane) { return static_cast<float>(lane % kVectorColumns<F>); });
}
template <class F>
F lane_rows() {
  return generate<F>([](int lane) { return static_cast<float>(lane / kVectorColumns<F>); });
}

// ask(X, Y, lane) in the lanes where `mask` holds, of the vector whose first sample is (X0, Y0).
template <class F, class Ask>
void for_each_lane(const Mask<F>& mask, int X0, int Y0, const Ask& ask) {
  for (std::uint32_t bits = mask_bits<F>(mask); bits != 0; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    ask(X0 + lane % kVectorColumns<F>, Y0 + lane / kVectorColumns<F>, lane);
  }
}

// Keeps the primitive where it is covered and surely nearer than what the samples hold. Returns where the order is
// doubtful: also where w is not a number, which is how a caller says that it is not sure of it. `held` becomes what they
// hold now. Without a branch: who wins is hard to foresee.
template <class F>
Mask<F> keep_nearer(const TileView& tile, int index, std::uint32_t primitive, const Mask<F>& covered,
                    const F& w, F& held) {
  auto* const ids = reinterpret_cast<std::int32_t*>(tile.primitive + index);
  held = load<F>(tile.w + index);
  const Mask<F> nearer = covered && w > held * F(kSurely);
  const Mask<F> farther = w * F(kSurely) < held;
  held = select<F>(nearer, w, held);
  store(held, tile.w + index);
  const F id = from_bits<F>(Ints<F>(static_cast<std::int32_t>(primitive)));
  store(to_bits<F>(select<F>(nearer, id, from_bits<F>(load<Ints<F>>(ids)))), ids);
  return covered && !(nearer || farther);
}

// Asks exactly about the order where `mask` holds.
template <class F>
void order_lanes_exactly(const TileView& tile, std::uint32_t primitive, int X0, int Y0, const Mask<F>& mask,
                         const F& w) {
  alignas(64) float ws[kLanes<F>];
  store(w, ws);
  for_each_lane<F>(mask, X0, Y0,
                   [&](int X, int Y, int lane) { order_exactly(tile, primitive, X, Y, ws[lane]); });
}

}  // namespace sidelight::raster
