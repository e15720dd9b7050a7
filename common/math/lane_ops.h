// SPDX-License-Identifier: MIT
// What kernels ask of lanes beyond arithmetic (lanes.h): extremes, questions about masks, numbered lanes, and integers
// beside the reals. Each is exact, or rounded once, so that every lane type gives the same bits.
#pragma once

#include <algorithm>

#include "common/math/lanes.h"

namespace sidelight {

// Signed integers of the element's size beside F, lane for lane: 32 bits for floats, 64 for doubles.
template <class F>
using Ints = decltype(to_bits(F{}));

// The smaller (greater) of each lane; a where they compare equal. Not for NaN.
template <class F>
[[gnu::always_inline]] inline F lane_min(const F& a, const F& b) {
  if constexpr (kLanes<F> == 1)
    return b < a ? b : a;
  else
    return stdx::min(b, a);  // one instruction, which keeps its second operand where they compare equal
}
template <class F>
[[gnu::always_inline]] inline F lane_max(const F& a, const F& b) {
  if constexpr (kLanes<F> == 1)
    return a < b ? b : a;
  else
    return stdx::max(b, a);
}
template <class F>
[[gnu::always_inline]] inline F lane_abs(const F& a) {
  return lane_max<F>(a, -a);
}

// a b + c, rounded once whatever the instruction set: for what reaches the frame. (Where the processor does not fuse, the C
// library does, and takes its time.)
template <class F>
[[gnu::always_inline]] inline F fused(const F& a, const F& b, const F& c) {
#ifdef __FMA__
  if constexpr (sizeof(F) == 32 || sizeof(F) == 64) return mul_add<F>(a, b, c);
#endif
  using std::fma;
  using stdx::fma;
  return fma(a, b, c);
}

// The whole number not below (above) each lane.
template <class F>
F lane_ceil(const F& a) {
  using std::ceil;
  using stdx::ceil;
  return ceil(a);
}
template <class F>
F lane_floor(const F& a) {
  using std::floor;
  using stdx::floor;
  return floor(a);
}

// Of a mask of F's lanes: whether any holds, and how many do.
template <class F>
[[gnu::always_inline]] inline bool any(const Mask<F>& mask) {
  if constexpr (kLanes<F> == 1)
    return mask;
  else
    return stdx::any_of(mask);
}
template <class F>
int count(const Mask<F>& mask) {
  if constexpr (kLanes<F> == 1)
    return mask ? 1 : 0;
  else
    return stdx::popcount(mask);
}

// Of each 64-bit integer beside doubles F, the lower half.
template <class F>
auto low_halves(const Ints<F>& bits) {
  if constexpr (kLanes<F> == 1)
    return static_cast<std::int32_t>(bits);
  else
    return stdx::static_simd_cast<stdx::rebind_simd_t<std::int32_t, F>>(bits);
}

// One bit for each of F's lanes, the first lane's lowest.
template <class F>
[[gnu::always_inline]] inline std::uint32_t mask_bits(const Mask<F>& mask) {
  static_assert(kLanes<F> <= 32);
  if constexpr (kLanes<F> == 1)
    return mask ? 1 : 0;
  else if constexpr (kLanes<F> <= 8)
    // GCC 12 may keep such a mask in memory as one byte and read four.
    return static_cast<std::uint8_t>(mask.__to_bitset().to_ulong());
  else
    return static_cast<std::uint32_t>(mask.__to_bitset().to_ulong());
}

// Writes the integers where the mask of F's lanes holds, one after the other, and returns how many; what follows them, up
// to kLanes<F> in all, may be overwritten.
template <class F>
[[gnu::always_inline]] inline std::size_t store_some(const Mask<F>& mask, const Ints<F>& values,
                                                     std::int32_t* to) {
  std::uint32_t bits = mask_bits<F>(mask);
  const auto count = static_cast<std::size_t>(std::popcount(bits));
#ifdef __AVX512F__
  if constexpr (sizeof(F) == 64) {
    _mm512_storeu_si512(
        to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), std::bit_cast<__m512i>(values)));
    return count;
  }
#endif
#ifdef __AVX512VL__
  if constexpr (sizeof(F) == 32) {
    _mm256_storeu_si256(
        reinterpret_cast<__m256i*>(to),
        _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), std::bit_cast<__m256i>(values)));
    return count;
  }
#endif
  alignas(64) std::int32_t lanes[kLanes<F>];
  store(values, lanes);
  for (; bits != 0; bits &= bits - 1) *to++ = lanes[std::countr_zero(bits)];
  return count;
}

// A mask of F's lanes as one of the integers beside them.
template <class F>
Mask<Ints<F>> integer_mask(const Mask<F>& mask) {
  if constexpr (kLanes<F> == 1)
    return mask;
  else
    return to_bits<F>(select<F>(mask, F(1), F(0))) != Ints<F>(0);
}

// And back.
template <class F>
Mask<F> real_mask(const Mask<Ints<F>>& mask) {
  if constexpr (kLanes<F> == 1)
    return mask;
  else
    return from_bits<F>(select<Ints<F>>(mask, Ints<F>(1), Ints<F>(0))) != F(0);
}

// The sum of all lanes of integers, in no order that could matter.
template <class I>
std::uint64_t sum(const I& a) {
  if constexpr (kLanes<I> == 1)
    return static_cast<std::uint64_t>(a);
  else
    return static_cast<std::uint64_t>(stdx::reduce(a));
}

// The least of all lanes.
template <class F>
Scalar<F> least(const F& a) {
  if constexpr (kLanes<F> == 1)
    return a;
  else
    return stdx::hmin(a);
}

// of(lane) in each lane.
template <class F, class Of>
F generate(const Of& of) {
  if constexpr (kLanes<F> == 1)
    return of(0);
  else
    return F([&](auto lane) { return of(static_cast<int>(lane)); });
}

// 0, 1, 2, ... as numbers.
template <class F>
F lane_numbers() {
  return generate<F>([](int lane) { return static_cast<Scalar<F>>(lane); });
}

}  // namespace sidelight
