// SPDX-License-Identifier: MIT
// The hierarchy loses nothing: every closed box that a ray meets is reached (BVH-1), with room for the
// rounding of hits, nearer boxes first; and no input makes it deeper than the traversal's stack.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <set>

#include "raytrace/kernels.h"
#include "tests/hardcases/result.h"
#include "tests/support/random.h"
#include "tests/support/wide.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::Box;
using raytrace::Bvh;

namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

Bvh bvh_over(const std::vector<Box>& boxes, int threads = 1) {
  std::vector<std::uint32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0u);
  const auto boxes_of = [&](std::span<const std::uint32_t> some, Box* to) {
    for (const std::uint32_t item : some) *to++ = boxes[item];
  };
  return raytrace::build_bvh(items, boxes_of, threads);
}

std::vector<Isa> isas() {
  std::vector<Isa> all;
  for (const Isa isa : kIsas)
    if (machine_has(isa)) all.push_back(isa);
  return all;
}

// In the order of the traversal.
std::vector<std::uint32_t> visited(const Bvh& bvh, const Ray& ray, Isa isa = best_isa()) {
  std::vector<std::uint32_t> items;
  const auto visit = [&](std::uint32_t item, double limit) {
    items.push_back(item);
    return limit;
  };
  raytrace::traverse(bvh, ray, kForever, visit, isa);
  return items;
}

std::set<std::uint32_t> reached(const Bvh& bvh, const Ray& ray) {
  const std::vector<std::uint32_t> items = visited(bvh, ray);
  for (const Isa isa : isas()) CHECK(visited(bvh, ray, isa) == items);
  return {items.begin(), items.end()};
}

// Whether the ray meets the closed box at some t > 0, with quotients in 113 bits: monotone, so no box is left
// out.
bool meets(const Box& box, const Ray& ray) {
  Quad near = 0, far = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    const Quad o = ray.origin[axis], d = ray.direction[axis], low = box.low[axis], high = box.high[axis];
    if (d == 0) {
      if (o < low || o > high) return false;
      continue;
    }
    const Quad a = (low - o) / d, b = (high - o) / d;
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return far > 0 && near <= far;
}

std::uint64_t boxes_lost(const Bvh& bvh, const std::vector<Box>& boxes, const Ray& ray) {
  const std::set<std::uint32_t> found = reached(bvh, ray);
  std::uint64_t lost = 0;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) lost += meets(boxes[i], ray) && !found.contains(i);
  return lost;
}

// Nodes above the deepest leaf.
int depth_of(const Bvh& bvh, std::uint32_t node = 0) {
  const raytrace::BvhNode& n = bvh.nodes[node];
  int deepest = 0;
  for (std::size_t slot = 0; slot < raytrace::BvhNode::kWidth; ++slot)
    if (n.count[slot] == 0 && n.face[0][slot] <= n.face[3][slot])
      deepest = std::max(deepest, depth_of(bvh, n.first[slot]));
  return 1 + deepest;
}

// Builds it, and shoots through all of it.
void check_depth(const std::vector<Box>& boxes) {
  const Bvh bvh = bvh_over(boxes);
  CHECK(depth_of(bvh) <= Bvh::kMaxDepth);
  CHECK(std::set(bvh.items.begin(), bvh.items.end()).size() == boxes.size());
  Random random(1);
  std::uint64_t lost = 0;
  for (int i = 0; i < 20; ++i) {
    const Box& aim = boxes[random.below(static_cast<std::uint32_t>(boxes.size()))];
    const glm::dvec3 origin = 3.0 * random.direction();
    lost += boxes_lost(bvh, boxes, make_ray(origin, 0.5 * (aim.low + aim.high) - origin));
  }
  CHECK(lost == 0);
}

Box cube_at(const glm::dvec3& center, double half_edge) { return {center - half_edge, center + half_edge}; }

}  // namespace

// BVH-1, first part: rays in the faces and along the edges of a tiling by boxes.
TEST_CASE("axis-aligned rays between the boxes of a tiling reach a box, with 0 and with -0") {
  std::uint64_t rays = 0, leaked = 0, lost = 0;
  for (const double shift : {0.0, static_cast<double>(0.1f), static_cast<double>(1000.3f)}) {
    std::vector<Box> boxes;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 4; ++k)
        boxes.push_back({glm::dvec3(i, 0, k) + shift, glm::dvec3(i + 1, 1, k + 1) + shift});
    const Bvh bvh = bvh_over(boxes);
    for (int i = 1; i < 8; ++i)
      for (int k = 1; k < 8; ++k)
        for (const double up : {-1.0, 1.0})
          for (const double x : {0.0, -0.0})
            for (const double z : {0.0, -0.0}) {
              const Ray ray{glm::dvec3(0.5 * i, 0.5 - 3 * up, 0.5 * k) + shift, {x, up, z}};
              ++rays;
              leaked += reached(bvh, ray).empty();
              lost += boxes_lost(bvh, boxes, ray);
            }
  }
  CHECK(rays == 1176);
  const HardCase tiling("BVH-1");
  tiling.none("rays in the faces of a tiling that reach no box", leaked, rays);
  tiling.none("rays in the faces of a tiling that lose a box", lost, rays);
}

