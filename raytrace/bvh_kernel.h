// SPDX-License-Identifier: MIT
// Traversals of the hierarchy, for one lane type F of floats. Included only by kernels_scalar.cpp, kernels_avx2.cpp and
// kernels_avx512.cpp, each compiled for its instruction set. Nothing is fused, so that every set enters the same nodes in
// the same order.
#pragma once

#include <array>
#include <bit>

#include "common/math/lane_ops.h"
#include "raytrace/bvh.h"

namespace sidelight::raytrace {

// A ray as the float boxes see it: o relative to Bvh::center, d scaled by a power of two to a largest component in
// [1, 2), depths by the inverse.
//
// Rounding. o is kept as an interval that covers its own rounding and the pad, so b - o, rounded, has the right sign and
// a relative error of u = 2^-24; times 1/d, twice rounded, 4 u: kSlack. Along an axis where |d| < 2^-60 a ray moves by
// less than the pad within the scene, so 2^60 serves as 1/d: all numbers stay finite, and none is ever NaN.
struct BoxRay {
  std::array<int, 3> near_face, far_face;  // rows of BvhNode::face
  std::array<float, 3> near_from, far_from, inverse;
  double scale = 1;  // depths in units of the scaled ray

  static constexpr float kSlack = 1 + 0x1p-20f;

  // Depth has a slack of its own: hits up to 2^-18 beyond count, and as much before.
  float limit(double depth) const { return static_cast<float>(depth * scale * (1 + 0x1p-15)) + 0x1p-120f; }
  float least(double depth) const {
    return depth > 0 ? static_cast<float>(depth * scale * (1 - 0x1p-15)) : 0;
  }
};

template <class F>
[[gnu::always_inline]] inline BoxRay box_ray(const Bvh& bvh, const glm::dvec3& origin,
                                             const glm::dvec3& direction) {
  constexpr float kFar = 0x1p60f;  // beyond this a float tells nothing of the scene: all of it may be met
  constexpr double kParallel = 0x1p-60;
  const auto larger = [](double a, double b) { return a < b ? b : a; };
  const auto magnitude = [](double x) { return x < 0 ? -x : x; };
  BoxRay out;
  double reach = bvh.reach, longest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    reach = larger(reach, magnitude(origin[axis]));
    longest = larger(longest, magnitude(direction[axis]));
  }
  const double pad = 0x1p-47 * reach + 0x1p-120;
  // The power of two below `longest`, which lies between 1e-100 and the greatest double.
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(longest) & 0x7ff0000000000000u;
  out.scale = std::bit_cast<double>(exponent);
  const double unscale = std::bit_cast<double>(0x7fe0000000000000u - exponent);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double o = origin[axis] - bvh.center[axis], d = direction[axis] * unscale;
    const double rounding = pad + 0x1p-23 * magnitude(o);
    const bool far_away = magnitude(o) > double{kFar};
    const float above = far_away ? kFar : static_cast<float>(o + rounding);
    const float below = far_away ? -kFar : static_cast<float>(o - rounding);
    const bool reversed = d < 0;
    out.near_face[i] = reversed ? axis + 3 : axis;
    out.far_face[i] = reversed ? axis : axis + 3;
    out.near_from[i] = reversed ? below : above;
    out.far_from[i] = reversed ? above : below;
    const bool parallel = magnitude(d) < kParallel;
    out.inverse[i] = static_cast<float>(1 / (parallel ? (reversed ? -kParallel : kParallel) : d));
  }
  return out;
}

// The children that a ray meets at a depth from `least` to `limit` as bits, and where it enters them.
struct MetChildren {
  std::uint32_t bits = 0;
  alignas(64) std::array<float, BvhNode::kWidth> entry;
};

