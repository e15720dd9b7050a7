// SPDX-License-Identifier: MIT
// The one SIMD wrapper. Hot code is written once over a lane type F and instantiated for float (the readable twin and
// the oracle of the others), for double, and for std::experimental::simd of each instruction set; every instance
// gives the same bits per lane, since all operations used are correctly rounded, and where one is fused it is in every
// instance.
//
// Why std::experimental::simd (Parallelism TS 2, in libstdc++) rather than Highway: it has ordinary operators, so a
// kernel reads like its scalar twin and *is* it; the lane type carries its ABI, so instances for several instruction
// sets live in one program without sharing a symbol (tests/test_arrows.cpp checks that); nothing to install.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <experimental/simd>
#ifdef __FMA__
#include <immintrin.h>
#endif

namespace sidelight {

namespace stdx = std::experimental;

// Scalar: the element type. Mask: the type of a comparison. kCount: how many.
template <class F>
struct LaneTraits {
  using Scalar = F;
  using Mask = bool;
  static constexpr int kCount = 1;
};
template <class T, class Abi>
struct LaneTraits<stdx::simd<T, Abi>> {
  using Scalar = T;
  using Mask = stdx::simd_mask<T, Abi>;
  static constexpr int kCount = static_cast<int>(stdx::simd<T, Abi>::size());
};
template <class F>
using Scalar = typename LaneTraits<F>::Scalar;
template <class F>
using Mask = typename LaneTraits<F>::Mask;
template <class F>
inline constexpr int kLanes = LaneTraits<F>::kCount;

// Lanes of floats in as many bytes as F, lanes of doubles, has; twice as many.
template <class F>
struct FloatLanesOf {
  using Type = float;
};
template <class Abi>
struct FloatLanesOf<stdx::simd<double, Abi>> {
  using Type = stdx::simd<float, Abi>;
};
template <class F>
using FloatLanes = typename FloatLanesOf<F>::Type;

template <class F>
F select(const Mask<F>& mask, const F& if_true, const F& if_false) {
  if constexpr (kLanes<F> == 1) {
    return mask ? if_true : if_false;
  } else {
    F result = if_false;
    stdx::where(mask, result) = if_true;
    return result;
  }
}

template <class F>
F load(const Scalar<F>* from) {
  if constexpr (kLanes<F> == 1)
    return *from;
  else
    return F(from, stdx::element_aligned);
}

template <class F>
void store(const F& value, Scalar<F>* to) {
  if constexpr (kLanes<F> == 1)
    *to = value;
  else
    value.copy_to(to, stdx::element_aligned);
}

template <class F>
F square_root(const F& x) {
  using std::sqrt;
  using stdx::sqrt;
  return sqrt(x);
}

// a b + c, rounded once where the lanes' instruction set can, else twice: for filters only, whose verdicts a bound
// certifies either way.
template <class F>
[[gnu::always_inline]] inline F mul_add(const F& a, const F& b, const F& c) {
#ifdef __FMA__
  constexpr bool kSingle = sizeof(Scalar<F>) == 4;
  if constexpr (sizeof(F) == 64 && kSingle)
    return F(_mm512_fmadd_ps(std::bit_cast<__m512>(a), std::bit_cast<__m512>(b), std::bit_cast<__m512>(c)));
  else if constexpr (sizeof(F) == 64)
    return F(
        _mm512_fmadd_pd(std::bit_cast<__m512d>(a), std::bit_cast<__m512d>(b), std::bit_cast<__m512d>(c)));
  else if constexpr (sizeof(F) == 32 && kSingle)
    return F(_mm256_fmadd_ps(std::bit_cast<__m256>(a), std::bit_cast<__m256>(b), std::bit_cast<__m256>(c)));
  else if constexpr (sizeof(F) == 32)
    return F(
        _mm256_fmadd_pd(std::bit_cast<__m256d>(a), std::bit_cast<__m256d>(b), std::bit_cast<__m256d>(c)));
#endif
  return a * b + c;
}

// The bits of F as signed integers of its element's size, and back.
template <class F>
auto to_bits(const F& x) {
  using Int = std::conditional_t<sizeof(Scalar<F>) == 4, std::int32_t, std::int64_t>;
  if constexpr (kLanes<F> == 1)
    return std::bit_cast<Int>(x);
  else
    return std::bit_cast<stdx::rebind_simd_t<Int, F>>(x);
}
template <class F, class Bits>
F from_bits(const Bits& bits) {
  return std::bit_cast<F>(bits);
}

// From integers of F's size to F, lane by lane.
template <class F, class Bits>
F to_real(const Bits& i) {
  if constexpr (kLanes<F> == 1)
    return static_cast<F>(i);
  else
    return stdx::static_simd_cast<F>(i);
}

// From doubles F to floats, lane by lane, each rounded once; and back.
template <class F>
auto to_float(const F& x) {
  if constexpr (kLanes<F> == 1)
    return static_cast<float>(x);
  else
    return stdx::static_simd_cast<stdx::rebind_simd_t<float, F>>(x);
}
template <class F, class Floats>
F to_double(const Floats& x) {
  if constexpr (kLanes<F> == 1)
    return static_cast<double>(x);
  else
    return stdx::static_simd_cast<F>(x);
}

// Floats beside doubles F, lane for lane.
template <class F>
using FloatBeside = decltype(to_float<F>(F{}));

}  // namespace sidelight
