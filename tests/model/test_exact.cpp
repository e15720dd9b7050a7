// SPDX-License-Identifier: MIT
// Expansions against 128-bit integers (exact) and 113-bit floats: signs of nearly vanishing determinants,
// areas and collinearity, and quotients rounded once.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/exact.h"
#include "tests/support/random.h"
#include "tests/support/wide.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

using exact::determinant_sign;
using exact::orientation;

constexpr std::int64_t kGrid = std::int64_t{1}
                               << 36;  // a, b; c = i a + j b + 0 or 1 stays below 2^40: 6 · 2^112 fits

// c = i a + j b, plus 1 in one coordinate or none: the determinant is 0 or one cofactor.
struct Triple {
  glm::dvec3 a, b, c;
};
Triple nearly_dependent(Random& random) {
  Triple t{random.on_grid(kGrid), random.on_grid(kGrid), {}};
  t.c = static_cast<double>(random.integer(3)) * t.a + static_cast<double>(random.integer(3)) * t.b;
  const std::uint32_t nudged = random.below(4);
  if (nudged < 3) t.c[static_cast<int>(nudged)] += random.uniform() < 0.5 ? 1 : -1;
  return t;
}

int sign_in_integers(const Triple& t) {
  return sign_of(determinant(integers(t.a), integers(t.b), integers(t.c)));
}
int sign_in_double(const Triple& t) { return sign_of(glm::dot(t.a, glm::cross(t.b, t.c))); }

// Between 1e-46 and 1e15 for the numbers that `scale` meets: 2^-153 to 2^49.
double power_between(Random& random, int low, int high) {
  return std::ldexp(1.0, low + static_cast<int>(random.below(static_cast<std::uint32_t>(high - low + 1))));
}

// A determinant whose value is x y z.
exact::Determinant product(double x, double y, double z) {
  return exact::determinant({x, 0, 0}, {0, y, 0}, {0, 0, z});
}
const exact::Determinant kZero{};

// numerator / denominator, rounded once to nearest even: long division to 55 bits or more, then a sticky bit.
// Both positive, the denominator below 2^70.
double rounded_by_integers(Int128 numerator, Int128 denominator) {
  const auto bits = [](Int128 x) {
    int n = 0;
    for (; x > 0; x >>= 1) ++n;
    return n;
  };
  const int shift = 55 - (bits(numerator) - bits(denominator));
  const Int128 scaled = shift >= 0 ? numerator << shift : numerator;
  const Int128 divisor = shift >= 0 ? denominator : denominator << -shift;
  Int128 quotient = scaled / divisor;  // 55 or 56 bits
  const bool more = scaled % divisor != 0;
  const int dropped = bits(quotient) - 53;
  const Int128 half = Int128{1} << (dropped - 1), rest = quotient & (2 * half - 1);
  quotient >>= dropped;
  if (rest > half || (rest == half && (more || (quotient & 1) != 0))) ++quotient;
  return std::ldexp(static_cast<double>(static_cast<std::int64_t>(quotient)), dropped - shift);
}

}  // namespace

TEST_CASE("determinant_sign is that of 128-bit integers, at and next to zero") {
  Random random(1);
  std::uint64_t wrong = 0, zero = 0, fooled = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const Triple t = nearly_dependent(random);
    const int expected = sign_in_integers(t);
    wrong += determinant_sign(t.a, t.b, t.c) != expected;
    zero += expected == 0;
    fooled += sign_in_double(t) != expected;

    const Triple free{random.on_grid(kGrid), random.on_grid(kGrid), random.on_grid(kGrid)};
    wrong += determinant_sign(free.a, free.b, free.c) != sign_in_integers(free);
  }
  CHECK(wrong == 0);
  CHECK(zero > 0);
  CHECK(fooled > 0);  // the cases are hard: plain double gets some wrong
}

TEST_CASE("determinant_sign does not change with the scale of rows and columns from 1e-46 to 1e15") {
  Random random(2);
  std::uint64_t wrong = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    Triple t = nearly_dependent(random);
    const int expected = sign_in_integers(t);
    for (int axis = 0; axis < 3; ++axis) {
      const double scale = power_between(random, -70, 5);
      for (glm::dvec3* v : {&t.a, &t.b, &t.c}) (*v)[axis] *= scale;
    }
    for (glm::dvec3* v : {&t.a, &t.b, &t.c}) *v *= power_between(random, -80, 3);
    wrong += determinant_sign(t.a, t.b, t.c) != expected;
  }
  CHECK(wrong == 0);
}

