// SPDX-License-Identifier: MIT
#include "common/scene/shapes.h"

#include <cassert>
#include <cmath>
#include <glm/vec2.hpp>
#include <initializer_list>
#include <numbers>

namespace sidelight {
namespace {

using glm::dvec2;
using glm::dvec3;
using Corner = PolygonMesh::Corner;

// Cosine and sine of i/n of a full turn, 0 <= i < n. The circle's symmetries are exact: everything is
// mirrored from the first 45 degrees, so multiples of 90 degrees give 0 and 1, and opposite points have
// opposite bits.
dvec2 circle_point(std::int64_t i, std::int64_t n) {
  std::int64_t a = 4 * i;  // in units of a turn / 4n: a quarter turn is n
  const bool below = a > 2 * n;
  if (below) a = 4 * n - a;
  const bool left = a > n;
  if (left) a = 2 * n - a;
  const bool steep = 2 * a > n;
  if (steep) a = n - a;

  const double angle = std::numbers::pi / 2 * static_cast<double>(a) / static_cast<double>(n);
  dvec2 p = 2 * a == n ? dvec2(std::sqrt(0.5)) : dvec2(std::cos(angle), std::sin(angle));
  if (steep) p = {p.y, p.x};
  return {left ? -p.x : p.x, below ? -p.y : p.y};
}

std::vector<dvec2> circle(int segments) {
  std::vector<dvec2> points;
  for (int i = 0; i < segments; ++i) points.push_back(circle_point(i, segments));
  return points;
}

// The direction of a point of the circle around the y axis, seen from above: x to the right, z towards the
// viewer.
dvec3 around_y(const dvec2& p, double radius, double y) { return {radius * p.x, y, radius * p.y}; }

// Gives the number of what was added.
std::uint32_t append(std::vector<dvec3>& to, const dvec3& v) {
  to.push_back(v);
  return static_cast<std::uint32_t>(to.size() - 1);
}

void add_face(PolygonMesh& mesh, std::initializer_list<Corner> corners) {
  PolygonMesh::Face face;
  face.first = static_cast<std::uint32_t>(mesh.corners.size());
  face.count = static_cast<std::uint32_t>(corners.size());
  mesh.corners.insert(mesh.corners.end(), corners);
  mesh.faces.push_back(face);
}

// Positions of a horizontal ring; its i-th vertex has the number first + i.
std::uint32_t add_ring(PolygonMesh& mesh, const std::vector<dvec2>& points, double radius, double y) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const dvec2& p : points) append(mesh.positions, around_y(p, radius, y));
  return first;
}

// A flat disc of triangles around a vertex in its middle, on the ring from vertex `first` on.
void add_cap(PolygonMesh& mesh, std::uint32_t first, std::uint32_t segments, double y, bool faces_up) {
  const std::uint32_t middle = append(mesh.positions, {0, y, 0});
  for (std::uint32_t i = 0; i < segments; ++i) {
    const Corner here{first + i}, there{first + (i + 1) % segments};
    if (faces_up)
      add_face(mesh, {{middle}, there, here});
    else
      add_face(mesh, {{middle}, here, there});
  }
}

}  // namespace

