// SPDX-License-Identifier: MIT
// The pinhole camera: the only definition of a sample's ray. With n x n samples a pixel, samples lie on the lattice
// X = n x + i, Y = n y + j (y down), and the ray through (X, Y) has the direction
//   d = (2X + 1 - nW) r + (nH - 1 - 2Y) u + 2nH f,     r = h right, u = h up, f = forward,
// h the view height at distance 1, computed in double, in this order, without fused operations. These three doubles
// are the ray: for the z-buffer, the tracer and the exact routine alike. Its length is not 1; a depth t along it is
// t * 2nH in scene units along the viewing direction.
#pragma once

#include <glm/vec3.hpp>

#include "common/scene/scene.h"

namespace sidelight {

struct Camera {
  glm::dvec3 eye{0};
  glm::dvec3 right{0}, up{0}, forward{0};   // r, u and f above: right and up carry the view height
  int width = 0, height = 0;                // W, H in pixels
  int n = 1;                                // samples per pixel edge

  int columns() const { return n * width; }   // of the lattice
  int rows() const { return n * height; }
  double depth_scale() const { return 2.0 * rows(); }

  // The factors of r and u in a direction.
  double column_factor(int X) const { return static_cast<double>(2 * X + 1 - columns()); }
  double row_factor(int Y) const { return static_cast<double>(rows() - 1 - 2 * Y); }
  // The summands of a direction, so that a loop over a row may keep them.
  glm::dvec3 column_part(int X) const { return column_factor(X) * right; }
  glm::dvec3 row_part(int Y) const { return row_factor(Y) * up; }
  glm::dvec3 axis_part() const { return depth_scale() * forward; }

  glm::dvec3 direction(int X, int Y) const { return (column_part(X) + row_part(Y)) + axis_part(); }
};

// forward points from eye to look_at. Where up is parallel to it (or zero), the coordinate axis least aligned with
// forward, the later one on a tie, serves as up instead. width, height >= 1, n >= 1; eye != look_at.
Camera make_camera(const CameraSettings& settings, int width, int height, int n);

// n for a number of samples per pixel, which must be a square: 1, 4, 9, ...; 0 if it is not one.
int samples_per_edge(int spp);

}  // namespace sidelight
