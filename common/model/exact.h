// SPDX-License-Identifier: MIT
// Exact signs and exactly rounded quotients of small polynomials in doubles, by floating-point expansions: a number
// as a sum of doubles that do not overlap. Slow and always right; visibility.h calls it where double cannot decide.
//
// Exact as long as no product under- or overflows: non-zero inputs between 1e-100 and 1e100 in magnitude. Scene
// positions (1e-30 to 1e15) and ray directions (camera.h, optics.h) keep to that.
// After J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete
// and Computational Geometry 18, 1997, sections 2.2 to 2.4 (two-sum, two-product, grow- and scale-expansion).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sidelight::exact {

// A sum of at most N doubles, smallest first, non-overlapping: its sign is the sign of its last component.
template <int N>
struct Expansion {
  std::array<double, N> part{};
  int size = 0;

  int sign() const { return size == 0 ? 0 : (part[static_cast<std::size_t>(size - 1)] > 0 ? 1 : -1); }
};

using Determinant = Expansion<24>;   // six triple products of four parts each

// a . (b x c), exactly.
Determinant determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
// Its sign: -1, 0 or 1.
int determinant_sign(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
// The expansion rounded once, to nearest.
double rounded(const Determinant& value);

// numerator / (d0 + d1 + d2), rounded once, to nearest even. The denominator must not be zero.
double rounded_quotient(const Determinant& numerator, const Determinant& d0, const Determinant& d1,
                        const Determinant& d2);

// Sign of the area of the triangle a b c in the plane: 1 where it turns counter-clockwise, 0 where collinear.
int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

// Whether the three points lie on one line (or coincide), exactly.
bool collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace sidelight::exact
