// SPDX-License-Identifier: MIT
// What the hierarchy is built from: boxes in lanes of four, references to items, ranges of them and their bins. Included
// by bvh_build.cpp only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/math/lanes.h"

namespace sidelight::raytrace {

using Quad = stdx::simd<float, stdx::simd_abi::deduce_t<float, 4>>;  // x, y, z and one to spare
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Bounds {
  Quad low{kInfinity}, high{-kInfinity};

  [[gnu::always_inline]] void grow(const Bounds& b) {
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
struct Reference {
  std::array<float, 4> low;  // the fourth number is 0
  std::array<float, 3> high;
  std::uint32_t item;

  // The item's bits would be a denormal number, and slow.
  [[gnu::always_inline]] Bounds box() const {
    using Bits = decltype(to_bits(Quad{}));
    constexpr std::array<std::int32_t, 4> kFirstThree{-1, -1, -1, 0};
    return {load<Quad>(low.data()),
            from_bits<Quad>(to_bits(load<Quad>(high.data())) & load<Bits>(kFirstThree.data()))};
  }
};
static_assert(sizeof(Reference) == 32);

// Twice the centre of a box, as both ends of an interval.
[[gnu::always_inline]] inline Bounds center_of(const Bounds& box) {
  return {box.low + box.high, box.low + box.high};
}

// Items that become one subtree.
struct Range {
  std::uint32_t first = 0, count = 0;
  Bounds boxes, centers;
  int depth = 0;  // nodes above it
};

inline float round_down(double x) {
  const auto f = static_cast<float>(x);
  return f <= x ? f : std::nextafter(f, -kInfinity);
}
inline float round_up(double x) { return -round_down(-x); }

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
  [[gnu::always_inline]] auto of(const Bounds& box) const {
    const Quad at = ((box.low + box.high) - from) * per_width;
    return stdx::static_simd_cast<stdx::rebind_simd_t<int, Quad>>(at);
  }
};

}  // namespace sidelight::raytrace
