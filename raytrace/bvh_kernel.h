// SPDX-License-Identifier: MIT
// Traversals of the hierarchy, for one lane type F of floats. Included by the kernels only (kernels_in_lanes.h). Nothing is
// fused, so that every set enters the same nodes in the same order.
#pragma once

#include <array>
#include <bit>

#include "common/math/lane_ops.h"
#include "raytrace/bvh.h"

namespace sidelight::raytrace {

// Rays in lanes D as the float boxes see them: o relative to Bvh::center, d scaled by a power of two to a largest
// component in [1, 2), depths by the inverse. Of rays that are not finite, or have no direction, nothing is said.
//
// Rounding. o is kept as an interval that covers its own rounding and the pad, so b - o, rounded, has the right sign and
// a relative error of u = 2^-24; times 1/d, twice rounded, 4 u: kSlack. Along an axis where |d| < 2^-60 a ray moves by
// less than the pad within the scene, so 2^60 serves as 1/d: all numbers stay finite, and none is ever NaN.
template <class D>
struct BoxRays {
  using F = FloatBeside<D>;
  std::array<F, 6> from;  // for each row of BvhNode::face, the end of o's interval from which it is seen
  std::array<F, 3> inverse;
  D scale;  // depths in units of the scaled ray
};
inline constexpr float kBoxSlack = 1 + 0x1p-20f;

// Depth has a slack of its own: hits up to 2^-18 beyond count, and as much before.
template <class D>
[[gnu::always_inline]] inline FloatBeside<D> box_limit(const D& depth, const D& scale) {
  return to_float<D>(depth * scale * D(1 + 0x1p-15)) + FloatBeside<D>(0x1p-120f);
}
template <class D>
[[gnu::always_inline]] inline FloatBeside<D> box_least(const D& depth, const D& scale) {
  return to_float<D>(select<D>(depth > D(0), depth * scale * D(1 - 0x1p-15), D(0)));
}

template <class D>
[[gnu::always_inline]] inline BoxRays<D> box_rays(const Bvh& bvh, const std::array<D, 3>& origin,
                                                  const std::array<D, 3>& direction) {
  constexpr double kFar = 0x1p60;  // beyond this a float tells nothing of the scene: all of it may be met
  constexpr double kParallel = 0x1p-60;
  using I = Ints<D>;
  BoxRays<D> out;
  D reach(bvh.reach), longest(0);
  for (std::size_t i = 0; i < 3; ++i) {
    reach = lane_max<D>(reach, lane_abs<D>(origin[i]));
    longest = lane_max<D>(longest, lane_abs<D>(direction[i]));
  }
  const D pad = D(0x1p-47) * reach + D(0x1p-120);
  // The power of two below `longest`, which lies between 1e-100 and the greatest double.
  const I exponent = to_bits<D>(longest) & I(0x7ff0000000000000);
  out.scale = from_bits<D>(exponent);
  const D unscale = from_bits<D>(I(0x7fe0000000000000) - exponent);
  for (std::size_t i = 0; i < 3; ++i) {
    const D o = origin[i] - D(bvh.center[static_cast<int>(i)]), d = direction[i] * unscale;
    const D rounding = pad + D(0x1p-23) * lane_abs<D>(o);
    const Mask<D> far_away = lane_abs<D>(o) > D(kFar), parallel = lane_abs<D>(d) < D(kParallel);
    out.from[i] = to_float<D>(select<D>(far_away, D(kFar), o + rounding));
    out.from[i + 3] = to_float<D>(select<D>(far_away, D(-kFar), o - rounding));
    const D least = select<D>(d < D(0), D(-kParallel), D(kParallel));
    out.inverse[i] = to_float<D>(D(1) / select<D>(parallel, least, d));
  }
  return out;
}

// One of them, in its own order.
struct BoxRay {
  std::array<std::size_t, 3> near_face, far_face;  // rows of BvhNode::face
  std::array<float, 3> near_from, far_from, inverse;
};
// from(row), inverse(axis): of BoxRays.
template <class From, class Inverse>
[[gnu::always_inline]] inline BoxRay box_ray(const From& from, const Inverse& inverse) {
  BoxRay ray;
  for (std::size_t i = 0; i < 3; ++i) {
    ray.inverse[i] = inverse(i);
    const bool reversed = ray.inverse[i] < 0;
    ray.near_face[i] = reversed ? i + 3 : i;
    ray.far_face[i] = reversed ? i : i + 3;
    ray.near_from[i] = from(ray.near_face[i]);
    ray.far_from[i] = from(ray.far_face[i]);
  }
  return ray;
}

// Which of the children from `lane` on, as many as F has lanes, a ray meets at a depth from `least` to `limit`, and where
// it enters each.
template <class F>
struct ChildLanes {
  Mask<F> met;
  F near;
};
template <class F>
[[gnu::always_inline]] inline ChildLanes<F> meet_lanes(const BvhNode& node, std::size_t lane,
                                                       const BoxRay& ray, float least, float limit) {
  const auto depth = [&](std::size_t face, float from, float inverse) {
    return (load<F>(node.face[face].data() + lane) - F(from)) * F(inverse);
  };
  const auto near = [&](std::size_t i) { return depth(ray.near_face[i], ray.near_from[i], ray.inverse[i]); };
  const auto far = [&](std::size_t i) { return depth(ray.far_face[i], ray.far_from[i], ray.inverse[i]); };
  const F enters = lane_max<F>(lane_max<F>(lane_max<F>(F(least), near(0)), near(1)), near(2));
  const F leaves = lane_min<F>(lane_min<F>(far(0), far(1)), far(2)) * F(kBoxSlack);
  return {enters <= lane_min<F>(F(limit), leaves), enters};
}

// The children that a ray meets as bits, and where it enters them.
struct MetChildren {
  std::uint32_t bits = 0;
  alignas(64) std::array<float, BvhNode::kWidth> entry;
};

template <class F>
[[gnu::always_inline]] inline void meet_children(const BvhNode& node, const BoxRay& ray, float least,
                                                 float limit, MetChildren& met) {
  met.bits = 0;
  for (std::size_t lane = 0; lane < BvhNode::kWidth; lane += kLanes<F>) {
    const ChildLanes<F> children = meet_lanes<F>(node, lane, ray, least, limit);
    store<F>(children.near, met.entry.data() + lane);
    met.bits |= mask_bits<F>(children.met) << lane;
  }
}

// All leaves met at a depth from `from`, or from 0, to `limit`. Depth first, nearer children first. Leaf:
// double(first, count, limit).
template <class F, class Leaf>
[[gnu::always_inline]] inline std::uint64_t walk(const Bvh& bvh, const Ray& arriving, double from,
                                                 double limit, const Leaf& leaf) {
  struct Entry {
    float near;
    std::uint32_t first, count;
  };
  std::uint64_t entered = 0;
  if (bvh.nodes.empty()) return entered;
  const auto lanes = [](const glm::dvec3& v) { return std::array<double, 3>{v.x, v.y, v.z}; };
  const BoxRays<double> box = box_rays<double>(bvh, lanes(arriving.origin), lanes(arriving.direction));
  const BoxRay ray = box_ray([&](std::size_t row) { return box.from[row]; },
                             [&](std::size_t axis) { return box.inverse[axis]; });
  std::array<Entry, Bvh::kMaxDepth*(BvhNode::kWidth - 1) + 1> stack;
  std::size_t size = 0;
  const float least = box_least<double>(from, box.scale);
  float farthest = box_limit<double>(limit, box.scale);
  MetChildren met;
  Entry top{0, 0, 0};
  while (true) {
    if (top.count > 0) {
      limit = leaf(top.first, top.count, limit);
      if (limit < 0) return entered;
      farthest = box_limit<double>(limit, box.scale);
    } else {
      ++entered;
      const BvhNode& node = bvh.nodes[top.first];
      meet_children<F>(node, ray, least, farthest, met);
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
    } while (top.near > farthest);
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
    low[i] = static_cast<float>(from - (0x1p-23 * lane_abs(from) + pad));
    high[i] = static_cast<float>(to + (0x1p-23 * lane_abs(to) + pad));
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
