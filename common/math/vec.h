// SPDX-License-Identifier: MIT
// Three lanes of numbers, and nothing more: what GLM is for scalars, for lane types (GLM refuses them). As a plain double,
// it is what its memory held until it is set: arrays of them, filled step by step, are not zeroed first.
#pragma once

#include "common/math/lane_ops.h"

namespace sidelight {

template <class F>
struct Vec3 {
  F x, y, z;

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend Vec3 operator*(const F& s, const Vec3& v) { return {s * v.x, s * v.y, s * v.z}; }
};

template <class F>
F dot(const Vec3<F>& a, const Vec3<F>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

// The same with the roundings of fused().
template <class F>
F fused_dot(const Vec3<F>& a, const Vec3<F>& b) {
  return fused<F>(a.z, b.z, fused<F>(a.y, b.y, a.x * b.x));
}
// s v + w
template <class F>
Vec3<F> fused(const F& s, const Vec3<F>& v, const Vec3<F>& w) {
  return {fused<F>(s, v.x, w.x), fused<F>(s, v.y, w.y), fused<F>(s, v.z, w.z)};
}

template <class F>
Vec3<F> cross(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The same in all lanes, of anything that has x, y and z.
template <class F, class V>
[[gnu::always_inline]] inline Vec3<F> wide(const V& v) {
  return {F(v.x), F(v.y), F(v.z)};
}

// From and to a structure of arrays: entry i and those that follow it of three rows of numbers.
template <class F, class Rows>
[[gnu::always_inline]] inline Vec3<F> load_rows(const Rows& rows, std::size_t i) {
  return {load<F>(&rows[0][i]), load<F>(&rows[1][i]), load<F>(&rows[2][i])};
}
template <class F, class Rows>
[[gnu::always_inline]] inline void store_rows(const Vec3<F>& v, Rows& rows, std::size_t i) {
  store<F>(v.x, &rows[0][i]);
  store<F>(v.y, &rows[1][i]);
  store<F>(v.z, &rows[2][i]);
}

// Of doubles F, each rounded to float.
template <class F>
[[gnu::always_inline]] inline auto to_floats(const Vec3<F>& v) {
  return Vec3<FloatBeside<F>>{to_float<F>(v.x), to_float<F>(v.y), to_float<F>(v.z)};
}

// As norms.h has them.
template <class F>
[[gnu::always_inline]] inline Vec3<F> absolute(const Vec3<F>& v) {
  return {lane_abs<F>(v.x), lane_abs<F>(v.y), lane_abs<F>(v.z)};
}
template <class F>
[[gnu::always_inline]] inline F l1_norm(const Vec3<F>& v) {
  return (lane_abs<F>(v.x) + lane_abs<F>(v.y)) + lane_abs<F>(v.z);
}

template <class F>
Vec3<F> select(const Mask<F>& mask, const Vec3<F>& if_true, const Vec3<F>& if_false) {
  return {select<F>(mask, if_true.x, if_false.x), select<F>(mask, if_true.y, if_false.y),
          select<F>(mask, if_true.z, if_false.z)};
}

// Unit length as glm::normalize has it, by the reciprocal of the length; not for zero.
template <class F>
[[gnu::always_inline]] inline Vec3<F> normalized(const Vec3<F>& v) {
  return (F(1) / square_root(dot(v, v))) * v;
}

}  // namespace sidelight
