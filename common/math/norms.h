// SPDX-License-Identifier: MIT
// How large vectors are without a root, and along which axis. For those of lanes: vec.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace sidelight {

inline glm::dvec3 absolute(const glm::dvec3& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

// The greatest of the components' absolute values.
inline double max_norm(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Their sum: at least the length, and at most sqrt(3) times it.
inline double l1_norm(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// The axis of the greatest of three numbers, the first of equals.
template <class T>
[[gnu::always_inline]] constexpr int greatest_axis(T x, T y, T z) {
  return x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
}

}  // namespace sidelight
