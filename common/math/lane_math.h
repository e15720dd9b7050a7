// SPDX-License-Identifier: MIT
// exp and log1p over lanes, written here because libm's differ from machine to machine and from lane to lane, and a
// picture must not. Plain series on a reduced range, operations in one fixed order; the truncation error of each is
// below half an ulp of the element type, the rest is rounding (bounds measured by tests/math/test_lane_math.cpp).
#pragma once

#include <limits>

#include "common/math/lanes.h"

namespace sidelight {

namespace detail {
template <class T>
struct Series;
template <>
struct Series<float> {
  static constexpr int kExpTerms = 8;        // (ln 2 / 2)^8 / 8! = 5e-9
  static constexpr int kAtanhTerms = 6;      // 0.1716^12 / 13 = 5e-11 relative
  static constexpr float kExpLow = -87.0f, kExpHigh = 88.0f;   // results stay normal
  static constexpr int kMantissaBits = 23, kBias = 127;
  static constexpr float kLn2High = 0x1.62e4p-1f, kLn2Low = 0x1.7f7d1cp-20f;   // high part has room for n * high
};
template <>
struct Series<double> {
  static constexpr int kExpTerms = 14;       // (ln 2 / 2)^14 / 14! = 4e-18
  static constexpr int kAtanhTerms = 12;     // 0.1716^24 / 25 = 2e-20 relative
  static constexpr double kExpLow = -708.0, kExpHigh = 709.0;
  static constexpr int kMantissaBits = 52, kBias = 1023;
  static constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
};
}  // namespace detail

// e^x for x <= kExpHigh; 0 below kExpLow, where results would turn subnormal. Relative error: float 2 ulp, double 2 ulp.
template <class F>
F lane_exp(const F& x) {
  using S = detail::Series<Scalar<F>>;
  using T = Scalar<F>;
  // x = n ln 2 + r, |r| <= ln 2 / 2 (and a little)
  const Mask<F> underflow = x < F(S::kExpLow);
  const F safe = select<F>(underflow, F(0), x);
  const F scaled = safe * F(T(1.442695040888963407));
  const auto n = to_integer<F>(scaled + select<F>(scaled < F(0), F(T(-0.5)), F(T(0.5))));
  const F n_real = to_real<F>(n);
  const F r = (safe - n_real * F(S::kLn2High)) - n_real * F(S::kLn2Low);
  // e^r = 1 + r (1 + r/2 (1 + r/3 (...)))
  F sum = F(1);
  for (int k = S::kExpTerms; k >= 1; --k) sum = F(1) + r * sum * F(T(1) / T(k));
  const F power = from_bits<F>((n + S::kBias) << S::kMantissaBits);
  return select<F>(underflow, F(0), sum * power);
}

// log(1 + x) for -1 < x <= 1. Relative error: float 4 ulp, double 4 ulp, for tiny x too.
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
  // log m = 2 atanh(s) = 2 s (1 + s²/3 + s⁴/5 + ...), s = (m - 1)/(m + 1), |s| <= 0.1716
  const F s = (m - F(1)) / (m + F(1));
  const F s2 = s * s;
  F sum = F(0);
  for (int i = S::kAtanhTerms; i >= 1; --i) sum = s2 * (sum + F(T(1) / T(2 * i + 1)));
  const F log_m = F(2) * s + F(2) * s * sum;
  const F k_real = to_real<F>(k);
  // log(u + lost) = log u + lost / u, to first order in a rounding error
  return (k_real * F(S::kLn2High) + (log_m + (k_real * F(S::kLn2Low) + lost / u)));
}

}  // namespace sidelight
