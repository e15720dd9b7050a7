// SPDX-License-Identifier: MIT
// A bounding volume hierarchy over boxes. It does not know what a primitive is: it is built from boxes, and a
// traversal hands the primitives of the leaves it reaches to the caller.
//
// I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007 (binned surface area heuristic);
// T. Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013 (conservative slabs, here by padding the box).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "common/model/visibility.h"

namespace sidelight::raytrace {

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void grow(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void grow(const Box& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
  // Half the surface; 0 for an empty box.
  double half_area() const {
    const glm::dvec3 d = glm::max(high - low, glm::dvec3(0));
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

struct BvhNode {
  std::array<float, 3> low, high;   // rounded outward
  std::uint32_t first = 0;          // leaf: into Bvh::items; inner: its left child, the right one follows it
  std::uint32_t count = 0;          // of a leaf; 0 for an inner node
};

struct Bvh {
  std::vector<BvhNode> nodes;           // nodes[0] is the root; empty for no boxes
  std::vector<std::uint32_t> items;     // what was built over, leaf by leaf
  double reach = 0;                     // greatest coordinate of any box
  static constexpr int kMaxDepth = 96;  // of any leaf
};

// `boxes[i]` is the box of `items[i]`. Boxes are finite.
Bvh build_bvh(std::span<const Box> boxes, std::span<const std::uint32_t> items);

// Calls leaf(item, limit) for every item whose padded box the ray may meet at a depth <= limit, nearer children first.
// leaf returns the new limit; a negative one ends the traversal. The pad covers the rounding of v - o and of sphere
// roots (64 u of all coordinates involved), the slack on the limit that of a depth (visibility.h: 2^-18): no hit that
// visibility.h would report is lost. Returns the number of nodes entered.
template <class Leaf>
std::uint64_t traverse(const Bvh& bvh, const Ray& ray, double limit, const Leaf& leaf) {
  std::uint64_t entered = 0;
  if (bvh.nodes.empty()) return entered;
  const glm::dvec3 inverse = 1.0 / ray.direction;
  const double reach = std::max({bvh.reach, std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)});
  const double pad = 64 * 0x1p-53 * reach;

  // Entry depth of a node's box, infinite where the ray misses it. Near and far plane by the sign bit, and comparisons
  // that keep the old value on NaN (0 * inf, a ray in a box's face): no such ray is lost.
  const auto entry = [&](const BvhNode& node) {
    double near = 0, far = limit * (1 + 0x1p-16);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const double low = (node.low[i] - pad) - ray.origin[axis], high = (node.high[i] + pad) - ray.origin[axis];
      const bool reversed = std::signbit(inverse[axis]);
      const double t0 = (reversed ? high : low) * inverse[axis], t1 = (reversed ? low : high) * inverse[axis];
      near = t0 > near ? t0 : near;
      far = t1 < far ? t1 : far;
    }
    return near <= far * (1 + 0x1p-50) ? near : std::numeric_limits<double>::infinity();
  };

  struct Entry {
    std::uint32_t node;
    double near;
  };
  std::array<Entry, Bvh::kMaxDepth + 1> stack;
  int size = 0;
  const double root = entry(bvh.nodes[0]);
  if (std::isfinite(root)) stack[static_cast<std::size_t>(size++)] = {0, root};
  while (size > 0) {
    const Entry top = stack[static_cast<std::size_t>(--size)];
    if (top.near > limit * (1 + 0x1p-16)) continue;
    ++entered;
    const BvhNode& node = bvh.nodes[top.node];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        limit = leaf(bvh.items[i], limit);
        if (limit < 0) return entered;
      }
      continue;
    }
    const double left = entry(bvh.nodes[node.first]), right = entry(bvh.nodes[node.first + 1]);
    const Entry nearer = left <= right ? Entry{node.first, left} : Entry{node.first + 1, right};
    const Entry farther = left <= right ? Entry{node.first + 1, right} : Entry{node.first, left};
    if (std::isfinite(farther.near)) stack[static_cast<std::size_t>(size++)] = farther;
    if (std::isfinite(nearer.near)) stack[static_cast<std::size_t>(size++)] = nearer;
  }
  return entered;
}

// Calls visit(item) for every item whose box reaches to within `distance` of the point along each axis, and some others.
template <class Visit>
void visit_near(const Bvh& bvh, const glm::dvec3& point, double distance, const Visit& visit) {
  if (bvh.nodes.empty()) return;
  const auto near = [&](const BvhNode& node) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      if (point[axis] < node.low[i] - distance || point[axis] > node.high[i] + distance) return false;
    }
    return true;
  };
  std::array<std::uint32_t, Bvh::kMaxDepth + 1> stack;
  int size = 0;
  stack[static_cast<std::size_t>(size++)] = 0;
  while (size > 0) {
    const BvhNode& node = bvh.nodes[stack[static_cast<std::size_t>(--size)]];
    if (!near(node)) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(bvh.items[i]);
    if (node.count > 0) continue;
    stack[static_cast<std::size_t>(size++)] = node.first + 1;
    stack[static_cast<std::size_t>(size++)] = node.first;
  }
}

}  // namespace sidelight::raytrace
