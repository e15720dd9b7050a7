// SPDX-License-Identifier: MIT
// Four 32-bit numbers of any kind in a register of sixteen bytes, which every x86-64 has: for records of four that become
// arrays, or the other way round. That is loads, stores and shuffles, and gains nothing from wider lanes. Always inlined:
// no copy of these that is compiled for one instruction set may serve another.
#pragma once

#include <xmmintrin.h>

#include <array>
#include <cstdint>
#include <cstring>

namespace sidelight {

using Four = std::int32_t __attribute__((vector_size(16)));
using FourFloats = float __attribute__((vector_size(16)));

template <class V = Four>
[[gnu::always_inline]] inline V load_four(const void* from) {
  V four;
  std::memcpy(&four, from, sizeof four);
  return four;
}
template <class V>
[[gnu::always_inline]] inline void store_four(const V& four, void* to) {
  std::memcpy(to, &four, sizeof four);
}

// Past the caches, to an address that is a multiple of 16; whole cache lines, one after the other, or it is slow. Others
// see it after end_streams() of the thread that stored it.
[[gnu::always_inline]] inline void stream_four(const FourFloats& four, float* to) { _mm_stream_ps(to, four); }
[[gnu::always_inline]] inline void end_streams() { _mm_sfence(); }

// Four rows of four become their columns.
[[gnu::always_inline]] inline std::array<Four, 4> transposed(const Four& a, const Four& b, const Four& c,
                                                             const Four& d) {
  const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Four ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Four cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5),
          __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
          __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5),
          __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7)};
}

// x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3.
[[gnu::always_inline]] inline std::array<FourFloats, 3> interleaved(const FourFloats& x, const FourFloats& y,
                                                                    const FourFloats& z) {
  const FourFloats xy_low = __builtin_shufflevector(x, y, 0, 4, 1, 5);
  const FourFloats xy_high = __builtin_shufflevector(x, y, 2, 6, 3, 7);
  const FourFloats yz = __builtin_shufflevector(y, z, 1, 5, 2, 6);
  return {__builtin_shufflevector(xy_low, z, 0, 1, 4, 2), __builtin_shufflevector(yz, xy_high, 0, 1, 4, 5),
          __builtin_shufflevector(z, xy_high, 2, 6, 7, 3)};
}

}  // namespace sidelight
