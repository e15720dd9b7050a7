// SPDX-License-Identifier: MIT
// A bounding volume hierarchy over boxes, eight wide. It does not know what a primitive is: it is built from boxes, and
// a traversal hands the items it reaches to the caller (kernels.h).
//
// I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007 (binned surface area heuristic);
// I. Wald, C. Benthin, S. Boulos, "Getting Rid of Packets", 2008 (wide nodes: all children of a node at once);
// T. Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013 (conservative slabs).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "common/kept_memory.h"
#include "common/model/visibility.h"

namespace sidelight::raytrace {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

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
};

// Eight children side by side, so that one instruction asks one question of all of them. 256 bytes.
struct alignas(64) BvhNode {
  static constexpr int kWidth = 8;
  // Faces of the children's boxes, relative to Bvh::center and rounded outward: low x, y, z, then high x, y, z. A slot
  // without a child has low = inf and high = -inf, which no ray meets.
  std::array<std::array<float, kWidth>, 6> face;
  std::array<std::uint32_t, kWidth> first;  // leaf: into Bvh::items; inner: into Bvh::nodes
  std::array<std::uint32_t, kWidth> count;  // items of a leaf, at most Bvh::kMaxLeaf; 0 for an inner node
};
static_assert(sizeof(BvhNode) == 256);

struct Bvh {
  KeptArray<BvhNode> nodes;        // nodes[0] is the root; empty for no boxes
  KeptArray<std::uint32_t> items;  // what was built over, leaf by leaf
  glm::dvec3 center{0};  // what the nodes' boxes are relative to; 0 along axes that cross the world's
  double reach = 0;      // greatest coordinate of any box
  static constexpr std::uint32_t kMaxLeaf = 8;
  static constexpr int kMaxDepth = 64;  // nodes above any leaf
};

// Writes the boxes of these items, one after another. They are finite.
using BoxesOf = std::function<void(std::span<const std::uint32_t> items, Box* boxes)>;

// boxes_of is called from several threads, and twice for each item: boxes as doubles would be as much memory as all that
// the builder holds besides. The same for any number of threads.
Bvh build_bvh(std::span<const std::uint32_t> items, const BoxesOf& boxes_of, int threads = 1);

}  // namespace sidelight::raytrace
