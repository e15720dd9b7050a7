// SPDX-License-Identifier: MIT
// exp and log1p over lanes, written here because libm's differ from machine to machine and from lane to lane, and a
// picture must not. Plain series on a reduced range, operations in one fixed order; the truncation error of each is
// below half an ulp of the element type, the rest is rounding (bounds measured by tests/math/test_lane_math.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "common/math/lane_ops.h"

namespace sidelight {

namespace detail {
template <class T>
struct Series;
template <>
struct Series<float> {
  static constexpr int kExpTerms = 7;    // (ln 2 / 2)^8 / 8! = 5e-9
  static constexpr int kAtanhTerms = 4;  // 0.1716^10 / 11 = 2e-9 relative
  // e^kExpLow is the least result, a normal number: below, n rounds to 1 - kBias, and so it does of kExpNone.
  static constexpr float kExpLow = -0x1.5bf5bap+6f, kExpNone = -87.25f, kExpHigh = 88.0f;
  static constexpr int kMantissaBits = 23, kBias = 127;
  static constexpr float kRound = 0x1.8p23f;  // x + kRound has the nearest whole number in its low bits
  static constexpr float kLn2High = 0x1.62e4p-1f, kLn2Low = 0x1.7f7d1cp-20f;  // n * high is exact
};
template <>
struct Series<double> {
  static constexpr int kExpTerms = 13;   // (ln 2 / 2)^14 / 14! = 4e-18
  static constexpr int kAtanhTerms = 9;  // 0.1716^20 / 21 = 2e-17 relative
  static constexpr double kExpLow = -0x1.62066151add8bp+9, kExpNone = -708.25, kExpHigh = 709.0;
  static constexpr int kMantissaBits = 52, kBias = 1023;
  static constexpr double kRound = 0x1.8p52;
  static constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
};

// 1/2!, 1/3!, ...: e^x = 1 + x + x² (1/2! + x/3! + ...).
template <class T>
constexpr auto exp_series() {
  std::array<T, Series<T>::kExpTerms - 1> c{};
  double factorial = 2;
  for (std::size_t k = 0; k < c.size(); factorial *= static_cast<double>(++k + 2)) c[k] = T(1 / factorial);
  return c;
}
// 2/3, 2/5, ...: 2 atanh(s) = 2 s + s (2/3 s² + 2/5 s⁴ + ...).
template <class T>
constexpr auto atanh_series() {
  std::array<T, Series<T>::kAtanhTerms> c{};
  for (std::size_t k = 0; k < c.size(); ++k) c[k] = T(2) / T(2 * k + 3);
  return c;
}
}  // namespace detail

// c[0] + c[1] x + c[2] x² + ..., by pairs, pairs of pairs and so on (G. Estrin, "Organization of computer systems: the
// fixed plus variable structure computer", 1960): a chain of log2(terms) steps, where Horner's is as long as the series.
template <class F, class C, std::size_t kSize>
F polynomial(const F& x, const std::array<C, kSize>& c) {
  if constexpr (kSize == 1) {
    return F(c[0]);
  } else {
    std::array<F, (kSize + 1) / 2> pairs;
    for (std::size_t i = 0; i < kSize / 2; ++i) pairs[i] = fused<F>(F(c[2 * i + 1]), x, F(c[2 * i]));
    if constexpr (kSize % 2 == 1) pairs[kSize / 2] = F(c[kSize - 1]);
    return polynomial<F>(x * x, pairs);
  }
}

// e^x for x <= kExpHigh; 0 below kExpLow, where results would turn subnormal. Relative error: float 2 ulp, double 2 ulp.
template <class F>
F lane_exp(const F& x) {
  using S = detail::Series<Scalar<F>>;
  using T = Scalar<F>;
  // x = n ln 2 + r, |r| <= ln 2 / 2 (and a little)
  const F known = lane_max<F>(x, F(S::kExpNone));
  const F rounded = fused<F>(known, F(T(1.442695040888963407)), F(S::kRound));
  const F n = rounded - F(S::kRound);
  const F r = fused<F>(n, F(-S::kLn2Low), fused<F>(n, F(-S::kLn2High), known));
  constexpr auto kSeries = detail::exp_series<T>();
  // 2^(n-1) from the low bits of `rounded`; of the least n, 1 - kBias, these are the bits of 0.
  using Bits = decltype(to_bits(x));
  const F half_power =
      from_bits<F>((to_bits<F>(rounded) << S::kMantissaBits) + (Bits(S::kBias - 1) << S::kMantissaBits));
  // Roundings, in ulp of the result: 1/4 in r, 1/4 and 1/2 in the last two sums, below 1/8 in all others together.
  const F exp_r = F(1) + fused<F>(r * r, polynomial<F>(r, kSeries), r);
  return (exp_r + exp_r) * half_power;
}

// log(1 + x) for -1 < x <= 1. Relative error: float 4 ulp, double 4 ulp, for tiny x too. Of -1 it is some number below
// all others.
template <class F>
F lane_log1p(const F& x) {
  using S = detail::Series<Scalar<F>>;
  using T = Scalar<F>;
  using Bits = decltype(to_bits(x));
  // 1 + x = u + lost, u rounded; u = 2^k m with m in [sqrt(1/2), sqrt(2))
  const F u = F(1) + x;
  const F lost = x - (u - F(1));
  const Bits sqrt_half = to_bits<F>(F(T(0.70710678118654752440)));
  const Bits k = (to_bits<F>(u) - sqrt_half) >> S::kMantissaBits;
  const F m = from_bits<F>(to_bits<F>(u) - (k << S::kMantissaBits));
  const F down = from_bits<F>((Bits(S::kBias) - k) << S::kMantissaBits);  // 2^-k
  const F f = fused<F>(lost, down, m - F(1));                             // (1 + x) / 2^k - 1
  // log(1 + f) = 2 atanh(s), s = f/(2 + f), |s| <= 0.1716; and 2 s = f - s f, where f is better known than s
  const F s = f / (F(2) + f);
  const F s2 = s * s;
  constexpr auto kSeries = detail::atanh_series<T>();
  const F log_f = fused<F>(-s, fused<F>(-s2, polynomial<F>(s2, kSeries), f), f);
  const F k_real = to_real<F>(k);
  return fused<F>(k_real, F(S::kLn2High), fused<F>(k_real, F(S::kLn2Low), log_f));
}

}  // namespace sidelight
