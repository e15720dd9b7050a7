// SPDX-License-Identifier: MIT
// Bundles: up to sixteen rays, of any origins and directions, that go down the tree together. Neighbours of a picture are
// reflected and refracted to much the same places: a node that is met by several of them is fetched once, its children
// are put in order once, and none of the rays waits for the result of another. Included by the kernels only
// (kernels_in_lanes.h).
//
// E. Mansson, J. Munkberg, T. Akenine-Moller, "Deep Coherent Ray Tracing", 2007; here the bundle is small. Where many of
// its rays meet a node, they are lanes, and its boxes are asked one after the other; where few do, each ray is tested
// against eight boxes at once, as if it were alone.
#pragma once

#include "raytrace/bvh_kernel.h"

namespace sidelight::raytrace {

// Up to this many rays, as they are asked for.
struct BundleRays {
  static constexpr std::size_t kCapacity = 16;
  using Lanes = std::array<double, kCapacity>;

  std::size_t size = 0;
  alignas(64) std::array<Lanes, 3> origin;
  alignas(64) std::array<Lanes, 3> direction;
  alignas(64) Lanes start;  // they are asked for what is met from this depth on
  alignas(64) Lanes limit;  // up to this one; negative: for nothing more

  void add(const Ray& ray, double from, double to) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin[axis][size] = ray.origin[static_cast<int>(axis)];
      direction[axis][size] = ray.direction[static_cast<int>(axis)];
    }
    start[size] = from;
    limit[size++] = to;
  }
  // Other lanes, which are worked at together with the last rays, become rays for which nothing is asked.
  void fill_up() {
    for (std::size_t r = size; r < kCapacity; ++r) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        origin[axis][r] = 0;
        direction[axis][r] = 1;
      }
      start[r] = 0;
      limit[r] = -1;
    }
  }
};

// The same as the boxes of a tree see them (BoxRays).
struct Bundle {
  static constexpr std::size_t kCapacity = BundleRays::kCapacity;
  using Lanes = std::array<float, kCapacity>;

  alignas(64) std::array<Lanes, 6> from;
  alignas(64) std::array<Lanes, 3> inverse;
  alignas(64) Lanes least;
  alignas(64) Lanes limit;  // negative: the ray meets nothing
  alignas(64) BundleRays::Lanes scale;

  BoxRay ray(std::size_t r) const {
    return box_ray([&](std::size_t row) { return from[row][r]; },
                   [&](std::size_t axis) { return inverse[axis][r]; });
  }
  void set_limit(std::size_t r, double depth) {
    limit[r] = depth < 0 ? -1 : box_limit<double>(depth, scale[r]);
  }
};

