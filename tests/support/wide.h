// SPDX-License-Identifier: MIT
// Wider numbers for oracles that share nothing with the code they judge: 128-bit integers (exact) and 113-bit
// floats (exact for products of three integers below 2^36).
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace sidelight::test {

__extension__ typedef __int128 Int128;
__extension__ typedef __float128 Quad;

template <class T>
int sign_of(const T& value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}
template <class T>
T magnitude(const T& value) {
  return value < 0 ? -value : value;
}

template <class T>
struct Wide {
  T x, y, z;

  friend Wide operator+(const Wide& a, const Wide& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Wide operator-(const Wide& a, const Wide& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Wide operator*(const T& s, const Wide& v) { return {s * v.x, s * v.y, s * v.z}; }
};
using QuadVec = Wide<Quad>;
using IntVec = Wide<Int128>;

inline QuadVec quad(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
// Of a vector of integers.
inline IntVec integers(const glm::dvec3& v) {
  return {static_cast<Int128>(v.x), static_cast<Int128>(v.y), static_cast<Int128>(v.z)};
}

template <class T>
T dot(const Wide<T>& a, const Wide<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Wide<T> cross(const Wide<T>& a, const Wide<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T determinant(const Wide<T>& a, const Wide<T>& b, const Wide<T>& c) {
  return dot(a, cross(b, c));
}

// Heron's steps from the double: each doubles the digits.
inline Quad square_root(const Quad& x) {
  if (!(x > 0)) return 0;
  Quad root = std::sqrt(static_cast<double>(x));
  for (int step = 0; step < 2; ++step) root = (root + x / root) / 2;
  return root;
}
inline Quad length(const QuadVec& v) { return square_root(dot(v, v)); }

}  // namespace sidelight::test
