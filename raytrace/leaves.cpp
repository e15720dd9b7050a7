// SPDX-License-Identifier: MIT
#include "raytrace/leaves.h"

#include <algorithm>

#include "common/parallel.h"

namespace sidelight::raytrace {
namespace {

std::vector<std::uint32_t> primitives_of(const Scene& scene, ObjectKind kind) {
  std::vector<std::uint32_t> primitives;
  primitives.reserve(kind == ObjectKind::mesh ? scene.triangles.size() : scene.spheres.size());
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
  leaves.rows.resize(size + Leaves<kRows>::kPadding);
  std::fill_n(leaves.rows.data() + size, Leaves<kRows>::kPadding, 0.0);
  const auto fill_leaf = [&](std::uint32_t first, std::uint32_t count) {
    double* row = leaves.rows.data() + std::size_t{kRows} * first;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::array<double, kRows> values = numbers(bvh.items[first + i]);
      for (std::size_t r = 0; r < kRows; ++r) row[r * count + i] = values[r];
    }
  };
  parallel_blocks(bvh.nodes.size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node)
      for (std::size_t slot = 0; slot < BvhNode::kWidth; ++slot)
        fill_leaf(bvh.nodes[node].first[slot], bvh.nodes[node].count[slot]);
  });
}

// box_of(primitive) is called from several threads.
template <int kRows, class BoxOf, class Numbers>
Leaves<kRows> make_leaves(const std::vector<std::uint32_t>& primitives, int threads, const BoxOf& box_of,
                          const Numbers& numbers) {
  const auto boxes_of = [&](std::span<const std::uint32_t> some, Box* boxes) {
    for (const std::uint32_t primitive : some) *boxes++ = box_of(primitive);
  };
  Leaves<kRows> leaves;
  leaves.bvh = build_bvh(primitives, boxes_of, threads);
  fill_rows(leaves, threads, numbers);
  return leaves;
}

}  // namespace

TriangleLeaves triangle_leaves(const Scene& scene, int threads) {
  const auto corners_of = [&](std::uint32_t primitive) {
    return corners(scene, scene.triangles[primitive_ref(scene, primitive).index]);
  };
  const auto box_of = [&](std::uint32_t primitive) {
    const auto [v0, v1, v2] = corners_of(primitive);
    return Box{glm::min(v0, glm::min(v1, v2)), glm::max(v0, glm::max(v1, v2))};
  };
  return make_leaves<9>(primitives_of(scene, ObjectKind::mesh), threads, box_of,
                        [&](std::uint32_t primitive) {
                          const auto [v0, v1, v2] = corners_of(primitive);
                          return std::array{v0.x, v0.y, v0.z, v1.x, v1.y, v1.z, v2.x, v2.y, v2.z};
                        });
}

SphereLeaves sphere_leaves(const Scene& scene, int threads) {
  const auto sphere_of = [&](std::uint32_t primitive) {
    return scene.spheres[primitive_ref(scene, primitive).index];
  };
  const auto box_of = [&](std::uint32_t primitive) {
    const Sphere sphere = sphere_of(primitive);
    return Box{sphere.center - sphere.radius, sphere.center + sphere.radius};
  };
  return make_leaves<4>(primitives_of(scene, ObjectKind::sphere), threads, box_of,
                        [&](std::uint32_t primitive) {
                          const Sphere sphere = sphere_of(primitive);
                          return std::array{sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius};
                        });
}

}  // namespace sidelight::raytrace
