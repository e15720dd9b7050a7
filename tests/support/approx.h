// SPDX-License-Identifier: MIT
// Approximate equality of vectors, printed by doctest when it fails: CHECK(v == near({1, 2, 3}, tolerance)).
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <ostream>

#include "common/math/vec.h"

namespace sidelight::test {

// From 1 to the next double, and to the next float.
inline constexpr double kEps = 0x1p-52, kFloatEps = 0x1p-23;
inline constexpr double kU = 0x1p-53;  // what rounding a double may change it by, relatively

// Equal to any vector whose components are each within `tolerance`, absolutely; never to one with a NaN.
struct Near {
  glm::dvec3 value;
  double tolerance;
};
inline Near near(const glm::dvec3& value, double tolerance) { return {value, tolerance}; }

inline bool operator==(const glm::dvec3& v, const Near& expected) {
  const auto close = [&](double a, double b) { return std::abs(a - b) <= expected.tolerance; };
  return close(v.x, expected.value.x) && close(v.y, expected.value.y) && close(v.z, expected.value.z);
}
inline bool operator==(const glm::vec3& v, const Near& expected) { return glm::dvec3(v) == expected; }
template <class T>
bool operator==(const Vec3<T>& v, const Near& expected) {
  return glm::dvec3(v.x, v.y, v.z) == expected;
}

inline std::ostream& operator<<(std::ostream& out, const Near& near) {
  return out << "(" << near.value.x << ", " << near.value.y << ", " << near.value.z << ") +- "
             << near.tolerance;
}

}  // namespace sidelight::test

namespace doctest {
template <class T, glm::qualifier Q>
struct StringMaker<glm::vec<3, T, Q>> {
  static String convert(const glm::vec<3, T, Q>& v) {
    return "(" + toString(v.x) + ", " + toString(v.y) + ", " + toString(v.z) + ")";
  }
};
template <class T>
struct StringMaker<sidelight::Vec3<T>> {
  static String convert(const sidelight::Vec3<T>& v) {
    return "(" + toString(v.x) + ", " + toString(v.y) + ", " + toString(v.z) + ")";
  }
};
}  // namespace doctest