template <class F>
[[gnu::always_inline]] inline void meet_children(const BvhNode& node, const BoxRay& ray, float least,
                                                 float limit, MetChildren& met) {
  met.bits = 0;
  for (std::size_t lane = 0; lane < BvhNode::kWidth; lane += kLanes<F>) {
    const auto depth = [&](int face, float from, float inverse) {
      return (load<F>(node.face[static_cast<std::size_t>(face)].data() + lane) - F(from)) * F(inverse);
    };
    F near(least), far(limit);
    for (std::size_t i = 0; i < 3; ++i) {
      near = lane_max<F>(near, depth(ray.near_face[i], ray.near_from[i], ray.inverse[i]));
      far = lane_min<F>(far, depth(ray.far_face[i], ray.far_from[i], ray.inverse[i]) * F(BoxRay::kSlack));
    }
    const Mask<F> met_here = near <= far;
    store<F>(select<F>(met_here, near, F(std::numeric_limits<float>::infinity())), met.entry.data() + lane);
    met.bits |= mask_bits<F>(met_here) << lane;
  }
}

// All leaves met at a depth from `from`, or from 0, to `limit`. Depth first, nearer children first. Leaf: double(first, count, limit).
template <class F, class Leaf>
[[gnu::always_inline]] inline std::uint64_t walk(const Bvh& bvh, const Ray& arriving, double from,
                                                 double limit, const Leaf& leaf) {
  struct Entry {
    float near;
    std::uint32_t first, count;
  };
  std::uint64_t entered = 0;
  if (bvh.nodes.empty()) return entered;
  const BoxRay ray = box_ray<F>(bvh, arriving.origin, arriving.direction);
  std::array<Entry, Bvh::kMaxDepth*(BvhNode::kWidth - 1) + 1> stack;
  std::size_t size = 0;
  const float least = ray.least(from);
  float box_limit = ray.limit(limit);
  MetChildren met;
  Entry top{0, 0, 0};
  while (true) {
    if (top.count > 0) {
      limit = leaf(top.first, top.count, limit);
      if (limit < 0) return entered;
      box_limit = ray.limit(limit);
    } else {
      ++entered;
      const BvhNode& node = bvh.nodes[top.first];
      meet_children<F>(node, ray, least, box_limit, met);
      const auto child = [&](std::uint32_t bits) {
        const auto i = static_cast<std::size_t>(std::countr_zero(bits));
        return Entry{met.entry[i], node.first[i], node.count[i]};
      };
      if (met.bits != 0) {
        // The nearest goes on, of equal ones the first; the others onto the stack by insertion, the nearest of them last.
        const std::size_t base = size;
        top = child(met.bits);
        for (std::uint32_t bits = met.bits & (met.bits - 1); bits != 0; bits &= bits - 1) {
          Entry other = child(bits);
          if (other.near < top.near) std::swap(other, top);
          std::size_t at = size++;
          for (; at > base && stack[at - 1].near <= other.near; --at) stack[at] = stack[at - 1];
          stack[at] = other;
        }
        continue;
      }
    }
    do {
      if (size == 0) return entered;
      top = stack[--size];
    } while (top.near > box_limit);
  }
}

// All leaves that meet the box, until leaf(first, count) is false.
template <class F, class Leaf>
[[gnu::always_inline]] inline void walk_near(const Bvh& bvh, const glm::dvec3& box_low,
                                             const glm::dvec3& box_high, const Leaf& leaf) {
  if (bvh.nodes.empty()) return;
  std::array<float, 3> low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double from = box_low[axis] - bvh.center[axis], to = box_high[axis] - bvh.center[axis];
    const double pad = 0x1p-46 * bvh.reach + 0x1p-120;
    low[i] = static_cast<float>(from - (0x1p-23 * (from < 0 ? -from : from) + pad));
    high[i] = static_cast<float>(to + (0x1p-23 * (to < 0 ? -to : to) + pad));
  }
  std::array<std::uint32_t, Bvh::kMaxDepth*(BvhNode::kWidth - 1) + 1> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const BvhNode& node = bvh.nodes[stack[--size]];
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < BvhNode::kWidth; lane += kLanes<F>) {
      const auto face = [&](std::size_t i) { return load<F>(node.face[i].data() + lane); };
      bits |= mask_bits<F>(face(0) <= F(high[0]) && face(1) <= F(high[1]) && face(2) <= F(high[2]) &&
                           face(3) >= F(low[0]) && face(4) >= F(low[1]) && face(5) >= F(low[2]))
              << lane;
    }
    for (; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      if (node.count[i] == 0)
        stack[size++] = node.first[i];
      else if (!leaf(node.first[i], node.count[i]))
        return;
    }
  }
}

}  // namespace sidelight::raytrace
