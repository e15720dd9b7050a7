// SPDX-License-Identifier: MIT
// Bundles: up to eight rays, of any origins and directions, that go down the tree together. Neighbours of a picture are
// reflected and refracted to much the same places: a node that is met by several of them is fetched once, its children
// are put in order once, and none of the rays waits for the result of another. Included by the kernels only
// (ray_kernel.h).
//
// E. Mansson, J. Munkberg, T. Akenine-Moller, "Deep Coherent Ray Tracing", 2007; here the bundle is small, and each ray
// is tested against eight boxes at once, as if it were alone.
#pragma once

#include "raytrace/bvh_kernel.h"

namespace sidelight::raytrace {

struct Bundle {
  static constexpr std::size_t kCapacity = 8;

  std::array<BoxRay, kCapacity> rays;
  std::array<float, kCapacity> least, limit;
};

// Byte c, bit r of the result is byte r, bit c of x. (H. Warren, "Hacker's Delight", section 7-3.)
inline std::uint64_t transposed(std::uint64_t x) {
  const auto swap = [&](int shift, std::uint64_t mask) {
    const std::uint64_t t = (x ^ x >> shift) & mask;
    x ^= t ^ t << shift;
  };
  swap(7, 0x00aa00aa00aa00aa);
  swap(14, 0x0000cccc0000cccc);
  swap(28, 0x00000000f0f0f0f0);
  return x;
}

// The children of a node that some of the rays meet: by which, and where the first of them enters.
struct MetByBundle {
  std::uint64_t rays = 0;  // byte c: those that meet child c
  alignas(64) std::array<float, BvhNode::kWidth> entry;
};

template <class F>
[[gnu::always_inline]] inline MetByBundle meet_children(const BvhNode& node, const Bundle& bundle,
                                                        std::uint32_t rays) {
  MetByBundle all;
  all.entry.fill(std::numeric_limits<float>::infinity());
  std::uint64_t children = 0;  // byte r: those that ray r meets
  MetChildren met;
  for (; rays != 0; rays &= rays - 1) {
    const auto r = static_cast<std::size_t>(std::countr_zero(rays));
    meet_children<F>(node, bundle.rays[r], bundle.least[r], bundle.limit[r], met);
    children |= std::uint64_t{met.bits} << 8 * r;
    for (std::size_t lane = 0; lane < BvhNode::kWidth; lane += kLanes<F>)
      store<F>(lane_min<F>(load<F>(met.entry.data() + lane), load<F>(all.entry.data() + lane)),
               all.entry.data() + lane);
  }
  all.rays = transposed(children);
  return all;
}

// All leaves that the rays in `all` meet, each with the rays that meet it, nearer ones first. Leaf: void(first, count,
// ray), once for each of these rays, may lower bundle.limit[ray].
template <class F, class Leaf>
[[gnu::always_inline]] inline std::uint64_t walk(const Bvh& bvh, Bundle& bundle, std::uint32_t all,
                                                 const Leaf& leaf) {
  struct Entry {
    float near;
    std::uint32_t first, count, rays;
  };
  std::uint64_t entered = 0;
  std::array<Entry, Bvh::kMaxDepth*(BvhNode::kWidth - 1) + 1> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0, 0, all};
  while (size > 0) {
    const Entry top = stack[--size];
    std::uint32_t rays = 0;  // that have met nothing before
    for (std::uint32_t left = top.rays; left != 0; left &= left - 1) {
      const int r = std::countr_zero(left);
      rays |= std::uint32_t{top.near <= bundle.limit[static_cast<std::size_t>(r)]} << r;
    }
    if (top.count > 0) {
      for (; rays != 0; rays &= rays - 1)
        leaf(top.first, top.count, static_cast<std::size_t>(std::countr_zero(rays)));
      continue;
    }
    if (rays == 0) continue;
    entered += static_cast<std::uint64_t>(std::popcount(rays));
    const BvhNode& node = bvh.nodes[top.first];
    const MetByBundle met = meet_children<F>(node, bundle, rays);
    const std::size_t base = size;
    for (std::uint64_t left = met.rays; left != 0;) {
      const auto c = static_cast<std::size_t>(std::countr_zero(left) / 8);
      const auto by = static_cast<std::uint32_t>(left >> 8 * c & 0xff);
      left &= ~(std::uint64_t{0xff} << 8 * c);
      const Entry child{met.entry[c], node.first[c], node.count[c], by};
      std::size_t at = size++;
      for (; at > base && stack[at - 1].near <= child.near; --at) stack[at] = stack[at - 1];
      stack[at] = child;
    }
  }
  return entered;
}

}  // namespace sidelight::raytrace
