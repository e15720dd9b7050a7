// SPDX-License-Identifier: MIT
// Rays with a common origin whose directions are affine in two parameters, d = W + u U + v V, are a two-dimensional
// problem: relative to their origin a triangle is three affine edge functions of (u, v), and 1/t is a fourth. Here they
// are, in double, each with a bound on its distance from what visibility.h decides exactly for the rounded rays. Eye
// rays are such a sheet (the lattice of samples); so are rays from one light, and rays mirrored by one plane.
//
// After M. Olano and T. Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997, section 3: no clipping,
// whatever lies around or behind the origin.
#pragma once

#include <array>

#include "common/model/visibility.h"
#include "common/scene/camera.h"

namespace sidelight {

struct RaySheet {
  glm::dvec3 origin{0}, W{0}, U{0}, V{0};
  // Per component, at least |d| and every partial sum on the way to it, for all (u, v) that are asked for; the rays that
  // are really shot may be off W + u U + v V by 8 units in the last place of it.
  glm::dvec3 size{0};
};

// The rays of a picture's samples: u = X and v = Y of the lattice.
RaySheet lattice_sheet(const Camera& camera);

// c + u x + v y.
struct Affine {
  double x = 0, y = 0, c = 0;
  double at(double u, double v) const { return (x * u + y * v) + c; }
};

// E_k up to a positive factor, turned so that a ray meets the triangle iff all are >= 0 and not all 0.
struct EdgeSheet {
  Affine value;      // |x| + |y| = 1, so that it counts in steps of u and v, unless the edge is seen end-on
  double error = 0;  // where |value| is above it, its sign is the exact one
};

// 1/t where the ray hits.
struct DepthSheet {
  Affine w;
  double error = 0;   // absolute; beside it a relative one of 2^-20
  bool sure = false;  // whether these bounds hold; if not, w is anything
};

// Whoever keeps 1/t in float knows the order of two depths of visibility.h where their w differ by more than the factor
// kSurely. For each is within kDepthError of its 1/t: kFloatDepthError for the float's own rounding, which its keeper must
// see to, 2^-18 for triangle_depth() (its contract), and 2^-19 for all else. kSurely is more than
// ((1 + kDepthError) / (1 - kDepthError))² = 1 + 2^-14.2, with room for the rounding of the comparison.
inline constexpr float kFloatDepthError = 0x1p-17f;
inline constexpr double kDepthError = double{kFloatDepthError} + 0x1p-18 + 0x1p-19;
inline constexpr float kSurely = 1 + 0x1p-14f;

// `side` is view_side(), not 0: the rays' origin does not lie in the triangle's plane.
std::array<EdgeSheet, 3> edge_sheets(const RaySheet& sheet, const TriangleView& view, int side);
DepthSheet depth_sheet(const RaySheet& sheet, const TriangleView& view, const DepthPlane& plane);
// Of a plane; where w is surely positive it is met, where surely negative it is not.
DepthSheet depth_sheet(const RaySheet& sheet, const Plane& plane);

}  // namespace sidelight
