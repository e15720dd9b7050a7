// SPDX-License-Identifier: MIT
#include "common/model/ray_sheet.h"

#include <algorithm>
#include <cmath>

#include "common/math/norms.h"

namespace sidelight {
namespace {

// d . n over the sheet. Bound, relative to S = sum size_i m_i with m_i >= |n_i|: the rays' own rounding 8u, the dot
// products W.n, U.n and V.n 3u each, the affine sum 5u, all of them on terms that S bounds: below 32u = 2^-48. An n that
// is itself off by 4u m_i adds 4u.
constexpr double kSheetError = 0x1p-47;

Affine along(const RaySheet& sheet, const glm::dvec3& n) {
  return {glm::dot(sheet.U, n), glm::dot(sheet.V, n), glm::dot(sheet.W, n)};
}

Affine scaled(const Affine& a, double factor) { return {a.x * factor, a.y * factor, a.c * factor}; }

}  // namespace

// The camera's d is (cX r + cY u) + c f, cX = 2X + 1 - nW and so on: rounded, 3u off; W, U and V below as much.
RaySheet lattice_sheet(const Camera& camera) {
  RaySheet sheet;
  sheet.origin = camera.eye;
  sheet.U = 2.0 * camera.right;
  sheet.V = -2.0 * camera.up;
  sheet.W = camera.direction(0, 0);
  sheet.size = (3.0 * camera.columns()) * absolute(camera.right) +
               (3.0 * camera.rows()) * absolute(camera.up) + camera.depth_scale() * absolute(camera.forward);
  return sheet;
}

std::array<EdgeSheet, 3> edge_sheets(const RaySheet& sheet, const TriangleView& view, int side) {
  std::array<EdgeSheet, 3> edges;
  for (std::size_t k = 0; k < 3; ++k) {
    const Affine value = along(sheet, view.edge[k]);
    const double permanent = glm::dot(sheet.size, view.weight[k]);
    // In steps of u and v, but for an edge so nearly end-on that this would say nothing.
    double unit = std::max(std::abs(value.x) + std::abs(value.y), 0x1p-40 * permanent);
    if (!(unit > 0)) unit = 1;
    edges[k].value = scaled(value, side / unit);
    edges[k].error = 2 * kSheetError * (permanent / unit);  // twice: also the scaling's own rounding
  }
  return edges;
}

DepthSheet depth_sheet(const RaySheet& sheet, const TriangleView& view, const DepthPlane& plane) {
  DepthSheet depth;
  depth.sure = plane.sure && std::abs(glm::dot(view.a[0], plane.n)) > 0;
  if (!depth.sure) return depth;
  depth.w = scaled(along(sheet, plane.n), 1 / plane.a0_n);
  depth.error =
      2 * kSheetError * (glm::dot(sheet.size, plane.weight + absolute(plane.n)) / std::abs(plane.a0_n));
  return depth;
}

// t = n . (p - o) / n . d as intersect() has it: the numerator is the double it divides by.
DepthSheet depth_sheet(const RaySheet& sheet, const Plane& plane) {
  DepthSheet depth;
  const double height = glm::dot(plane.normal, plane.point - sheet.origin);
  depth.sure = height != 0;
  if (!depth.sure) return depth;
  depth.w = scaled(along(sheet, plane.normal), 1 / height);
  depth.error = 2 * kSheetError * (glm::dot(sheet.size, absolute(plane.normal)) / std::abs(height));
  return depth;
}

}  // namespace sidelight
