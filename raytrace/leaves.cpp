// SPDX-License-Identifier: MIT
#include "raytrace/leaves.h"

#include <algorithm>

#include "common/parallel.h"

namespace sidelight::raytrace {
namespace {

std::vector<std::uint32_t> primitives_of(const Scene& scene, ObjectKind kind) {
  std::vector<std::uint32_t> primitives;
  for (const Object& object : scene.objects) {
    if (object.kind != kind) continue;
    for (std::uint32_t i = 0; i < object.count; ++i)
      if (kind != ObjectKind::mesh || !scene.triangles[object.first + i].degenerate)
        primitives.push_back(object.first_primitive + i);
  }
  return primitives;
}

// numbers(primitive) are the kRows doubles that define it.
template <int kRows, class Numbers>
void fill_rows(Leaves<kRows>& leaves, int threads, const Numbers& numbers) {
  const Bvh& bvh = leaves.bvh;
  const std::size_t size = kRows * bvh.items.size();
  leaves.rows = std::make_unique_for_overwrite<double[]>(size + Leaves<kRows>::kPadding);
  std::fill_n(leaves.rows.get() + size, Leaves<kRows>::kPadding, 0.0);
  parallel_for(static_cast<int>(bvh.nodes.size()), threads, [&](int node, int) {
    const BvhNode& parent = bvh.nodes[static_cast<std::size_t>(node)];
    for (std::size_t slot = 0; slot < BvhNode::kWidth; ++slot) {
      double* row = leaves.rows.get() + std::size_t{kRows} * parent.first[slot];
      for (std::uint32_t i = 0; i < parent.count[slot]; ++i) {
        const std::array<double, kRows> values = numbers(bvh.items[parent.first[slot] + i]);
        for (std::size_t r = 0; r < kRows; ++r) row[r * parent.count[slot] + i] = values[r];
      }
    }
  });
}

}  // namespace

TriangleLeaves triangle_leaves(const Scene& scene, int threads) {
  const auto corners_of = [&](std::uint32_t primitive) {
    return corners(scene, scene.triangles[primitive_ref(scene, primitive).index]);
  };
  TriangleLeaves leaves;
  leaves.bvh = build_bvh(
      primitives_of(scene, ObjectKind::mesh),
      [&](std::uint32_t primitive) {
        const auto [v0, v1, v2] = corners_of(primitive);
        return Box{glm::min(v0, glm::min(v1, v2)), glm::max(v0, glm::max(v1, v2))};
      },
      threads);
  fill_rows(leaves, threads, [&](std::uint32_t primitive) {
    const auto [v0, v1, v2] = corners_of(primitive);
    return std::array{v0.x, v0.y, v0.z, v1.x, v1.y, v1.z, v2.x, v2.y, v2.z};
  });
  return leaves;
}

SphereLeaves sphere_leaves(const Scene& scene, int threads) {
  const auto sphere_of = [&](std::uint32_t primitive) {
    return scene.spheres[primitive_ref(scene, primitive).index];
  };
  SphereLeaves leaves;
  leaves.bvh = build_bvh(
      primitives_of(scene, ObjectKind::sphere),
      [&](std::uint32_t primitive) {
        const Sphere sphere = sphere_of(primitive);
        return Box{sphere.center - sphere.radius, sphere.center + sphere.radius};
      },
      threads);
  fill_rows(leaves, threads, [&](std::uint32_t primitive) {
    const Sphere sphere = sphere_of(primitive);
    return std::array{sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius};
  });
  return leaves;
}

}  // namespace sidelight::raytrace