TEST_CASE("a last bit of a full mantissa decides") {
  // det(a, b, a + one ulp in coordinate i) = ulp (a x b)_i, of two products of 53-bit integers.
  Random random(3);
  std::uint64_t wrong = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    constexpr std::int64_t kMantissa = (std::int64_t{1} << 53) - 1;
    const glm::dvec3 a = random.on_grid(kMantissa), b = random.on_grid(kMantissa);
    glm::dvec3 c = a;
    const int i = static_cast<int>(random.below(3));
    c[i] += 1;
    const IntVec cofactors = cross(integers(a), integers(b));
    const Int128 component = i == 0 ? cofactors.x : i == 1 ? cofactors.y : cofactors.z;
    wrong += determinant_sign(a, b, c) != sign_of(component);
    wrong += determinant_sign(a, b, a) != 0;
  }
  CHECK(wrong == 0);
}

TEST_CASE("swapping two rows changes the sign of a determinant, rotating them changes nothing") {
  Random random(4);
  std::uint64_t wrong = 0;
  for (std::uint64_t left = tier_count("rays_per_case") / 4; left > 0; --left) {
    const glm::dvec3 a = random.in_box(1e15), b = random.in_box(1e-46), c = random.in_box(1);
    const double value = exact::rounded(exact::determinant(a, b, c));
    wrong += exact::rounded(exact::determinant(b, a, c)) != -value;
    wrong += exact::rounded(exact::determinant(a, c, b)) != -value;
    wrong += exact::rounded(exact::determinant(b, c, a)) != value;
  }
  CHECK(wrong == 0);
}

TEST_CASE("orientation and collinear are those of 128-bit integers") {
  Random random(5);
  std::uint64_t wrong = 0, on_line = 0, off_line = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 a = random.on_grid(kGrid), step = random.on_grid(kGrid);
    const glm::dvec3 b = a + static_cast<double>(random.integer(5)) * step;
    glm::dvec3 c = a + static_cast<double>(random.integer(5)) * step;
    const std::uint32_t nudged = random.below(6);
    if (nudged < 3) c[static_cast<int>(nudged)] += 1;

    const IntVec area = cross(integers(b) - integers(a), integers(c) - integers(a));
    wrong += orientation({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) != sign_of(area.z);
    wrong += orientation({c.x, c.y}, {b.x, b.y}, {a.x, a.y}) != -sign_of(area.z);
    const bool expected = area.x == 0 && area.y == 0 && area.z == 0;
    wrong += exact::collinear(a, b, c) != expected || exact::collinear(c, a, b) != expected;
    ++(expected ? on_line : off_line);
  }
  CHECK(wrong == 0);
  CHECK(on_line > 0);
  CHECK(off_line > 0);
}

TEST_CASE("rounded_quotient is integer division rounded once, and even on a tie") {
  Random random(6);
  std::uint64_t wrong = 0, ties = 0;
  const auto check = [&](std::int64_t p, std::int64_t q, std::int64_t denominator, Int128 split) {
    // denominator = (denominator + split) - split + 0: cancels exactly
    const double expected = rounded_by_integers(Int128{p} * q, denominator);
    const auto real = [](Int128 x) { return static_cast<double>(static_cast<std::int64_t>(x)); };
    const auto d0 = product(real(denominator + split), 1, 1), d1 = product(1, -real(split), 1);
    const auto n = product(static_cast<double>(p), static_cast<double>(q), 1);
    const auto minus_n = product(static_cast<double>(p), -static_cast<double>(q), 1);
    wrong += exact::rounded_quotient(n, d0, d1, kZero) != expected;
    wrong += exact::rounded_quotient(minus_n, kZero, d0, d1) != -expected;
  };
  for (std::uint64_t left = tier_count("rays_per_case") / 4; left > 0; --left) {
    const std::int64_t split = random.integer(std::int64_t{1} << 50);
    check(1 + random.below(1000), 1, 1 + random.below(1000), split);
    check(1 + static_cast<std::int64_t>(random.bits() >> 12), 1 + random.below(1u << 30),
          1 + static_cast<std::int64_t>(random.bits() >> 14), split);
    // p q of 54 bits and odd: the quotient p q d / d lies half-way between two doubles.
    const std::int64_t p = 2 * random.integer(1 << 25) + (1ll << 26) + 1,
                       q = 2 * random.integer(1 << 20) + (1ll << 27) + 1;
    const std::int64_t pq = p * q, d = 1 + random.below(1u << 20);
    if (std::bit_width(static_cast<std::uint64_t>(pq)) != 54) continue;
    ++ties;
    const auto n = product(static_cast<double>(p), static_cast<double>(q), static_cast<double>(d));
    const double tie = exact::rounded_quotient(n, product(static_cast<double>(d), 1, 1), kZero, kZero);
    wrong += tie != static_cast<double>((pq & 2) != 0 ? pq + 1 : pq - 1);
  }
  CHECK(wrong == 0);
  CHECK(ties > 0);
}

