// SPDX-License-Identifier: MIT
// Unit vectors from vectors of any finite length, without overflow or underflow on the way: normals and
// directions come from files, where 1e-200 and 1e200 are lengths like any other. v and 2^k v give the same
// bits. For loading, not for hot code.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "common/math/norms.h"

namespace sidelight {

// v times the power of two that brings its largest component into [0.5, 1) in magnitude. Zero where v is zero
// or has a component that is not finite.
inline glm::dvec3 binary_scaled(const glm::dvec3& v) {
  const double largest = max_norm(v);
  if (largest == 0 || !std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return glm::dvec3(0);
  int exponent = 0;
  std::frexp(largest, &exponent);
  return {std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)};
}

// v / |v|, or zero where v is zero or has a component that is not finite.
inline glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const glm::dvec3 scaled = binary_scaled(v);
  const double length = std::sqrt(glm::dot(scaled, scaled));
  return length > 0 ? scaled / length : scaled;
}

}  // namespace sidelight
