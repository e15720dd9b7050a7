// SPDX-License-Identifier: MIT
// Doubles that lie here and there in memory, brought into lanes. Vectors: rows of x y z are loaded whole and transposed in
// registers. Numbers of which neighbouring lanes want neighbouring ones: one load and one permutation.
#pragma once

#include "common/math/lane_ops.h"
#include "common/math/vec.h"

namespace sidelight {

#ifdef __AVX512VL__
namespace detail {
// x y z 0 of `a`, and the same of `b`.
inline __m512d two_rows(const double* a, const double* b) {
  const __m512d row = _mm512_castpd256_pd512(_mm256_maskz_loadu_pd(0x7, a));
  return _mm512_insertf64x4(row, _mm256_maskz_loadu_pd(0x7, b), 1);
}
}  // namespace detail
#endif

// row(lane) points to three doubles.
template <class F, class Row>
[[gnu::always_inline]] inline Vec3<F> load_vectors(const Row& row) {
#ifdef __AVX512VL__
  if constexpr (sizeof(F) == 64) {
    const __m512d r02 = detail::two_rows(row(0), row(2)), r13 = detail::two_rows(row(1), row(3));
    const __m512d r46 = detail::two_rows(row(4), row(6)), r57 = detail::two_rows(row(5), row(7));
    const __m512d xz_low = _mm512_unpacklo_pd(r02, r13), xz_high = _mm512_unpacklo_pd(r46, r57);
    const __m512d y_low = _mm512_unpackhi_pd(r02, r13), y_high = _mm512_unpackhi_pd(r46, r57);
    return {F(_mm512_shuffle_f64x2(xz_low, xz_high, 0x88)), F(_mm512_shuffle_f64x2(y_low, y_high, 0x88)),
            F(_mm512_shuffle_f64x2(xz_low, xz_high, 0xdd))};
  }
#endif
#ifdef __AVX2__
  if constexpr (sizeof(F) == 32) {
    const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
    const auto load_row = [&](int lane) { return _mm256_maskload_pd(row(lane), three); };
    const __m256d r0 = load_row(0), r1 = load_row(1), r2 = load_row(2), r3 = load_row(3);
    const __m256d xz_low = _mm256_unpacklo_pd(r0, r1), xz_high = _mm256_unpacklo_pd(r2, r3);
    const __m256d y_low = _mm256_unpackhi_pd(r0, r1), y_high = _mm256_unpackhi_pd(r2, r3);
    return {F(_mm256_permute2f128_pd(xz_low, xz_high, 0x20)), F(_mm256_permute2f128_pd(y_low, y_high, 0x20)),
            F(_mm256_permute2f128_pd(xz_low, xz_high, 0x31))};
  }
#endif
  const auto component = [&](std::ptrdiff_t c) {
    return generate<F>([&](int lane) { return row(lane)[c]; });
  };
  return {component(0), component(1), component(2)};
}

// One entry of a table, the same for all lanes.
template <class F>
class OneEntry {
 public:
  explicit OneEntry(std::uint32_t entry) : entry_(entry) {}

  F operator()(const double* table) const { return F(table[entry_]); }
  template <class Table>
  Vec3<F> vector(const Table& table) const {
    return {F(table[0][entry_]), F(table[1][entry_]), F(table[2][entry_])};
  }

 private:
  std::uint32_t entry_;
};

// Which entry of a table each lane reads: numbers that ascend from lane to lane by 0 or 1. Reads of a table as many entries
// beyond the first lane's as there are lanes.
template <class F>
class AscendingLanes {
 public:
  explicit AscendingLanes(const std::uint32_t* entry) : entry_(entry), first_(entry[0]) {
#ifdef __AVX512VL__
    if constexpr (sizeof(F) == 64) {
      const __m256i entries = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(entry));
      place_ = _mm512_cvtepu32_epi64(_mm256_sub_epi32(entries, _mm256_set1_epi32(static_cast<int>(first_))));
    }
#elif defined(__AVX2__)
    if constexpr (sizeof(F) == 32) {
      // Of halves of doubles: 2 k and 2 k + 1.
      const __m128i entries = _mm_loadu_si128(reinterpret_cast<const __m128i*>(entry));
      const __m128i low = _mm_slli_epi32(_mm_sub_epi32(entries, _mm_set1_epi32(static_cast<int>(first_))), 1);
      const __m256i low_halves = _mm256_cvtepu32_epi64(low);
      place_ = _mm256_or_si256(low_halves,
                               _mm256_slli_epi64(_mm256_add_epi64(low_halves, _mm256_set1_epi64x(1)), 32));
    }
#endif
  }

  [[gnu::always_inline]] F operator()(const double* table) const {
#ifdef __AVX512VL__
    if constexpr (sizeof(F) == 64) return F(_mm512_permutexvar_pd(place_, _mm512_loadu_pd(table + first_)));
#elif defined(__AVX2__)
    if constexpr (sizeof(F) == 32)
      return F(_mm256_castps_pd(
          _mm256_permutevar8x32_ps(_mm256_castpd_ps(_mm256_loadu_pd(table + first_)), place_)));
#endif
    return generate<F>([&](int lane) { return table[entry_[lane]]; });
  }
  template <class Table>
  [[gnu::always_inline]] Vec3<F> vector(const Table& table) const {
    return {(*this)(table[0].data()), (*this)(table[1].data()), (*this)(table[2].data())};
  }

 private:
  const std::uint32_t* entry_;
  std::uint32_t first_;
#ifdef __AVX512VL__
  __m512i place_ = {};
#elif defined(__AVX2__)
  __m256i place_ = {};
#endif
};

}  // namespace sidelight
