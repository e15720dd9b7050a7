// SPDX-License-Identifier: MIT
#include "tests/bench/trace_scenes.h"

#include <glm/geometric.hpp>

#include "common/scene/obj.h"
#include "tests/bench/shapes.h"
#include "tests/support/dyadic_scenes.h"

namespace sidelight::bench {
namespace {

using glm::dmat3;
using glm::dvec3;

Scene scene_with(const std::vector<dvec3>& lamps, const dvec3& eye, const dvec3& look_at,
                 double view_height) {
  Scene scene;
  scene.background = {0.1, 0.15, 0.25};
  scene.ambient = dvec3(0.5);
  for (const dvec3& lamp : lamps)
    scene.lights.push_back(test::lamp(lamp, 1.2 / static_cast<double>(lamps.size())));
  scene.camera.eye = eye;
  scene.camera.look_at = look_at;
  scene.camera.view_height = view_height;
  scene.trace.depth = 5;
  return scene;
}

std::uint32_t add_paint(Scene& scene, const dvec3& color, double mirror) {
  Material paint = painted(color);
  paint.reflect = dvec3(mirror);
  return add_material(scene, paint);
}

std::uint32_t add_glass(Scene& scene) {
  Material glass = painted(dvec3(0.1));
  glass.reflect = dvec3(0.1);
  glass.refract = dvec3(0.85);
  glass.ior = 1.5;
  return add_material(scene, glass);
}

void add(Scene& scene, PolygonMesh mesh, std::uint32_t material, const Transform& transform = {}) {
  for (PolygonMesh::Face& face : mesh.faces) face.material = material;
  add_mesh(scene, mesh, transform, {});
}

void add_ball(Scene& scene, const dvec3& center, double radius, std::uint32_t material) {
  add_sphere(scene, {center, radius, material}, {});
}

// As the scan stands on the ground (dyadic_scenes.h: fitted).
Scene scan_on_floor(const PolygonMesh& mesh) {
  Scene scene = scene_with({{4, 7, 9}, {-6, 5, 6}}, {0.6, 2.2, 7}, {0, 0.8, 2}, 0.55);
  const std::uint32_t mirror = add_paint(scene, {0.9, 0.6, 0.4}, 0.3);
  add(scene, smoothed(test::fitted(mesh)), mirror);
  add(scene, test::ground(), add_paint(scene, {0.5, 0.7, 0.9}, 0));
  return scene;
}

Scene flake() {
  Scene scene = scene_with({{4, 7, 6}, {-5, 6, 4}, {1, 8, -5}}, {2.6, 2.2, 4.4}, {0, 0.1, 0}, 0.72);
  const std::uint32_t mirror = add_paint(scene, {0.7, 0.6, 0.4}, 0.4);
  for (const Sphere& sphere : sphere_flake(4)) add_ball(scene, sphere.center, sphere.radius, mirror);
  add(scene, test::ground(), add_paint(scene, {0.8, 0.7, 0.6}, 0), {dmat3(1), {0, -1.6, 0}});
  return scene;
}

Scene gears() {
  Scene scene =
      scene_with({{5, 6, 9}, {-6, 5, 8}, {0, 9, 4}, {7, 2, 6}, {-3, 3, 10}}, {3.2, 3, 8.5}, {0, 0, -1}, 0.75);
  const std::uint32_t glass = add_glass(scene), mirror = add_paint(scene, {0.5, 0.45, 0.3}, 0.6);
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const dvec3 center(2.05 * (i - 1.5), 2.05 * (j - 1.5), -0.8 * k);
        add(scene, gear(24, 0.4, 0.17 * (i + 2 * j + 3 * k)), (i + j + k) % 2 == 0 ? glass : mirror,
            {dmat3(1), center});
      }
  add(scene, test::ground(), add_paint(scene, {0.8, 0.7, 0.6}, 0), {dmat3(1), {0, -4.5, 0}});
  return scene;
}

Scene mountain() {
  Scene scene = scene_with({{5, 9, 4}}, {0, 1.9, 4.2}, {0, 0.15, 0}, 0.6);
  const std::uint32_t glass = add_glass(scene);
  add(scene, fractal_mountain(6), add_paint(scene, {0.6, 0.55, 0.4}, 0), {2.0 * dmat3(1), {0, -0.4, 0}});
  add_ball(scene, {-1, 0.85, 0.6}, 0.45, glass);
  add_ball(scene, {1.05, 0.9, 0.5}, 0.45, glass);
  add_ball(scene, {0, 0.75, 1.5}, 0.4, glass);
  add_ball(scene, {0.1, 1.35, -0.7}, 0.5, glass);
  return scene;
}

Scene pyramid() {
  Scene scene = scene_with({{4, 7, 6}}, {1.7, 2.1, 4.6}, {0, 0, 0}, 0.85);
  add(scene, tetrahedral_pyramid(5), add_paint(scene, {0.8, 0.7, 0.3}, 0));
  return scene;
}

std::vector<TraceEntry> mesh_entries(const std::optional<std::string>& file) {
  if (file) return {{{"mesh", 1.5, 2, [=] { return scan_on_floor(read_obj(*file, false).mesh); }}}};
  // Both are star-shaped around the place that `fitted` gives the origin.
  const auto entry = [](const std::string& name, double least, double aim, int n, double eye_least,
                        bool in_mean) {
    PolygonMesh with_origin = made_scan(n);
    with_origin.positions.push_back(dvec3(0));
    const dvec3 inside = test::fitted(with_origin).positions.back();
    return TraceEntry{
        {name, least, aim, [=] { return scan_on_floor(made_scan(n)); }}, eye_least, in_mean, inside};
  };
  return {entry("mesh-69k", 1.5, 2, 93, 1.4, true), entry("mesh-870k", 1.2, 1.5, 330, 1.1, false)};
}

}  // namespace

std::vector<TraceEntry> trace_entries(const std::optional<std::string>& mesh) {
  std::vector<TraceEntry> entries = mesh_entries(mesh);
  entries.push_back({{"flake", 1.5, 0, flake}});
  entries.push_back({{"gears", 1.5, 0, gears}});
  entries.push_back({{"mountain", 1.5, 0, mountain}});
  entries.push_back({{"pyramid", 1.5, 0, pyramid}});
  return entries;
}

}  // namespace sidelight::bench
