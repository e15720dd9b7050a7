// SPDX-License-Identifier: MIT
#include "common/model/exact.h"

#include <cmath>
#include <limits>

namespace sidelight::exact {
namespace {

// a + b = sum + error, exactly (Knuth; Shewchuk 1997, theorem 7).
struct Pair {
  double value, error;
};

Pair two_sum(double a, double b) {
  const double sum = a + b;
  const double b_virtual = sum - a;
  const double a_virtual = sum - b_virtual;
  return {sum, (a - a_virtual) + (b - b_virtual)};
}

// a * b = product + error, exactly.
Pair two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

// Adds one double, keeping the parts non-overlapping and dropping zeros (Shewchuk 1997, theorem 10).
template <int N>
void add(Expansion<N>& e, double b) {
  int kept = 0;
  double carry = b;
  for (int i = 0; i < e.size; ++i) {
    const Pair s = two_sum(carry, e.part[static_cast<std::size_t>(i)]);
    carry = s.value;
    if (s.error != 0) e.part[static_cast<std::size_t>(kept++)] = s.error;
  }
  if (carry != 0) e.part[static_cast<std::size_t>(kept++)] = carry;
  e.size = kept;
}

template <int N>
void add_product(Expansion<N>& e, double a, double b) {
  const Pair p = two_product(a, b);
  add(e, p.error);
  add(e, p.value);
}

// e += a * b * c: at most four parts.
void add_triple_product(Determinant& e, double a, double b, double c) {
  const Pair bc = two_product(b, c);
  add_product(e, a, bc.error);
  add_product(e, a, bc.value);
}

template <int N, int M>
void add_scaled(Expansion<N>& e, const Expansion<M>& by, double factor) {
  for (int i = 0; i < by.size; ++i) add_product(e, by.part[static_cast<std::size_t>(i)], factor);
}

// Within a few units in the last place of the value: the parts do not overlap, so the large ones decide.
template <int N>
double estimate(const Expansion<N>& e) {
  double sum = 0;
  for (int i = 0; i < e.size; ++i) sum += e.part[static_cast<std::size_t>(i)];
  return sum;
}

using Denominator = Expansion<72>;
using Residual = Expansion<24 + 2 * 72 + 2 * 72>;

// numerator - (quotient + half) * denominator
Residual residual(const Determinant& numerator, const Denominator& denominator, double quotient, double half) {
  Residual r;
  for (int i = 0; i < numerator.size; ++i) add(r, numerator.part[static_cast<std::size_t>(i)]);
  add_scaled(r, denominator, -quotient);
  if (half != 0) add_scaled(r, denominator, -half);
  return r;
}

bool is_even(double x) {
  int exponent = 0;
  return std::fmod(std::ldexp(std::frexp(x, &exponent), 53), 2.0) == 0;
}

double rounded_ratio(const Determinant& numerator, const Denominator& denominator) {
  if (numerator.size == 0) return 0;
  // One Newton correction brings the estimate within an ulp or so of the nearest double.
  double q = estimate(numerator) / estimate(denominator);
  q += estimate(residual(numerator, denominator, q, 0)) / estimate(denominator);

  // Step to the neighbour as long as the exact quotient lies beyond the midpoint towards it.
  for (;;) {
    const int beyond = residual(numerator, denominator, q, 0).sign() * denominator.sign();
    if (beyond == 0) return q;
    const double neighbour = std::nextafter(q, beyond * std::numeric_limits<double>::infinity());
    const double half = (neighbour - q) / 2;
    const int past_midpoint = residual(numerator, denominator, q, half).sign() * denominator.sign() * beyond;
    if (past_midpoint < 0 || (past_midpoint == 0 && is_even(q))) return q;
    q = neighbour;
  }
}

}  // namespace

Determinant determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  Determinant e;
  add_triple_product(e, a.x, b.y, c.z);
  add_triple_product(e, -a.x, b.z, c.y);
  add_triple_product(e, a.y, b.z, c.x);
  add_triple_product(e, -a.y, b.x, c.z);
  add_triple_product(e, a.z, b.x, c.y);
  add_triple_product(e, -a.z, b.y, c.x);
  return e;
}

int determinant_sign(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return determinant(a, b, c).sign();
}

double rounded(const Determinant& value) {
  Denominator one;
  add(one, 1.0);
  return rounded_ratio(value, one);
}

double rounded_quotient(const Determinant& numerator, const Determinant& d0, const Determinant& d1,
                        const Determinant& d2) {
  Denominator sum;
  for (const Determinant* d : {&d0, &d1, &d2})
    for (int i = 0; i < d->size; ++i) add(sum, d->part[static_cast<std::size_t>(i)]);
  return rounded_ratio(numerator, sum);
}

int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  // a x b + b x c + c x a: twice the signed area, without a rounded difference.
  Expansion<12> e;
  const auto add_cross = [&](const glm::dvec2& p, const glm::dvec2& q) {
    add_product(e, p.x, q.y);
    add_product(e, -p.y, q.x);
  };
  add_cross(a, b);
  add_cross(b, c);
  add_cross(c, a);
  return e.sign();
}

bool collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  using glm::dvec2;
  return orientation(dvec2(a.x, a.y), dvec2(b.x, b.y), dvec2(c.x, c.y)) == 0 &&
         orientation(dvec2(a.y, a.z), dvec2(b.y, b.z), dvec2(c.y, c.z)) == 0 &&
         orientation(dvec2(a.z, a.x), dvec2(b.z, b.x), dvec2(c.z, c.x)) == 0;
}

}  // namespace sidelight::exact
