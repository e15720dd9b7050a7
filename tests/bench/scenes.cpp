// SPDX-License-Identifier: MIT
#include "tests/bench/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <sstream>

#include "common/error.h"
#include "common/scene/obj.h"
#include "tests/bench/shapes.h"
#include "tests/support/dyadic_scenes.h"

namespace sidelight::bench {
namespace {

using glm::dvec3;

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

void add_smooth(Scene& scene, PolygonMesh mesh, std::uint32_t material) {
  for (PolygonMesh::Face& face : mesh.faces) face.material = material;
  add_mesh(scene, smoothed(std::move(mesh)), {}, {});
}

Scene spheres() {
  CameraSettings camera = test::any_way();
  camera.view_height = 1.2;  // with some background too
  Scene scene = lit_scene(camera);
  for (const PolygonMesh& sphere : test::ten_spheres(33, 64)) add_smooth(scene, sphere, 0);
  add_smooth(scene, test::ground(), 1);
  return scene;
}

Scene scan(const PolygonMesh& mesh, double view_height) {
  CameraSettings camera;
  camera.eye = test::snapped(dvec3(0.6, 1.4, 7));
  camera.look_at = {0, 1, 2};
  camera.view_height = view_height;
  Scene scene = lit_scene(camera);
  add_smooth(scene, test::fitted(mesh), 0);
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
    add_smooth(scene, test::mesh_of({{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}}, {{0, 1, 2}, {0, 2, 3}}),
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
  add_smooth(scene, test::mesh_of(positions, faces), 0);
  return scene;
}

}  // namespace

Material painted(const dvec3& color) {
  Material material;
  material.ambient = 0.1 * color;
  material.diffuse = 0.5 * color;
  material.specular = dvec3(0.3);
  material.shininess = 40;
  return material;
}

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

std::vector<bool> chosen(const std::vector<std::string>& names, const std::string& text) {
  if (text.empty()) return std::vector<bool>(names.size(), true);
  std::vector<bool> wanted(names.size(), false);
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end())
      throw UsageError(fmt::format("no scene '{}'; there are {}", word, fmt::join(names, ", ")));
    wanted[static_cast<std::size_t>(found - names.begin())] = true;
  }
  return wanted;
}

}  // namespace sidelight::bench
