// SPDX-License-Identifier: MIT
// A hierarchy over primitives of one kind, with what its leaves' lanes ask about: the numbers that define each
// primitive, row by row within a leaf (v0.x of all of its triangles, then v0.y of all, ...). So a leaf is read from one
// place, in whole vectors, and takes no more room than its primitives do.
#pragma once

#include "common/math/vec.h"
#include "common/model/visibility.h"
#include "raytrace/bvh.h"

namespace sidelight::raytrace {

// kRows doubles define a primitive.
template <int kRows>
struct Leaves {
  static constexpr int kRowCount = kRows;
  static constexpr std::uint32_t kPadding = 16;  // doubles behind the last leaf: vectors may be read past it
  Bvh bvh;                                       // its items are numbers of primitives
  KeptArray<double> rows;

  // Row r of the leaf [first, first + count) begins at + r * count.
  const double* leaf(std::uint32_t first) const { return rows.data() + std::size_t{kRows} * first; }
};
using TriangleLeaves = Leaves<9>;  // v0, v1, v2
using SphereLeaves = Leaves<4>;    // center, radius

// In lanes D of doubles, from the rows of a leaf of `count` primitives, `from` being where the first lane's begin: corner k of
// triangles, and the center of spheres as their corner 0.
template <class D>
[[gnu::always_inline]] inline Vec3<D> load_corner(const double* from, std::uint32_t count,
                                                  std::uint32_t k = 0) {
  const double* row = from + 3 * k * count;
  return {load<D>(row), load<D>(row + count), load<D>(row + 2 * count)};
}

// Of the triangles (not the degenerate ones) and of the spheres of a scene.
TriangleLeaves triangle_leaves(const Scene& scene, int threads);
SphereLeaves sphere_leaves(const Scene& scene, int threads);

}  // namespace sidelight::raytrace
