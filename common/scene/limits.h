// SPDX-License-Identifier: MIT
// What the numbers of a scene may be, whichever file they come from. Readers report what is beyond at its place.
#pragma once

#include <cstddef>

namespace sidelight {

// Magnitudes of coordinates and lengths; a coordinate below is 0. Beyond, products of three leave what the exact
// predicates can hold (model/exact.h).
inline constexpr double kLargest = 1e15, kSmallestLength = 1e-30;
// Of colours and coefficients, which are floats in the renderers.
inline constexpr double kMostLight = 1e30;
inline constexpr double kMostShininess = 1e6;
inline constexpr double kLeastIor = 0.25, kMostIor = 4;

inline constexpr std::size_t kMaxCorners = 10'000;  // of a face: triangulation is O(n²)
inline constexpr std::size_t kMaxPrimitives = std::size_t{1} << 25;

}  // namespace sidelight