// Rays that are not finite, or have no direction, meet nothing.
template <class D>
[[gnu::always_inline]] inline void set_up(const Bvh& bvh, const BundleRays& rays, Bundle& bundle) {
  using F = FloatBeside<D>;
  for (std::size_t lane = 0; lane < Bundle::kCapacity; lane += kLanes<D>) {
    const auto vector = [&](const std::array<BundleRays::Lanes, 3>& v) {
      return std::array<D, 3>{load<D>(&v[0][lane]), load<D>(&v[1][lane]), load<D>(&v[2][lane])};
    };
    std::array<D, 3> origin = vector(rays.origin), direction = vector(rays.direction);
    D longest(0), sum(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      longest = lane_max<D>(longest, lane_abs<D>(direction[axis]));
      sum = sum + (lane_abs<D>(origin[axis]) + lane_abs<D>(direction[axis]));
    }
    const D limit = load<D>(&rays.limit[lane]);
    const Mask<D> asks = limit >= D(0) && longest > D(0) && sum - sum == D(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {  // the others: any that are finite
      origin[axis] = select<D>(asks, origin[axis], D(0));
      direction[axis] = select<D>(asks, direction[axis], D(1));
    }
    const BoxRays<D> box = box_rays<D>(bvh, origin, direction);
    for (std::size_t row = 0; row < 6; ++row) store<F>(box.from[row], &bundle.from[row][lane]);
    for (std::size_t axis = 0; axis < 3; ++axis) store<F>(box.inverse[axis], &bundle.inverse[axis][lane]);
    store<D>(box.scale, &bundle.scale[lane]);
    store<F>(box_least<D>(load<D>(&rays.start[lane]), box.scale), &bundle.least[lane]);
    store<F>(box_limit<D>(select<D>(asks, limit, D(0)), box.scale), &bundle.limit[lane]);
    for (std::uint32_t idle = ~mask_bits<D>(asks) & ((1u << kLanes<D>)-1); idle != 0; idle &= idle - 1)
      bundle.limit[lane + static_cast<std::size_t>(std::countr_zero(idle))] = -1;
  }
}

// The lanes whose bits are set.
template <class R>
[[gnu::always_inline]] inline Mask<R> lanes_of(std::uint32_t bits) {
  alignas(64) static constexpr std::array<std::int32_t, Bundle::kCapacity> kBit = {
      1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
  using I = Ints<R>;
  return real_mask<R>((I(static_cast<std::int32_t>(bits)) & load<I>(kBit.data())) != I(0));
}

// The children of a node that some of the rays meet, as bits, for each of them by which, and where the first of these
// enters.
struct MetByBundle {
  std::uint32_t children = 0;
  alignas(64) std::array<std::int32_t, BvhNode::kWidth> rays;
  alignas(64) std::array<float, BvhNode::kWidth> entry;
};

// Ray by ray, the children in lanes F.
template <class F>
[[gnu::always_inline]] inline void meet_ray_by_ray(const BvhNode& node, const Bundle& bundle,
                                                   std::uint32_t rays, MetByBundle& met) {
  using I = Ints<F>;
  for (std::size_t lane = 0; lane < BvhNode::kWidth; lane += kLanes<F>) {
    F entry(kInfinity);
    I by(0);
    for (std::uint32_t left = rays; left != 0; left &= left - 1) {
      const auto r = static_cast<std::size_t>(std::countr_zero(left));
      const ChildLanes<F> of_ray = meet_lanes<F>(node, lane, bundle.ray(r), bundle.least[r], bundle.limit[r]);
      entry = select<F>(of_ray.met, lane_min<F>(of_ray.near, entry), entry);
      by = by | select<I>(integer_mask<F>(of_ray.met), I(1 << r), I(0));
      met.children |= mask_bits<F>(of_ray.met) << lane;
    }
    store<F>(entry, met.entry.data() + lane);
    store<I>(by, met.rays.data() + lane);
  }
}

// Child by child, the rays in lanes R: the same in every bit.
template <class R>
[[gnu::always_inline]] inline void meet_child_by_child(const BvhNode& node, const Bundle& bundle,
                                                       std::uint32_t rays, MetByBundle& met) {
  const R infinity(kInfinity);
  met.rays.fill(0);
  met.entry.fill(kInfinity);
  for (std::size_t lane = 0; lane < Bundle::kCapacity; lane += kLanes<R>) {
    const auto of = [&](const Bundle::Lanes& lanes) { return load<R>(lanes.data() + lane); };
    const R limit = select<R>(lanes_of<R>(rays >> lane), of(bundle.limit), R(-1));
    for (std::size_t c = 0; c < BvhNode::kWidth; ++c) {
      R enters = of(bundle.least), leaves = infinity;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const R inverse = of(bundle.inverse[axis]);
        const R low = (R(node.face[axis][c]) - of(bundle.from[axis])) * inverse;
        const R high = (R(node.face[axis + 3][c]) - of(bundle.from[axis + 3])) * inverse;
        const Mask<R> reversed = inverse < R(0);
        enters = lane_max<R>(enters, select<R>(reversed, high, low));
        leaves = lane_min<R>(leaves, select<R>(reversed, low, high));
      }
      const Mask<R> here = enters <= lane_min<R>(limit, leaves * R(kBoxSlack));
      const std::uint32_t by = mask_bits<R>(here);
      if (by == 0) continue;
      met.children |= 1u << c;
      met.rays[c] |= static_cast<std::int32_t>(by << lane);
      met.entry[c] = lane_min(met.entry[c], least<R>(select<R>(here, enters, infinity)));
    }
  }
}

// All leaves that the rays in `all` meet, each with the rays that meet it, nearer ones first. Leaf: void(first, count,
// rays), may lower bundle.limit of these rays.
template <class F, class R, class Leaf>
[[gnu::always_inline]] inline std::uint64_t walk(const Bvh& bvh, Bundle& bundle, std::uint32_t all,
                                                 const Leaf& leaf) {
  constexpr int kFew = 4;  // rays that are asked one by one
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
    for (std::size_t lane = 0; lane < Bundle::kCapacity; lane += kLanes<R>)
      rays |= mask_bits<R>(R(top.near) <= load<R>(bundle.limit.data() + lane)) << lane;
    rays &= top.rays;
    if (rays == 0) continue;
    if (top.count > 0) {
      leaf(top.first, top.count, rays);
      continue;
    }
    const int active = std::popcount(rays);
    entered += static_cast<std::uint64_t>(active);
    const BvhNode& node = bvh.nodes[top.first];
    MetByBundle met;
    if (active <= kFew)
      meet_ray_by_ray<F>(node, bundle, rays, met);
    else
      meet_child_by_child<R>(node, bundle, rays, met);
    const std::size_t base = size;
    for (std::uint32_t left = met.children; left != 0; left &= left - 1) {
      const auto c = static_cast<std::size_t>(std::countr_zero(left));
      const Entry child{met.entry[c], node.first[c], node.count[c], static_cast<std::uint32_t>(met.rays[c])};
      std::size_t at = size++;
      for (; at > base && stack[at - 1].near <= child.near; --at) stack[at] = stack[at - 1];
      stack[at] = child;
    }
  }
  return entered;
}

}  // namespace sidelight::raytrace
