// SPDX-License-Identifier: MIT
// Does a mesh have an inside, and which side of its faces is it on? Asked once a mesh, at load, by add_mesh.
//
// Closed means: each directed edge exactly once, with its reverse, where vertices in one place are one
// vertex. Degenerate triangles take part by their edges: one on three points of a line fills a T-junction and
// counts like any face; one with two vertices in one place has its edges there and back, which cancel, so it
// is left out. Either way a mesh that closes with such triangles is closed.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "common/scene/scene.h"

namespace sidelight {

// Triangle::vertex counts from `first_position`, the number of positions[0]; positions are finite, -0 is 0.
// Sorts: O(n log n), 24 bytes a triangle and 8 a position. Without any triangle of three distinct vertices:
// false.
bool is_closed(std::span<const Triangle> triangles, std::span<const glm::dvec3> positions,
               std::uint32_t first_position);

// Whether a closed mesh is wound with its inside out: its signed volume is negative, by more than rounding
// can do. Triangle::vertex and `first_position` as above.
bool is_inside_out(std::span<const Triangle> triangles, std::span<const glm::dvec3> positions,
                   std::uint32_t first_position);

}  // namespace sidelight
