// SPDX-License-Identifier: MIT
// The error bounds that lane_math.h states, against libm in long double (64 bits of mantissa: its own error
// is below 2^-10 ulp of a double), and the promise that a wide lane holds the bits of the scalar.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "common/math/lane_math.h"
#include "tests/support/random.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

template <class T>
using Limits = std::numeric_limits<T>;
template <class T>
using Series = detail::Series<T>;

// |computed - exact| in units of the last place that T has at `exact`.
template <class T>
double ulps_off(T computed, long double exact) {
  if (exact == 0) return computed == 0 ? 0 : Limits<double>::infinity();
  const int exponent = std::max(std::ilogb(exact), Limits<T>::min_exponent - 1);
  return static_cast<double>(
      std::ldexp(std::abs(static_cast<long double>(computed) - exact), Limits<T>::digits - 1 - exponent));
}

// From tiny to large magnitudes, either sign, where `limit` is the largest.
template <class T>
T any_magnitude(Random& random, double limit) {
  const double x = random.log_uniform(static_cast<double>(Limits<T>::min()), limit);
  return static_cast<T>(random.uniform() < 0.5 ? -x : x);
}

// Bits are compared, since that is the promise; a NaN would then equal itself, so there must be none.
template <class F, class Function>
std::uint64_t lanes_unlike_scalar(const Function& function, const std::array<Scalar<F>, 64>& x) {
  using T = Scalar<F>;
  std::uint64_t differing = 0;
  for (std::size_t i = 0; i < x.size(); i += static_cast<std::size_t>(kLanes<F>)) {
    std::array<T, 64> wide{};
    store<F>(function(load<F>(&x[i])), &wide[0]);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(kLanes<F>); ++lane) {
      const T scalar = function(x[i + lane]);
      differing += std::isnan(scalar) || to_bits(wide[lane]) != to_bits(scalar);
    }
  }
  return differing;
}

template <class F>
std::uint64_t lanes_unlike_scalar() {
  using T = Scalar<F>;
  static_assert(kLanes<F> > 1);
  const auto exponential = []<class G>(const G& x) { return lane_exp<G>(x); };
  const auto logarithm = []<class G>(const G& x) { return lane_log1p<G>(x); };
  Random random(3);
  std::uint64_t differing = 0;
  for (std::uint64_t batches = tier_count("rays_per_case") / 64; batches > 0; --batches) {
    std::array<T, 64> exponent, fraction;  // lanes that underflow beside others
    for (T& x : exponent) x = static_cast<T>(random.uniform(1.1 * Series<T>::kExpLow, Series<T>::kExpHigh));
    for (T& x : fraction)
      x = random.uniform() < 0.5 ? any_magnitude<T>(random, 0.5)
                                 : static_cast<T>(-1 + std::exp2(-random.uniform(0, 20)));
    differing += lanes_unlike_scalar<F>(exponential, exponent) + lanes_unlike_scalar<F>(logarithm, fraction);
  }
  return differing;
}

}  // namespace

// (1 + u)² - (1 + 2 u) is u²; a product that is rounded first loses it.
TEST_CASE_TEMPLATE("fused() rounds once, in lanes too", T, float, double) {
  constexpr T u = Limits<T>::epsilon();
  const auto rest = [](auto one_and) {
    using F = decltype(one_and);
    return fused<F>(one_and, one_and, F(-1 - 2 * u));
  };
  CHECK(rest(1 + u) == u * u);
  const stdx::native_simd<T> lanes = rest(stdx::native_simd<T>(1 + u));
  CHECK(stdx::all_of(lanes == u * u));
}

TEST_CASE_TEMPLATE("lane_exp is within 2 ulp from underflow to overflow", T, float, double) {
  Random random(1);
  double worst = 0;
  const auto measure = [&](T x) {
    worst = std::max(worst, ulps_off(lane_exp(x), std::exp(static_cast<long double>(x))));
  };
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    measure(static_cast<T>(random.uniform(Series<T>::kExpLow, Series<T>::kExpHigh)));
    measure(any_magnitude<T>(random, 1));
  }
  // Around the odd multiples of ln 2 / 2, where the reduction turns to the next power of two.
  for (int n = -120; n <= 120; ++n)
    for (const double aside : {-1e-3, -1e-6, 0.0, 1e-6, 1e-3})
      measure(static_cast<T>((n + 0.5) * 0.69314718055994531 + aside));
  CAPTURE(worst);
  CHECK(worst <= 2);
}

TEST_CASE_TEMPLATE("lane_log1p is within 4 ulp over its range, next to 0 and to -1 too", T, float, double) {
  Random random(2);
  double worst = 0;
  const auto measure = [&](T x) {
    worst = std::max(worst, ulps_off(lane_log1p(x), std::log1p(static_cast<long double>(x))));
  };
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    if (const T x = static_cast<T>(random.uniform(-1, 1)); x > -1) measure(x);
    measure(any_magnitude<T>(random, 0.5));
    measure(static_cast<T>(-1 + std::exp2(-random.uniform(1, Limits<T>::digits - 1))));
  }
  // Around 1 + x = sqrt(1/2), where the reduction turns to the next power of two.
  for (int i = -1000; i <= 1000; ++i) measure(static_cast<T>(std::sqrt(0.5) - 1 + i * 1e-9));
  CAPTURE(worst);
  CHECK(worst <= 4);
}

TEST_CASE_TEMPLATE("lane_exp at its edges", T, float, double) {
  const T low = Series<T>::kExpLow;
  CHECK(lane_exp(T(0)) == 1);
  CHECK(lane_exp(T(-0.0)) == 1);
  CHECK(lane_exp(Limits<T>::denorm_min()) == 1);
  CHECK(std::isnormal(lane_exp(low)));
  CHECK(lane_exp(std::nextafter(low, -Limits<T>::infinity())) == 0);
  CHECK(lane_exp(Limits<T>::lowest()) == 0);
  CHECK(lane_exp(-Limits<T>::infinity()) == 0);
  CHECK(std::isfinite(lane_exp(Series<T>::kExpHigh)));
}

TEST_CASE_TEMPLATE("lane_log1p at its edges", T, float, double) {
  CHECK(lane_log1p(T(0)) == 0);
  CHECK(lane_log1p(T(-0.0)) == 0);
  // x - x²/2 is x for |x| below half an ulp of 1.
  for (const T x : {Limits<T>::denorm_min(), Limits<T>::min(), Limits<T>::epsilon() / 4}) {
    CHECK(lane_log1p(x) == x);
    CHECK(lane_log1p(-x) == -x);
  }
  CHECK(ulps_off(lane_log1p(T(1)), std::log(2.0L)) <= 4);
  const T nearest =
      T(-1) + Limits<T>::epsilon() / 2;  // next to -1: 1 + x = 2^-digits, the result -digits ln 2
  CHECK(ulps_off(lane_log1p(nearest), -Limits<T>::digits * std::log(2.0L)) <= 4);
}

TEST_CASE("every lane of lane_exp and lane_log1p has the bits of the scalar") {
  CHECK(lanes_unlike_scalar<stdx::native_simd<float>>() == 0);
#ifndef __clang__  // which the >> of 64-bit lanes in GCC 12's <experimental/simd> gives nonsense; no kernel shifts those
  CHECK(lanes_unlike_scalar<stdx::native_simd<double>>() == 0);
#endif
}