TEST_CASE("rounded_quotient is right on and next to a tie of long expansions") {
  // p q has 54 bits and is odd: half-way between two doubles.
  Random random(8);
  std::uint64_t wrong = 0, ties = 0;
  for (std::uint64_t left = tier_count("rays_per_case") / 4; left > 0; --left) {
    const std::int64_t p = (1 << 26) + 2 * random.integer(1 << 24) + 1,
                       q = (1 << 27) + 2 * random.integer(1 << 25) + 1;
    const std::int64_t pq = p * q;
    if (std::bit_width(static_cast<std::uint64_t>(pq)) != 54) continue;
    ++ties;
    const double x = static_cast<double>(p), y = static_cast<double>(q);
    const double even = static_cast<double>((pq & 2) != 0 ? pq + 1 : pq - 1);

    // det(p a, q b, c) / det(a, b, c), the products exact, the determinants of up to 105 bits.
    const glm::dvec3 a = random.on_grid(1 << 24), b = random.on_grid(1 << 24), c = random.on_grid(1ll << 53);
    const exact::Determinant whole = exact::determinant(a, b, c);
    if (whole.sign() == 0) continue;
    wrong += exact::rounded_quotient(exact::determinant(x * a, y * b, c), whole, kZero, kZero) != even;

    // (p q d + 1) / d and (p q d - 1) / d for d of 53 bits: off the tie by 2^-107 of the quotient.
    const double d = static_cast<double>((1ll << 53) - 1 - random.below(1 << 20));
    for (const double nudge : {-1.0, 1.0}) {
      const exact::Determinant n = exact::determinant({x, nudge, 0}, {0, y, 1}, {1, 0, d});
      const double expected = static_cast<double>(pq + static_cast<std::int64_t>(nudge));
      wrong += exact::rounded_quotient(n, product(d, 1, 1), kZero, kZero) != expected;
    }
  }
  CHECK(wrong == 0);
  CHECK(ties > 0);
}

TEST_CASE("rounded_quotient next to a power of two, where the spacing of doubles changes") {
  // Below 1 doubles lie 2^-53 apart: the midpoints are 1 - 2^-54, 1 - 3 2^-54. x - 1 as one determinant,
  // exactly:
  const auto minus_one = [](double x) { return exact::determinant({x, 1, 0}, {1, 1, 0}, {0, 0, 1}); };
  const auto over = [](const exact::Determinant& n, double d) {
    return exact::rounded_quotient(n, product(d, 1, 1), kZero, kZero);
  };
  const double two53 = 0x1p53, two54 = 0x1p54;
  CHECK(over(minus_one(two53), two53) == 1 - 0x1p-53);
  CHECK(over(minus_one(two54), two54) == 1);                // a tie: 1 is even
  CHECK(over(minus_one(2 * two54), 2 * two54) == 1);        // above the midpoint
  CHECK(over(minus_one(two54 - 2), two54) == 1 - 0x1p-52);  // a tie between 1 - 2^-53, odd, and this
  CHECK(exact::rounded(minus_one(two54)) == two54);
  CHECK(exact::rounded(minus_one(1)) == 0);
}

TEST_CASE("long expansions and their quotients are those of 113-bit arithmetic, rounded") {
  // Full mantissas: 24 parts each. The oracle is off by 2^-110 or so: it fails to round alike once in 2^50
  // times.
  Random random(7);
  std::uint64_t wrong = 0;
  for (std::uint64_t left = tier_count("rays_per_case") / 4; left > 0; --left) {
    const auto vector = [&] { return power_between(random, -60, 40) * random.in_box(1); };
    const glm::dvec3 a = vector(), b = vector(), c = vector(), d = vector();
    const Quad n = determinant(quad(a), quad(b), quad(c));
    const Quad d0 = determinant(quad(d), quad(b), quad(c)), d1 = determinant(quad(d), quad(c), quad(a)),
               d2 = determinant(quad(d), quad(a), quad(b));
    if (magnitude(d0 + d1 + d2) < Quad(1e-6) * (magnitude(d0) + magnitude(d1) + magnitude(d2))) continue;
    const double t = exact::rounded_quotient(exact::determinant(a, b, c), exact::determinant(d, b, c),
                                             exact::determinant(d, c, a), exact::determinant(d, a, b));
    wrong += t != static_cast<double>(n / (d0 + d1 + d2));
    wrong += exact::rounded(exact::determinant(a, b, c)) != static_cast<double>(n);
  }
  CHECK(wrong == 0);
}
