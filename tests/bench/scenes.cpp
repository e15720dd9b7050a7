// SPDX-License-Identifier: MIT
#include "tests/bench/scenes.h"

#include <glm/geometric.hpp>
#include <map>
#include <sstream>

#include "common/error.h"
#include "common/scene/obj.h"
#include "tests/support/dyadic_scenes.h"

namespace sidelight::bench {
namespace {

using glm::dvec3;

Material painted(const dvec3& color) {
  Material material;
  material.ambient = 0.1 * color;
  material.diffuse = 0.5 * color;
  material.specular = dvec3(0.3);
  material.shininess = 40;
  return material;
}

// Two lamps and two paints, number 0 and 1, seen from near the z axis.
Scene lit_scene(const CameraSettings& camera) {
  Scene scene;
  scene.background = {0.05, 0.06, 0.1};
  scene.ambient = dvec3(0.5);
  scene.lights = {test::lamp({4, 7, 9}, 0.7), test::lamp({-6, 5, 6}, 0.5)};
  scene.camera = camera;
  scene.trace.shadows = scene.trace.reflection = scene.trace.refraction = false;
  add_material(scene, painted({0.9, 0.6, 0.4}));
  add_material(scene, painted({0.5, 0.7, 0.9}));
  return scene;
}

// A normal at each position, of its number: the mean of its faces' by area.
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

void add(Scene& scene, PolygonMesh mesh, std::uint32_t material) {
  for (PolygonMesh::Face& face : mesh.faces) face.material = material;
  add_mesh(scene, smoothed(std::move(mesh)), {}, {});
}

// ---- The scenes of the z-buffer

Scene spheres() {
  CameraSettings camera = test::any_way();
  camera.view_height = 1.2;  // with some background too
  Scene scene = lit_scene(camera);
  for (const PolygonMesh& sphere : test::ten_spheres(33, 64)) add(scene, sphere, 0);
  add(scene, test::ground(), 1);
  return scene;
}

// The octahedron |x| + |y| + |z| = n on its integer points, 8 n^2 triangles wound outward.
PolygonMesh split_octahedron(int n) {
  std::vector<dvec3> positions;
  std::vector<test::Face> faces;
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
      faces.push_back(sx * sy * sz > 0 ? test::Face{a, b, c} : test::Face{a, c, b});
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

// What a scanner makes of a figure: closed, with limbs and hollows, of even small triangles, a little noisy.
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

Scene scan(const PolygonMesh& mesh, double view_height) {
  CameraSettings camera;
  camera.eye = test::snapped(dvec3(0.6, 1.4, 7));
  camera.look_at = {0, 1, 2};
  camera.view_height = view_height;
  Scene scene = lit_scene(camera);
  add(scene, test::fitted(mesh), 0);
  return scene;
}

CameraSettings straight_ahead(double look_at_z) {
  CameraSettings camera;
  camera.eye = {0, 0, 5};
  camera.look_at = {0, 0, look_at_z};
  camera.view_height = 0.5;
  return camera;
}

// Layers of two triangles, a quarter larger than the picture (of 16:9) wherever the eye moves.
Scene full_screen_layers(bool front_to_back) {
  constexpr int kLayers = 8;
  Scene scene = lit_scene(straight_ahead(-3.5));
  for (int i = 0; i < kLayers; ++i) {
    const int layer = front_to_back ? i : kLayers - 1 - i;
    const double y = test::snapped(1.25 * 0.25 * (5 + layer)), x = 2 * y;
    const double z = -layer;
    add(scene, test::mesh_of({{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}}, {{0, 1, 2}, {0, 2, 3}}),
        static_cast<std::uint32_t>(layer % 2));
  }
  return scene;
}

// A wavy sheet before the eye that fills two thirds of the picture.
Scene sub_pixel() {
  constexpr std::uint32_t kColumns = 1155, kRows = 650;
  std::vector<dvec3> positions;
  std::vector<test::Face> faces;
  for (std::uint32_t j = 0; j <= kRows; ++j)
    for (std::uint32_t i = 0; i <= kColumns; ++i) {
      const double x = 3.6 * (double(i) / kColumns - 0.5), y = 2.0 * (double(j) / kRows - 0.5);
      positions.push_back(test::snapped(dvec3(x, y, 0.05 * std::sin(9 * x) * std::cos(7 * y))));
    }
  for (std::uint32_t j = 0; j < kRows; ++j)
    for (std::uint32_t i = 0; i < kColumns; ++i) {
      const std::uint32_t a = j * (kColumns + 1) + i, b = a + kColumns + 1;
      faces.push_back({a, a + 1, b + 1});
      faces.push_back({a, b + 1, b});
    }
  Scene scene = lit_scene(straight_ahead(0));
  add(scene, test::mesh_of(positions, faces), 0);
  return scene;
}

}  // namespace

std::vector<Entry> raster_entries(const std::optional<std::string>& mesh) {
  std::vector<Entry> entries{{"spheres", 5, 7, spheres}};
  if (mesh) {
    entries.push_back({"mesh", 0, 0, [=] { return scan(read_obj(*mesh, false).mesh, 0.5); }});
  } else {
    entries.push_back({"mesh-69k", 7, 10, [] { return scan(made_scan(93), 0.5); }});
    entries.push_back({"mesh-870k", 12, 18, [] { return scan(made_scan(330), 0.67); }});
  }
  entries.push_back({"fill-front", 4, 5, [] { return full_screen_layers(true); }});
  entries.push_back({"fill-back", 15, 25, [] { return full_screen_layers(false); }});
  entries.push_back({"sub-pixel", 9, 14, sub_pixel});
  return entries;
}

CameraSettings moved_eye(const Scene& scene, int frame) {
  CameraSettings camera = scene.camera;
  const double way = 0.03 * length(camera.look_at - camera.eye);
  camera.eye += test::snapped(way * dvec3(std::sin(0.37 * frame), 0.5 * std::sin(0.23 * frame), 0));
  return camera;
}

std::vector<Entry> chosen(const std::vector<Entry>& entries, const std::string& text) {
  if (text.empty()) return entries;
  std::vector<Entry> out;
  std::string known;
  for (const Entry& entry : entries) {
    known += (known.empty() ? "" : ",") + entry.name;
    if ((',' + text + ',').find(',' + entry.name + ',') != std::string::npos) out.push_back(entry);
  }
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');)
    if ((',' + known + ',').find(',' + name + ',') == std::string::npos)
      throw UsageError("no scene '" + name + "'; there are " + known);
  return out;
}

}  // namespace sidelight::bench
