// SPDX-License-Identifier: MIT
// The meshes of the benchmarks' scenes, around the origin, wound outward where they are closed. Equal arguments give
// equal meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "common/scene/build.h"

namespace sidelight::bench {

// What a scanner makes of a figure: closed, with limbs and hollows, of 8 n^2 triangles of even size, a little noisy.
// Star-shaped around the origin.
PolygonMesh made_scan(int n);

// The mesh with a normal at each position, of its number: the mean of its faces' by area.
PolygonMesh smoothed(PolygonMesh mesh);

// A toothed wheel of radius 1 that turns around the z axis: 16 triangles a tooth, turned by `turn` of a tooth.
PolygonMesh gear(std::uint32_t teeth, double thickness, double turn);

// Heights over the square of side 2 in y = 0, of 2 * 4^levels triangles, not closed. After A. Fournier, D. Fussell,
// L. Carpenter, "Computer Rendering of Stochastic Models", CACM 25(6), 1982, by the displacement of midpoints.
PolygonMesh fractal_mountain(int levels);

// The tetrahedron of Sierpinski inside the cube of side 2: 4^(levels + 1) triangles; its parts touch at corners.
PolygonMesh tetrahedral_pyramid(int levels);

// A sphere of radius 1 with nine of a third of its size on it, and so on: (9^(levels + 1) - 1) / 8 of them. After E.
// Haines, "A Proposal for Standard Graphics Environments", IEEE Computer Graphics and Applications 7(11), 1987.
std::vector<Sphere> sphere_flake(int levels);

}  // namespace sidelight::bench
