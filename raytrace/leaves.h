// SPDX-License-Identifier: MIT
// A hierarchy over primitives of one kind, with what its leaves' lanes ask about: the numbers that define each
// primitive, row by row within a leaf (v0.x of all of its triangles, then v0.y of all, ...). So a leaf is read from one
// place, in whole vectors, and takes no more room than its primitives do.
#pragma once

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

// Of the triangles (not the degenerate ones) and of the spheres of a scene.
TriangleLeaves triangle_leaves(const Scene& scene, int threads);
SphereLeaves sphere_leaves(const Scene& scene, int threads);

}  // namespace sidelight::raytrace
