// SPDX-License-Identifier: MIT
#include "raster/setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/visibility.h"

namespace sidelight::raster {
namespace {

SampleBox whole(const Camera& camera) { return {0, 0, camera.columns(), camera.rows()}; }

// floor(x) as an int within [low, high]
int clamped(double x, int low, int high) {
  return static_cast<int>(std::clamp(std::floor(x), static_cast<double>(low), static_cast<double>(high)));
}

SampleBox box_of_sphere(const Camera& camera, const Sphere& sphere) {
  const glm::dvec3 center = sphere.center - camera.eye;
  // Rounding moves a computed silhouette by a few ulp of the distance (visibility.cpp, sphere_roots).
  const double radius = sphere.radius * (1 + 0x1p-40) + 0x1p-40 * glm::length(center);
  std::array<glm::dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = center + radius * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  return box_of_points(camera, corners);
}

// As set_up_chunk() (setup_kernel.h) finds it for many.
SampleBox box_of_triangle(const Scene& scene, const Camera& camera, const Triangle& triangle) {
  if (triangle.degenerate) return {};
  const auto [v0, v1, v2] = corners(scene, triangle);
  const ScreenSpace space(camera);
  const ScreenVertex a = project(space, v0), b = project(space, v1), c = project(space, v2);
  if ((a.state & b.state & c.state & ~ScreenSpace::kUnplaced) != 0) return {};
  if (((a.state | b.state | c.state) & ScreenSpace::kUnplaced) != 0)
    return box_of_points(camera, std::array{v0 - camera.eye, v1 - camera.eye, v2 - camera.eye});
  const Box<std::int32_t> box = box_of_places(space, std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
                                              std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}));
  return {box.x0, box.y0, box.x1, box.y1};
}

}  // namespace

SampleBox intersection(const SampleBox& a, const SampleBox& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

// A point a is seen along d = a up to a factor; with d of camera.h, in front of the eye,
//   2X + 1 - nW = 2nH (a.r / h²) / (a.f),   nH - 1 - 2Y = 2nH (a.u / h²) / (a.f),    h² = r.r = u.u.
// Rounding: the dot products are off by at most 4u|a||r| and 4u|a|, so the right side by about
// 8u (|a| / a.f) 2nH / h; kept below a quarter of a sample by the margin added here, and bounded since points with
// a.f < 2^-10 |a| are not projected at all.
SampleBox box_of_points(const Camera& camera, std::span<const glm::dvec3> points) {
  const double scale = camera.depth_scale() / glm::dot(camera.up, camera.up);
  double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
  std::size_t behind = 0, projected = 0;
  for (const glm::dvec3& a : points) {
    const double size = glm::length(a);
    const double depth = glm::dot(a, camera.forward);
    if (depth < -0x1p-40 * size)
      ++behind;  // surely: the hull's part in front of the eye needs a point in front
    if (!(depth >= 0x1p-10 * size) || size == 0) continue;
    ++projected;
    const double margin = 1 + 0x1p-48 * (size / depth) * scale * glm::length(camera.up);
    const double x = 0.5 * (scale * glm::dot(a, camera.right) / depth + camera.columns() - 1);
    const double y = 0.5 * (camera.rows() - 1 - scale * glm::dot(a, camera.up) / depth);
    left = std::min(left, x - margin);
    right = std::max(right, x + margin);
    top = std::min(top, y - margin);
    bottom = std::max(bottom, y + margin);
  }
  if (behind == points.size()) return {};
  if (projected < points.size()) return whole(camera);
  return {clamped(left, 0, camera.columns()), clamped(top, 0, camera.rows()),
          clamped(right, -1, camera.columns() - 1) + 1, clamped(bottom, -1, camera.rows() - 1) + 1};
}

SampleBox box_of_primitive(const Scene& scene, const Camera& camera, std::uint32_t primitive) {
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  if (ref.kind == ObjectKind::sphere) return box_of_sphere(camera, scene.spheres[ref.index]);
  if (ref.kind == ObjectKind::plane) return whole(camera);
  return box_of_triangle(scene, camera, scene.triangles[ref.index]);
}

}  // namespace sidelight::raster