// BVH-1, second part: all pairs of slabs, origins and directions on two axes, the third free.
TEST_CASE("no box is lost for any combination of slab, origin and direction") {
  constexpr std::pair<double, double> kSlabs[]{{-1, 1}, {0, 0}, {0, 1}, {-1, 0}, {0.3, 0.7}, {1e5, 1e5}};
  std::uint64_t lost = 0, met = 0;
  for (const auto& [low_x, high_x] : kSlabs)
    for (const auto& [low_y, high_y] : kSlabs) {
      const std::vector<Box> boxes{{{low_x, low_y, -1}, {high_x, high_y, 1}}};
      const Bvh bvh = bvh_over(boxes);
      for (const double o_x : {-2.0, -1.0, -0.5, 0.0, 1.0, 2.0, 0.3, 1e5})
        for (const double o_y : {-2.0, -1.0, -0.5, 0.0, 1.0, 2.0, 0.3, 1e5})
          for (const double d_x : {1.0, -1.0, 0.0, -0.0, 1.0 / 3})
            for (const double d_y : {1.0, -1.0, 0.0, -0.0, 1.0 / 3})
              for (const double d_z : {-0.0, 0.125}) {
                const Ray ray{{o_x, o_y, 0}, {d_x, d_y, d_z}};
                if (ray.direction == glm::dvec3(0)) continue;
                lost += boxes_lost(bvh, boxes, ray);
                met += meets(boxes[0], ray);
              }
    }
  HardCase("BVH-1").none("boxes lost of all slabs, origins and directions", lost, met);
}

// visibility.h may place a hit by some u of the coordinates beside its box, and its depth by 2^-18 before it.
TEST_CASE("a traversal leaves room for the rounding of a hit and of its depth") {
  const std::vector<Box> boxes(20, {{1, 1, 1}, {2, 2, 2}});  // several leaves
  const Bvh bvh = bvh_over(boxes);
  for (const double x : {1 - 0x1p-49, 1.5, 2 + 0x1p-48})  // 16 u of 1, 32 u of 2
    CHECK(reached(bvh, {{x, 1.5, 0}, {0, 0, 1}}).size() == 20);
  CHECK(reached(bvh, {{2.001, 1.5, 0}, {0, 0, 1}}).empty());
  int visits = 0;
  raytrace::traverse(bvh, {{1.5, 1.5, 0}, {0, 0, 1}}, kForever, [&](std::uint32_t, double) {
    ++visits;
    return 1 - 0x1p-18;  // a hit in the box, which begins at t = 1
  });
  CHECK(visits == 20);
}

TEST_CASE("a traversal ends where a leaf says so, and skips what lies beyond the limit") {
  std::vector<Box> boxes;
  for (int i = 1; i <= 64; ++i) boxes.push_back(cube_at({0, 0, 4.0 * i}, 1));
  const Bvh bvh = bvh_over(boxes);
  const auto visited_by = [&](double limit, double answer) {
    std::vector<std::uint32_t> items;
    raytrace::traverse(bvh, {{0, 0, 0}, {0, 0, 1}}, limit, [&](std::uint32_t item, double) {
      items.push_back(item);
      return answer;
    });
    return items;
  };
  CHECK(visited_by(kForever, kForever).size() == 64);
  CHECK(visited_by(2, 2).empty());  // the first box begins at 3
  CHECK(visited_by(kForever, -1).size() == 1);
  CHECK(visited_by(kForever, -1).front() < 8);   // nearer children first: an item of the nearest leaf
  CHECK(visited_by(kForever, 10).size() <= 16);  // and little beyond it
}

TEST_CASE("boxes of one centre, on a line, at a point or exponentially spaced stay within the stack") {
  std::vector<Box> same, line, points, nested, spaced;
  for (int i = 0; i < 5000; ++i) {
    same.push_back(cube_at({1, 1, 1}, 1 + i));
    line.push_back(cube_at({0, i * 0x1p-12, 0}, 0));
    points.push_back(cube_at({1, 2, 3}, 0));
  }
  for (int i = 0; i < 1000; ++i) {
    nested.push_back(cube_at(glm::dvec3(std::exp2(-i / 8.0)), std::exp2(-i / 8.0)));
    spaced.push_back(cube_at({std::exp2(-i), 0, 0}, 0));  // each bin but one is empty, again and again
  }
  for (const std::vector<Box>* boxes : {&same, &line, &points, &nested, &spaced}) check_depth(*boxes);
}

// Several blocks of boxes, several subtrees apart from the upper levels.
TEST_CASE(
    "bvh: the tree is the same for any number of threads, and each item is in one leaf and in its box") {
  Random random(5);
  std::vector<Box> boxes;
  for (int i = 0; i < 30'001; ++i)
    boxes.push_back(cube_at(glm::dvec3(5, 0, 0) + random.in_box(3), random.uniform(0, 0.1)));
  const Bvh one = bvh_over(boxes);
  for (const int threads : {2, 3, 8}) {
    const Bvh many = bvh_over(boxes, threads);
    CHECK(many.items == one.items);
    CHECK(many.center == one.center);
    CHECK(many.reach == one.reach);
    REQUIRE(many.nodes.size() == one.nodes.size());
    CHECK(std::memcmp(many.nodes.data(), one.nodes.data(), one.nodes.size() * sizeof(one.nodes[0])) == 0);
  }
  std::vector<int> times(boxes.size(), 0);
  std::uint64_t outside = 0;
  for (const raytrace::BvhNode& node : one.nodes)
    for (std::size_t slot = 0; slot < raytrace::BvhNode::kWidth; ++slot)
      for (std::uint32_t i = node.first[slot]; i < node.first[slot] + node.count[slot]; ++i) {
        const std::uint32_t item = one.items[i];
        ++times[item];
        for (int axis = 0; axis < 3; ++axis) {
          const auto face = static_cast<std::size_t>(axis);
          outside += static_cast<double>(node.face[face][slot]) > boxes[item].low[axis] - one.center[axis];
          outside +=
              static_cast<double>(node.face[face + 3][slot]) < boxes[item].high[axis] - one.center[axis];
        }
      }
  CHECK(times == std::vector<int>(boxes.size(), 1));
  CHECK(outside == 0);
}