PolygonMesh make_box(const dvec3& size) {
  assert(size.x > 0 && size.y > 0 && size.z > 0);
  PolygonMesh mesh;
  // Vertex number: bit 0 is the side in x, bit 1 in y, bit 2 in z.
  for (int i = 0; i < 8; ++i) {
    const dvec3 side(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    append(mesh.positions, side * size);
  }
  add_face(mesh, {{0}, {4}, {6}, {2}});  // -x
  add_face(mesh, {{1}, {3}, {7}, {5}});  // +x
  add_face(mesh, {{0}, {1}, {5}, {4}});  // -y
  add_face(mesh, {{2}, {6}, {7}, {3}});  // +y
  add_face(mesh, {{0}, {2}, {3}, {1}});  // -z
  add_face(mesh, {{4}, {5}, {7}, {6}});  // +z
  return mesh;
}

PolygonMesh make_cylinder(double radius, double height, int segments) {
  assert(radius > 0 && height > 0 && segments >= 3);
  PolygonMesh mesh;
  const std::vector<dvec2> points = circle(segments);
  const auto n = static_cast<std::uint32_t>(segments);
  const std::uint32_t bottom = add_ring(mesh, points, radius, 0);
  const std::uint32_t top = add_ring(mesh, points, radius, height);
  for (const dvec2& p : points) append(mesh.normals, around_y(p, 1, 0));  // number i at vertices i

  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    add_face(mesh, {{bottom + i, i}, {top + i, i}, {top + j, j}, {bottom + j, j}});
  }
  add_cap(mesh, bottom, n, 0, false);
  add_cap(mesh, top, n, height, true);
  return mesh;
}

PolygonMesh make_cone(double radius, double height, int segments) {
  assert(radius > 0 && height > 0 && segments >= 3);
  PolygonMesh mesh;
  const std::vector<dvec2> points = circle(segments);
  const auto n = static_cast<std::uint32_t>(segments);
  const std::uint32_t base = add_ring(mesh, points, radius, 0);
  const std::uint32_t apex = append(mesh.positions, {0, height, 0});

  // The side falls by `height` over `radius`, so its normal rises by `radius` over `height`. At the apex,
  // where all normals meet, each face takes that of its own middle.
  for (const dvec2& p : points) append(mesh.normals, around_y(p, height, radius));  // number i at vertex i
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    const std::uint32_t middle =
        append(mesh.normals, around_y(circle_point(2 * i + 1, 2 * n), height, radius));
    add_face(mesh, {{base + i, i}, {apex, middle}, {base + j, j}});
  }
  add_cap(mesh, base, n, 0, false);
  return mesh;
}

PolygonMesh make_torus(double major, double minor, int around, int tube) {
  assert(0 < minor && minor < major && around >= 3 && tube >= 3);
  PolygonMesh mesh;
  const std::vector<dvec2> section = circle(tube);
  for (const dvec2& p : circle(around))
    for (const dvec2& q : section) {
      append(mesh.positions, around_y(p, major + minor * q.x, minor * q.y));
      append(mesh.normals, around_y(p, q.x, q.y));
    }

  const auto rings = static_cast<std::uint32_t>(around), n = static_cast<std::uint32_t>(tube);
  const auto corner = [n](std::uint32_t ring, std::uint32_t k) { return Corner{ring * n + k, ring * n + k}; };
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t j = (i + 1) % rings, l = (k + 1) % n;
      add_face(mesh, {corner(i, k), corner(i, l), corner(j, l), corner(j, k)});
    }
  return mesh;
}

PolygonMesh make_sphere_mesh(int segments) {
  assert(segments >= 4 && segments % 2 == 0);
  PolygonMesh mesh;
  const auto n = static_cast<std::uint32_t>(segments), rings = n / 2 - 1;
  const std::vector<dvec2> equator = circle(segments);
  for (std::uint32_t k = 1; k <= rings; ++k) {  // from the south pole up
    const dvec2 meridian = circle_point(k, segments);
    add_ring(mesh, equator, meridian.y, -meridian.x);
  }
  const std::uint32_t south = append(mesh.positions, {0, -1, 0}), north = append(mesh.positions, {0, 1, 0});
  mesh.normals = mesh.positions;

  const auto corner = [](std::uint32_t i) { return Corner{i, i}; };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n, top = (rings - 1) * n;
    add_face(mesh, {corner(south), corner(i), corner(j)});
    for (std::uint32_t ring = 0; ring < top; ring += n)
      add_face(mesh, {corner(ring + i), corner(ring + n + i), corner(ring + n + j), corner(ring + j)});
    add_face(mesh, {corner(north), corner(top + j), corner(top + i)});
  }
  return mesh;
}

}  // namespace sidelight
