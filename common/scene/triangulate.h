// SPDX-License-Identifier: MIT
// Polygons into triangles, by exact signs: the same polygon gives the same triangles on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sidelight {

// The triangles of one polygon, as corner numbers into `polygon` (3 or more corners, wound either way): a fan from
// corner 0 where the polygon is convex, else ear clipping (Meisters 1975), always of the ear that the shortest cut takes off
// (the first in corner order of equals): compact triangles are hit for less than slivers.
// The polygon is judged in the coordinate plane in which its (Newell) normal is greatest. Always returns
// polygon.size() - 2 triangles, wound as the polygon; where no ear exists (self-intersecting or degenerate input)
// the remaining corners are fanned. O(n²) at worst, so callers bound n.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec3> polygon);

}  // namespace sidelight
