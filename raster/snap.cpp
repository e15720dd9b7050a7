// SPDX-License-Identifier: MIT
#include "raster/snap.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/exact.h"

namespace sidelight::raster {
namespace {

// A vertex a relative to the eye is seen at x = W/2 + H (a.r / h²)/(a.f), y = H/2 - H (a.u / h²)/(a.f) pixels from the
// upper left corner, h² = r.r = u.u (camera.h).
glm::dvec3 snapped_vertex(const Camera& camera, const glm::dvec3& v, double steps) {
  const glm::dvec3 a = v - camera.eye;
  const double depth = glm::dot(a, camera.forward);
  if (!(depth > 0)) return v;
  const double pixels = camera.height / (depth * glm::dot(camera.up, camera.up));  // per length along r or u
  const double x = 0.5 * camera.width + pixels * glm::dot(a, camera.right);
  const double y = 0.5 * camera.height - pixels * glm::dot(a, camera.up);
  const double dx = std::round(x * steps) / steps - x, dy = std::round(y * steps) / steps - y;
  // Beyond, doubles near x have no room for fractions of a step; nearer than 2^-24 of a step is on the grid.
  if (!(std::abs(x) + std::abs(y) < 0x1p20)) return v;
  if (std::abs(dx) + std::abs(dy) < 0x1p-24 / steps) return v;
  return v + (depth / camera.height) * (dx * camera.right - dy * camera.up);
}

}  // namespace

Scene snapped(const Scene& scene, const Camera& camera, int bits) {
  Scene out = scene;
  for (glm::dvec3& v : out.positions) v = snapped_vertex(camera, v, std::ldexp(1.0, bits));
  for (Triangle& triangle : out.triangles) {
    const auto corner = [&](std::size_t k) { return out.positions[triangle.vertex[k]]; };
    triangle.degenerate = exact::collinear(corner(0), corner(1), corner(2));
  }
  return out;
}

}  // namespace sidelight::raster
