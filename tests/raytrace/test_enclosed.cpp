// SPDX-License-Identifier: MIT
// Where a light is called hidden from within a solid, blocker() finds something in the way: the waves, which ask no tree
// there, are the recursion, which does, in meshes that overlap themselves, have cavities, are nested, and hold mirrors.
#include <doctest/doctest.h>

#include "raytrace/enclosed.h"
#include "tests/agreement/pictures.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::Enclosures;
using raytrace::Prepared;

namespace {

// Adds a second body to a mesh, turned inside out if asked for: two that overlap, or one with a cavity.
void append(PolygonMesh& mesh, const PolygonMesh& other, bool turned) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (PolygonMesh::Face face : other.faces) {
    const std::uint32_t from = face.first;
    face.first = static_cast<std::uint32_t>(mesh.corners.size());
    for (std::uint32_t k = 0; k < face.count; ++k) {
      PolygonMesh::Corner corner = other.corners[from + (turned ? face.count - 1 - k : k)];
      corner.position += first;
      mesh.corners.push_back(corner);
    }
    mesh.faces.push_back(face);
  }
}

PolygonMesh body(Random& random, const glm::dvec3& at, double size) {
  PolygonMesh mesh =
      random.uniform() < 0.3 ? octahedron({0, 0, 0}, 1) : star_sphere(6, 7, 0.3, random.bits());
  for (glm::dvec3& p : mesh.positions) p = at + size * p;
  return mesh;
}

void add_material(Scene& scene, Random& random, double refract, double reflect) {
  Material material;
  material.name = std::to_string(scene.materials.size());
  material.ambient = material.diffuse = material.specular = glm::dvec3(0.3);
  material.refract = glm::dvec3(refract);
  material.reflect = glm::dvec3(reflect);
  material.ior = random.uniform(0.9, 1.6);
  material.casts_shadow = random.uniform() < 0.8;
  sidelight::add_material(scene, material);
}

Scene glass_scene(Random& random) {
  Scene scene;
  add_material(scene, random, 0.7, 0.2);
  add_material(scene, random, 0.8, 0);
  add_material(scene, random, 0, 0.6);
  scene.background = {0.1, 0.2, 0.3};
  scene.trace.depth = 6;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 at = random.in_box(1);
    PolygonMesh mesh = body(random, at, 1);
    if (random.uniform() < 0.7)
      append(mesh, body(random, at + random.in_box(1.2), random.uniform(0.2, 0.9)), random.uniform() < 0.6);
    const std::uint32_t material = random.below(2);
    for (PolygonMesh::Face& face : mesh.faces) face.material = material;
    add_mesh(scene, mesh, {}, {});
    add_sphere(scene, {at + random.in_box(1), random.uniform(0.05, 0.6), random.below(3)}, {});
    PolygonMesh mirror =
        mesh_of({at + random.in_box(1), at + random.in_box(1), at + random.in_box(1)}, {{0, 1, 2}});
    mirror.faces[0].material = 2;
    add_mesh(scene, mirror, {}, {});
  }
  for (int i = 0; i < 3; ++i) scene.lights.push_back(lamp(random.in_box(i == 0 ? 1 : 4), 0.8));
  scene.lights.push_back(sun(random.direction(), 0.4));
  scene.camera.eye = random.uniform() < 0.2 ? random.in_box(1) : 4.0 * random.direction();
  scene.camera.look_at = random.in_box(0.5);
  scene.camera.view_height = 0.6;
  return scene;
}

}  // namespace

TEST_CASE("enclosed points: the waves are the recursion in bodies of every make") {
  Random random(97);
  for (std::uint64_t left = 10 + tier_count("rays_per_case") / 2000; left > 0; --left) {
    CAPTURE(left);
    const Scene scene = glass_scene(random);
    const auto prepared = raytrace::prepare(scene);
    const Camera camera = make_camera(scene.camera, 41, 33, 1);
    const RenderOptions options = keeping(kRaytraceLayers);
    const Frame recursion = raytrace::render_recursively(*prepared, camera, options);
    const Frame waves = raytrace::render(*prepared, camera, options);
    CHECK(differences(waves, recursion) == "");
    CHECK(waves.stats.rays.shadow == recursion.stats.rays.shadow);
    CHECK(waves.stats.self_shadowed == recursion.stats.self_shadowed);
  }
}

TEST_CASE("enclosed points: inside of a ball every ray is blocked") {
  Random random(98);
  const std::uint64_t balls = 200 + tier_count("rays_per_case") / 50;
  std::uint64_t hidden = 0;
  for (std::uint64_t left = balls; left > 0; --left) {
    Scene scene = empty_scene();
    scene.materials[0].refract = glm::dvec3(0.5);
    const double radius = random.log_uniform(1e-6, 1e6);
    const glm::dvec3 center = random.log_uniform(1e-9, 1e9) * random.direction();
    add_sphere(scene, {center, radius, 0}, {});
    scene.lights = {lamp(center + random.log_uniform(0.5, 1e3) * radius * random.direction(), 1)};
    const Prepared prepared(scene);
    const Enclosures enclosures(prepared);
    // At all depths below the surface, down to rounding.
    const glm::dvec3 from = center + radius * (1 - random.log_uniform(1e-17, 1)) * random.direction();
    raytrace::Media media;
    media.enter(0);
    const std::uint32_t around = enclosures.around(from, media, false);
    if (!enclosures.hide(around, 0)) continue;
    ++hidden;
    VisibilityCounts counts;
    const glm::dvec3 light = scene.lights[0].position;
    CHECK(blocker(prepared, make_ray(from, light - from), &light, counts).found());
  }
  CHECK(hidden > balls / 4);  // the others' light or rounding is too near
}

TEST_CASE("enclosed points: what lets rays out shuts nothing in") {
  Scene scene = empty_scene();
  scene.materials[0].refract = glm::dvec3(0.5);
  add_mesh(scene, octahedron({0, 0, 0}, 1), {}, {});
  const Object& solid = scene.objects[0];
  REQUIRE(solid.solid);
  CHECK(raytrace::shuts_in(scene, solid));
  scene.triangles[3].degenerate = true;
  CHECK_FALSE(raytrace::shuts_in(scene, solid));
  scene.triangles[3].degenerate = false;
  scene.materials[0].casts_shadow = false;
  CHECK_FALSE(raytrace::shuts_in(scene, solid));
  const Scene water = scene_of(Plane{{0, 0, 0}, {0, 1, 0}, 0});
  CHECK_FALSE(raytrace::shuts_in(water, water.objects[0]));  // rays leave downward

  const Bounds bounds{glm::dvec3(-1), glm::dvec3(1)};
  CHECK(raytrace::is_outside(bounds, sun({0, 1, 0}, 1)));
  CHECK(raytrace::is_outside(bounds, lamp({0, 1.2, 0}, 1)));
  CHECK_FALSE(raytrace::is_outside(bounds, lamp({0, 1.1, 0}, 1)));
  CHECK_FALSE(raytrace::is_outside(bounds, lamp({0.5, 0.5, 0.5}, 1)));
}
