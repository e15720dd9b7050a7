// SPDX-License-Identifier: MIT
#include "tests/bench/shapes.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace sidelight::bench {
namespace {

using glm::dvec3;
using test::Face;

// The octahedron |x| + |y| + |z| = n on its integer points, 8 n^2 triangles wound outward.
PolygonMesh split_octahedron(int n) {
  std::vector<dvec3> positions;
  std::vector<Face> faces;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto vertex = [&](int sx, int sy, int sz, int i, int j) {
    const std::array<int, 3> at{sx * i, sy * j, sz * (n - i - j)};
    const auto [place, is_new] = numbers.try_emplace(at, static_cast<std::uint32_t>(positions.size()));
    if (is_new) positions.emplace_back(at[0], at[1], at[2]);
    return place->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, sz = octant & 4 ? -1 : 1;
    const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      faces.push_back(sx * sy * sz > 0 ? Face{a, b, c} : Face{a, c, b});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        const auto at = [&](int di, int dj) { return vertex(sx, sy, sz, i + di, j + dj); };
        face(at(0, 0), at(1, 0), at(0, 1));
        if (i + j + 2 <= n) face(at(1, 0), at(1, 1), at(0, 1));
      }
  }
  return test::mesh_of(positions, faces);
}

// A tooth is two steps low and two steps high: the four corners of its outline, seen from +z.
std::vector<dvec3> gear_outline(std::uint32_t teeth, double turn) {
  std::vector<dvec3> outline;
  for (std::uint32_t i = 0; i < 4 * teeth; ++i) {
    const double angle = 2 * std::numbers::pi * ((i % 4 + 0.3 * (i % 2)) / 4 + i / 4 + turn) / teeth;
    outline.push_back((i % 4 < 2 ? 0.82 : 1.0) * dvec3(std::cos(angle), std::sin(angle), 0));
  }
  return outline;
}

void add_tetrahedra(const std::array<dvec3, 4>& corners, int levels, std::vector<dvec3>& positions,
                    std::vector<Face>& faces) {
  if (levels > 0) {
    for (const dvec3& kept : corners) {
      std::array<dvec3, 4> part = corners;
      for (dvec3& corner : part) corner = (corner + kept) / 2.0;
      add_tetrahedra(part, levels - 1, positions, faces);
    }
    return;
  }
  const auto first = static_cast<std::uint32_t>(positions.size());
  positions.insert(positions.end(), corners.begin(), corners.end());
  for (const Face& face : {Face{0, 1, 2}, Face{0, 3, 1}, Face{0, 2, 3}, Face{1, 3, 2}})
    faces.push_back({first + face[0], first + face[1], first + face[2]});
}

// The sphere and its nine children: six around its waist, three nearer to the end of its axis.
void add_spheres(const Sphere& sphere, const dvec3& axis, int levels, std::vector<Sphere>& out) {
  out.push_back(sphere);
  if (levels == 0) return;
  const dvec3 side = normalize(cross(axis, std::abs(axis.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  const dvec3 other = cross(axis, side);
  for (int i = 0; i < 9; ++i) {
    const double around = std::numbers::pi / 3 * (i < 6 ? i : 2 * i + 0.5);
    const double up = i < 6 ? 0 : 0.95;
    const dvec3 outward =
        std::cos(up) * (std::cos(around) * side + std::sin(around) * other) + std::sin(up) * axis;
    Sphere child = sphere;
    child.radius = sphere.radius / 3;
    child.center = sphere.center + (sphere.radius + child.radius) * outward;
    add_spheres(child, outward, levels - 1, out);
  }
}

}  // namespace

PolygonMesh made_scan(int n) {
  PolygonMesh mesh = split_octahedron(n);
  test::Random random(7);
  for (dvec3& p : mesh.positions) {
    const dvec3 d = normalize(p);
    const double bumps = std::sin(4 * d.x + 1) * std::sin(5 * d.y) + 0.5 * std::sin(9 * d.z + 3 * d.x) +
                         0.1 * std::sin(23 * d.y) * std::sin(19 * d.x);
    p = (1 + 0.25 * bumps + 0.1 / n * random.uniform()) * d;
  }
  return mesh;
}

PolygonMesh smoothed(PolygonMesh mesh) {
  mesh.normals.assign(mesh.positions.size(), dvec3(0));
  for (const PolygonMesh::Face& face : mesh.faces) {
    const auto corner = [&](std::uint32_t k) {
      return mesh.positions[mesh.corners[face.first + k].position];
    };
    dvec3 area(0);
    for (std::uint32_t k = 2; k < face.count; ++k)
      area += cross(corner(k - 1) - corner(0), corner(k) - corner(0));
    for (std::uint32_t k = 0; k < face.count; ++k)
      mesh.normals[mesh.corners[face.first + k].position] += area;
  }
  // Faces may cancel out, and a position may have none: any unit vector will do.
  for (dvec3& n : mesh.normals)
    if (n == dvec3(0)) n = {0, 0, 1};
  for (PolygonMesh::Corner& corner : mesh.corners) corner.normal = corner.position;
  return mesh;
}

PolygonMesh gear(std::uint32_t teeth, double thickness, double turn) {
  const std::vector<dvec3> outline = gear_outline(teeth, turn);
  const auto n = static_cast<std::uint32_t>(outline.size());
  std::vector<dvec3> positions;
  for (const double z : {thickness / 2, -thickness / 2}) {
    for (const dvec3& p : outline) positions.push_back(p + dvec3(0, 0, z));
    positions.push_back({0, 0, z});
  }
  std::vector<Face> faces;
  const std::uint32_t front_hub = n, back = n + 1, back_hub = 2 * n + 1;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    faces.push_back({front_hub, i, next});
    faces.push_back({back_hub, back + next, back + i});
    faces.push_back({i, back + i, back + next});
    faces.push_back({i, back + next, next});
  }
  return test::mesh_of(positions, faces);
}

PolygonMesh fractal_mountain(int levels) {
  const std::uint32_t n = 1u << levels;
  test::Random random(3);
  std::vector<double> height((n + 1) * (n + 1), 0);
  const auto at = [&](std::uint32_t i, std::uint32_t j) -> double& { return height[j * (n + 1) + i]; };
  // Midpoints of edges from their ends, middles of squares from their diagonal, each displaced by its size.
  for (std::uint32_t step = n; step > 1; step /= 2) {
    const std::uint32_t half = step / 2;
    for (std::uint32_t j = 0; j <= n; j += half)
      for (std::uint32_t i = 0; i <= n; i += half) {
        const std::uint32_t di = i % step, dj = j % step;
        if (di == 0 && dj == 0) continue;
        const double mean = (at(i - di, j - dj) + at(i + di, j + dj)) / 2;
        at(i, j) = mean + 0.45 * step / n * random.uniform(-1, 1);
      }
  }
  std::vector<dvec3> positions;
  std::vector<Face> faces;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) positions.push_back({2.0 * i / n - 1, at(i, j), 2.0 * j / n - 1});
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + n + 1;
      faces.push_back({a, b + 1, a + 1});
      faces.push_back({a, b, b + 1});
    }
  return test::mesh_of(positions, faces);
}

PolygonMesh tetrahedral_pyramid(int levels) {
  std::vector<dvec3> positions;
  std::vector<Face> faces;
  add_tetrahedra({{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}}, levels, positions, faces);
  return test::mesh_of(positions, faces);
}

std::vector<Sphere> sphere_flake(int levels) {
  std::vector<Sphere> spheres;
  add_spheres(Sphere{}, {0, 1, 0}, levels, spheres);
  return spheres;
}

}  // namespace sidelight::bench
