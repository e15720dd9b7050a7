// SPDX-License-Identifier: MIT
// What the hierarchy is built from: boxes in lanes of four, items with theirs, ranges of them and their bins. For
// bvh_build.cpp and its test only.
#pragma once

#include <emmintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>

#include "common/math/lanes.h"
#include "raytrace/bvh.h"

namespace sidelight::raytrace {

using Quad = stdx::simd<float, stdx::simd_abi::deduce_t<float, 4>>;  // x, y, z and one to spare

struct FloatBox {
  Quad low{kInfinity}, high{-kInfinity};

  [[gnu::always_inline]] void grow(const FloatBox& b) {
    low = stdx::min(low, b.low);
    high = stdx::max(high, b.high);
  }
  // Half the surface, with lengths times `unit`; 0 for an empty box.
  float half_area(float unit) const {
    const Quad d = stdx::max(high - low, Quad(0)) * Quad(unit);
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

// An item on its way to its leaf, with its box: moved, not pointed to, since each level of the tree reads all of them.
// It is in whole vectors, or it would be copied number by number and waited for where it is read.
class BoxedItem {
 public:
  BoxedItem() = default;
  [[gnu::always_inline]] BoxedItem(std::uint32_t item, const FloatBox& box) : low_(box.low) {
    const auto fourth = std::bit_cast<Bits>(_mm_slli_si128(_mm_cvtsi32_si128(static_cast<int>(item)), 12));
    high_and_item_ = from_bits<Quad>((to_bits(box.high) & load<Bits>(kFirstThree.data())) | fourth);
  }
  // The item's bits would be a denormal number, and slow.
  [[gnu::always_inline]] FloatBox box() const {
    return {low_, from_bits<Quad>(to_bits(high_and_item_) & load<Bits>(kFirstThree.data()))};
  }
  // Twice the centre.
  [[gnu::always_inline]] float center(std::size_t axis) const { return low_[axis] + high_and_item_[axis]; }
  std::uint32_t item() const { return std::bit_cast<std::array<std::uint32_t, 4>>(high_and_item_)[3]; }

 private:
  using Bits = decltype(to_bits(Quad{}));
  static constexpr std::array<std::int32_t, 4> kFirstThree{-1, -1, -1, 0};

  Quad low_, high_and_item_;
};
static_assert(sizeof(BoxedItem) == 32);

// Twice the centre of a box, as both ends of an interval.
[[gnu::always_inline]] inline FloatBox center_of(const FloatBox& box) {
  return {box.low + box.high, box.low + box.high};
}

// Items that become one subtree.
struct Range {
  std::uint32_t first = 0, count = 0;
  FloatBox boxes, centers;
  int depth = 0;  // nodes above it
};

// A vector of doubles, in two registers.
struct Double3 {
  __m128d xy, z;
};
[[gnu::always_inline]] inline Double3 difference(const glm::dvec3& a, const glm::dvec3& b) {
  return {_mm_sub_pd(_mm_loadu_pd(&a.x), _mm_loadu_pd(&b.x)),
          _mm_sub_sd(_mm_load_sd(&a.z), _mm_load_sd(&b.z))};
}

// The greatest floats that are not above v, without a branch: half of all numbers would take it. (Where the nearest float
// is too great it is not +0, whose bits have none below them.)
[[gnu::always_inline]] inline Quad round_down(const Double3& v) {
  const __m128 nearest = _mm_movelh_ps(_mm_cvtpd_ps(v.xy), _mm_cvtpd_ps(v.z));
  const __m128d xy_above = _mm_cmpgt_pd(_mm_cvtps_pd(nearest), v.xy);
  const __m128d z_above = _mm_cmpgt_pd(_mm_cvtps_pd(_mm_movehl_ps(nearest, nearest)), v.z);
  const __m128i above =
      _mm_castps_si128(_mm_shuffle_ps(_mm_castpd_ps(xy_above), _mm_castpd_ps(z_above), 0b10'00'10'00));
  // From a float's bits to those of the next greater one: 1, or -1 for negative ones.
  const __m128i bits = _mm_castps_si128(nearest);
  const __m128i up = _mm_or_si128(_mm_srai_epi32(bits, 31), _mm_set1_epi32(1));
  return Quad(_mm_castsi128_ps(_mm_sub_epi32(bits, _mm_and_si128(up, above))));
}
// The least floats that are not below v.
[[gnu::always_inline]] inline Quad round_up(const Double3& v) {
  const __m128d sign = _mm_set1_pd(-0.0);
  return -round_down({_mm_xor_pd(v.xy, sign), _mm_xor_pd(v.z, sign)});
}

// Bins of equal width over the centres of a range, along each axis.
inline constexpr std::size_t kMostBins = 16;
struct Binning {
  Quad from, per_width;
  std::size_t bins;

  explicit Binning(const Range& range)
      : from(range.centers.low), bins(std::min<std::size_t>(kMostBins, 4 + range.count / 8)) {
    const Quad width = range.centers.high - range.centers.low;
    per_width = Quad(0);
    // A little less than the bins, so that the last centre falls into the last one.
    stdx::where(width > Quad(0), per_width) = Quad(static_cast<float>(bins) * (1 - 0x1p-12f)) / width;
  }
  [[gnu::always_inline]] auto of(const FloatBox& box) const {
    const Quad at = ((box.low + box.high) - from) * per_width;
    return stdx::static_simd_cast<stdx::rebind_simd_t<int, Quad>>(at);
  }
  // The same along one axis, given by its numbers.
  static int of(float center, float from, float per_width) {
    return static_cast<int>((center - from) * per_width);
  }
};

}  // namespace sidelight::raytrace
