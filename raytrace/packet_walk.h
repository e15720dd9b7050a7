// SPDX-License-Identifier: MIT
// A packet down a hierarchy. See packet_kernel.h.
#pragma once

#include "raytrace/packet_spheres.h"
#include "raytrace/packet_triangles.h"

namespace sidelight::raytrace {

// n . x - offset of one corner of each of eight boxes: the one that lies farthest along n, or nearest.
struct PacketPlane {
  std::array<std::size_t, 3> face;  // rows of BvhNode::face
  std::array<float, 3> n;
  float offset = 0;  // n . (o - center), by the slack on the safe side
};
struct PacketPlanes {
  std::array<PacketPlane, 4> side;  // >= 0 inside
  PacketPlane last, first;          // n . (x - o) is the depth of x, the same for all rays
};

// Bound: the float sum of three products, 2^-22 |n| reach, and the pad for all rounding and nearness: 2^-20 with room.
template <class B>
PacketPlane packet_plane(const RayPacket& p, const Bvh& bvh, const Vec3<double>& normal, double scale,
                         bool farthest) {
  PacketPlane out;
  const std::array<double, 3> n{scale * normal.x, scale * normal.y, scale * normal.z};
  double offset = 0, size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    out.n[i] = static_cast<float>(n[i]);
    out.face[i] = (n[i] >= 0) == farthest ? i + 3 : i;
    offset += n[i] * (p.origin[axis] - bvh.center[axis]);
    size += lane_abs(n[i]);
  }
  const double slack = 0x1p-19 * size * p.reach;
  out.offset = static_cast<float>(farthest ? offset - slack : offset + slack);
  return out;
}

// Planes through the origin along the packet's four sides: with D = W . (U x V), d . ((W + u1 U) x V) = D (u1 - u).
template <class B>
PacketPlanes packet_planes(const RayPacket& p, const Bvh& bvh) {
  const auto vec = [](const glm::dvec3& v) { return Vec3<double>{v.x, v.y, v.z}; };
  const Vec3<double> W = vec(p.W), U = vec(p.U), V = vec(p.V), depth = cross(U, V);
  const double D = dot(W, depth), turn = D < 0 ? -1.0 : 1.0;
  // A little wider than the rays, for the rounding of u and v.
  const double u1 = (1 + 0x1p-20) * static_cast<double>(p.extent_u) + p.place_error;
  const double v1 = (1 + 0x1p-20) * static_cast<double>(p.extent_v) + p.place_error;
  const auto side = [&](const Vec3<double>& a, const Vec3<double>& b) {
    const Vec3<double> n = cross(a, b);
    return packet_plane<B>(p, bvh, n, turn / l1(n), true);
  };
  PacketPlanes out;
  out.side = {side(W + u1 * U, V), side(V, W - u1 * U), side(U, W + v1 * V), side(W - v1 * V, U)};
  out.last = packet_plane<B>(p, bvh, depth, 1 / D, true);
  out.first = packet_plane<B>(p, bvh, depth, 1 / D, false);
  return out;
}

// The children that the packet may meet, as bits, and the depth from which on.
template <class B>
std::uint32_t meet_boxes(const BvhNode& node, const PacketPlanes& planes,
                         std::array<float, BvhNode::kWidth>& depth) {
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < BvhNode::kWidth; lane += kLanes<B>) {
    const auto at = [&](const PacketPlane& plane) {
      const auto part = [&](std::size_t i) {
        return B(plane.n[i]) * load<B>(&node.face[plane.face[i]][lane]);
      };
      return ((part(0) + part(1)) + part(2)) - B(plane.offset);
    };
    Mask<B> met = at(planes.last) >= B(0);
    for (const PacketPlane& plane : planes.side) met = met && at(plane) >= B(0);
    store(lane_max<B>(at(planes.first), B(0)), &depth[lane]);
    bits |= mask_bits<B>(met) << lane;
  }
  return bits;
}

// All lines of a node, or of a leaf: they will be asked for soon, and where the tree is large, they are far away.
template <class Tree>
void prefetch(const Tree& leaves, std::uint32_t first, std::uint32_t count) {
  constexpr std::size_t kLine = 64;
  const auto* from = count == 0 ? reinterpret_cast<const char*>(&leaves.bvh.nodes[first])
                                : reinterpret_cast<const char*>(leaves.leaf(first));
  const std::size_t size = count == 0 ? sizeof(BvhNode) : Tree::kRowCount * sizeof(double) * count;
  for (std::size_t at = 0; at < size; at += kLine) __builtin_prefetch(from + at);
}

// A leaf in steps of RayPacket::budget, a node being one.
template <class Tree>
constexpr int kLeafWork = std::is_same_v<Tree, SphereLeaves> ? 16 : 4;

template <class F, class B, class D, class Tree>
void walk_packet(const Prepared& prepared, const PacketAxes& axes, const Tree& leaves, RayPacket& p,
                 SignCounts& counts) {
  const Bvh& bvh = leaves.bvh;
  if (bvh.nodes.empty() || p.groups == 0) return;
  const PacketPlanes planes = packet_planes<B>(p, bvh);
  struct Entry {
    float depth;
    std::uint32_t first, count;
  };
  std::array<Entry, Bvh::kMaxDepth*(BvhNode::kWidth - 1) + 1> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0, 0};
  while (size > 0) {
    const Entry top = stack[--size];
    // Surely behind all that is kept; all rays of an infinite w are done.
    if (p.least == std::numeric_limits<float>::infinity()) return;
    if (top.depth * p.least > 1 + 0x1p-12f) continue;
    p.budget -= top.count > 0 ? kLeafWork<Tree> : 1;
    if (p.budget < 0) return;
    if (top.count > 0) {
      test_leaf<F, D>(prepared, axes, leaves, top.first, top.count, p, counts);
      continue;
    }
    ++counts.nodes;
    const BvhNode& node = bvh.nodes[top.first];
    alignas(64) std::array<float, BvhNode::kWidth> depth;
    const std::uint32_t met = meet_boxes<B>(node, planes, depth);
    const std::size_t base = size;
    for (std::uint32_t bits = met; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      const Entry child{depth[i], node.first[i], node.count[i]};
      prefetch(leaves, child.first, child.count);
      std::size_t at = size++;
      for (; at > base && stack[at - 1].depth <= child.depth; --at) stack[at] = stack[at - 1];
      stack[at] = child;
    }
  }
}

}  // namespace sidelight::raytrace
