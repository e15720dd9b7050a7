// SPDX-License-Identifier: MIT
// The waves are the recursion, bit for bit: colours, layers, ids, depths, and what is counted. Every other test that
// draws a picture through tests/agreement/pictures.h asks this too.
#include <doctest/doctest.h>

#include "common/clock.h"
#include "common/scene/build.h"
#include "common/scene/toml.h"
#include "tests/agreement/pictures.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// What both count alike.
void check_counts(const RenderStats& waves, const RenderStats& recursion) {
  CHECK(waves.rays.primary == recursion.rays.primary);
  CHECK(waves.rays.shadow == recursion.rays.shadow);
  CHECK(waves.rays.reflection == recursion.rays.reflection);
  CHECK(waves.rays.refraction == recursion.rays.refraction);
  CHECK(waves.self_shadowed == recursion.self_shadowed);
  CHECK(waves.cut_weight == recursion.cut_weight);
}

void check_same(const Scene& scene, int width, int height, int n, Isa isa = best_isa()) {
  const auto prepared = raytrace::prepare(scene);
  const Camera camera = make_camera(scene.camera, width, height, n);
  RenderOptions options = keeping(kRaytraceLayers);
  options.isa = isa;
  const Frame recursion = raytrace::render_recursively(*prepared, camera, options);
  for (const int tile : {32, 5}) {
    options.tile = tile;
    const Frame waves = raytrace::render(*prepared, camera, options);
    CHECK(differences(waves, recursion) == "");
    check_counts(waves.stats, recursion.stats);
  }
  // What is not asked for changes nothing.
  RenderOptions plain;
  plain.isa = isa;
  const Frame waves = raytrace::render(*prepared, camera, plain);
  CHECK(differences(waves, recursion) == "");
  check_counts(waves.stats, recursion.stats);
}

glm::dvec3 some_of(Random& random, double likely) {
  return random.uniform() < likely ? glm::dvec3(random.uniform(), random.uniform(), random.uniform())
                                   : glm::dvec3(0);
}

void add_materials(Scene& scene, Random& random) {
  for (int i = 0; i < 6; ++i) {
    Material material;
    material.name = std::to_string(i);
    material.ambient = some_of(random, 0.7);
    material.diffuse = some_of(random, 0.8);
    material.specular = some_of(random, 0.5);
    material.shininess = random.log_uniform(1, 1000);
    material.reflect = 0.6 * some_of(random, 0.5);
    material.refract = 0.8 * some_of(random, 0.4);
    material.ior = random.uniform(0.7, 2);
    material.casts_shadow = random.uniform() < 0.8;
    add_material(scene, material);
  }
}

// Solids that overlap, a soup of triangles on a grid that touch in edges and planes, balls that touch, lamps in between.
Scene drawn_scene(Random& random) {
  Scene scene;
  add_materials(scene, random);
  const auto material = [&] { return random.below(6); };
  scene.background = {0.1, 0.2, 0.3};
  scene.ambient = glm::dvec3(0.2);
  scene.trace.depth = 1 + static_cast<int>(random.below(6));
  if (random.uniform() < 0.3) scene.trace.contribution_cut = 0.05;
  if (random.uniform() < 0.3) scene.trace.secondary_attenuation = {0.9, 0.1, 0.01};
  scene.trace.shadows = random.uniform() < 0.8;
  for (std::uint32_t left = random.below(5); left > 0; --left) {
    PolygonMesh mesh =
        random.uniform() < 0.5 ? star_sphere(8, 9, 0.3, random.bits()) : octahedron({0, 0, 0}, 1);
    const glm::dvec3 at = random.in_box(2);
    for (glm::dvec3& p : mesh.positions) p = at + p;
    const std::uint32_t of_mesh = material();
    for (PolygonMesh::Face& face : mesh.faces) face.material = of_mesh;
    add_mesh(scene, mesh, {}, {});
  }
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < random.below(60); ++i) {
    for (int k = 0; k < 3; ++k) positions.push_back(0.5 * random.on_grid(4));
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  if (!faces.empty()) {
    PolygonMesh soup = mesh_of(positions, faces);
    for (PolygonMesh::Face& face : soup.faces) face.material = material();
    add_mesh(scene, soup, {}, {});
  }
  for (std::uint32_t left = random.below(8); left > 0; --left)
    add_sphere(scene,
               {0.5 * random.on_grid(4), random.uniform() < 0.5 ? 0.5 : random.uniform(0.1, 1), material()},
               {});
  for (std::uint32_t left = random.below(3); left > 0; --left)
    add_plane(scene,
              {0.5 * random.on_grid(4), left == 1 ? glm::dvec3(0, 1, 0) : random.direction(), material()},
              {});
  for (std::uint32_t left = random.below(4); left > 0; --left)
    scene.lights.push_back(random.uniform() < 0.6
                               ? lamp(0.5 * random.on_grid(8), 0.8)
                               : sun(random.uniform() < 0.5 ? glm::dvec3(0, 1, 0) : random.direction(), 0.5));
  scene.camera.eye = random.uniform() < 0.5 ? random.in_box(5) : 0.5 * random.on_grid(8);
  scene.camera.look_at = random.in_box(1);
  scene.camera.view_height = 1;
  return scene;
}

void check_drawn(Isa isa, std::uint64_t seed) {
  if (!machine_has(isa)) return skip_test(std::string("no ") + std::string(isa_name(isa)));
  Random random(seed);
  for (std::uint64_t left = 4 + tier_count("rays_per_case") / 50000; left > 0; --left) {
    CAPTURE(left);
    check_same(drawn_scene(random), 37, 29, left % 4 == 0 ? 2 : 1, isa);
  }
}

}  // namespace

TEST_CASE("waves are the recursion on every shipped scene") {
  std::vector<std::string> files = shipped_scenes();
  for (const std::string& file : hard_scene_files()) files.push_back(file);
  files.push_back(kEverything);
  for (const std::string& file : files) {
    CAPTURE(short_name(file));
    check_same(load_scene(file), 80, 60, 1);
    check_same(load_scene(file), 27, 20, 2);
  }
}

TEST_CASE("waves are the recursion on drawn scenes: scalar") { check_drawn(Isa::scalar, 90); }
TEST_CASE("waves are the recursion on drawn scenes: AVX2") { check_drawn(Isa::avx2, 91); }
TEST_CASE("waves are the recursion on drawn scenes: AVX-512") { check_drawn(Isa::avx512, 92); }

// Edges that pass through the points of rays, as near as doubles come: which side the ray is on no float can tell. Rays
// leave there, too, past edges that pass through shadow rays.
TEST_CASE("waves are the recursion where edges run through rays") {
  Random random(93);
  for (std::uint64_t left = 2 + tier_count("rays_per_case") / 100000; left > 0; --left) {
    Scene scene;
    add_materials(scene, random);
    scene.ambient = glm::dvec3(0.2);
    scene.lights = {lamp({0.3, 0.9, 1.1}, 0.8)};
    scene.camera.eye = random.in_box(1) + glm::dvec3(0, 0, 4);
    scene.camera.look_at = {0, 0, 0};
    scene.camera.view_height = 1;
    const Camera camera = make_camera(scene.camera, 37, 29, 1);
    std::vector<glm::dvec3> positions;
    std::vector<Face> faces;
    const auto add_edge_through = [&](const glm::dvec3& point) {
      const glm::dvec3 along = random.uniform(0.1, 0.4) * random.direction();
      const auto first = static_cast<std::uint32_t>(positions.size());
      positions.insert(positions.end(), {point + along, point - along, point + 0.3 * random.direction()});
      faces.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 d =
          camera.direction(static_cast<int>(random.below(37)), static_cast<int>(random.below(29)));
      const glm::dvec3 seen = scene.camera.eye + random.uniform(3, 5) / glm::length(d) * d;
      add_edge_through(seen);
      add_edge_through(glm::mix(seen, scene.lights[0].position, random.uniform(0.3, 0.7)));
    }
    PolygonMesh soup = mesh_of(positions, faces);
    for (PolygonMesh::Face& face : soup.faces) face.material = random.below(6);
    add_mesh(scene, soup, {}, {});
    for (const Isa isa : kIsas)
      if (machine_has(isa)) check_same(scene, 37, 29, 1, isa);
  }
}

// There the two points at which a ray meets a ball come together, and shadow rays graze it where they leave.
TEST_CASE("waves are the recursion at the outline of glass balls") {
  Random random(95);
  for (std::uint64_t left = 3 + tier_count("rays_per_case") / 50000; left > 0; --left) {
    CAPTURE(left);
    Scene scene;
    Material glass;
    glass.name = "glass";
    glass.ambient = glass.diffuse = glass.specular = glm::dvec3(0.3);
    glass.reflect = glm::dvec3(0.2);
    glass.refract = glm::dvec3(0.7);
    glass.ior = random.uniform(0.7, 2);
    add_material(scene, glass);
    scene.trace.depth = 6;
    scene.background = {0.1, 0.2, 0.3};
    const glm::dvec3 center = random.in_box(3);
    const double radius = random.log_uniform(0.01, 2);
    add_sphere(scene, {center, radius, 0}, {});
    // Inside it another one, or one that overlaps it, or touches it.
    const double inner = random.uniform(0.1, 1) * radius;
    add_sphere(scene, {center + random.uniform(0, 1) * (radius - inner) * random.direction(), inner, 0}, {});
    add_plane(scene, {center - glm::dvec3(0, radius, 0), {0, 1, 0}, 0}, {});
    scene.camera.eye = center + radius * random.uniform(1.5, 6) * random.direction();
    const glm::dvec3 to_eye = scene.camera.eye - center, away = across(to_eye, random);
    const double sine = radius / glm::length(to_eye);
    const glm::dvec3 outline =
        center + radius * (sine * glm::normalize(to_eye) + std::sqrt(1 - sine * sine) * away);
    scene.camera.look_at = outline;
    scene.camera.view_height = random.log_uniform(1e-12, 1e-1);
    // In the plane that touches the ball there, or nearly.
    for (int i = 0; i < 3; ++i)
      scene.lights.push_back(lamp(outline +
                                      radius * random.uniform(0.5, 4) * across(outline - center, random) +
                                      random.log_uniform(1e-15, 1e-2) * random.direction(),
                                  0.5));
    scene.lights.push_back(sun(across(outline - center, random), 0.4));
    for (const Isa isa : kIsas)
      if (machine_has(isa)) check_same(scene, 37, 29, 1, isa);
  }
}

// Nearly every ray is in a set of media of its own: more than a wave remembers. Where each sends two more, most of them
// have to wait.
TEST_CASE("waves are the recursion in a crowd of glass") {
  for (const bool mirrors : {false, true}) {
    Random random(98);
    Scene scene = empty_scene();
    scene.background = {0.2, 0.3, 0.4};
    scene.trace.depth = mirrors ? 7 : 24;
    scene.trace.shadows = false;
    for (int i = 0; i < 60; ++i) {
      Material glass;
      glass.name = std::to_string(i);
      glass.ambient = glm::dvec3(random.uniform());
      glass.reflect = glm::dvec3(mirrors ? 0.3 : 0);
      glass.refract = glm::dvec3(0.9);
      glass.ior = random.uniform(1, 1.1);
      add_sphere(scene, {random.in_box(1), random.uniform(0.5, 1.5), add_material(scene, glass)}, {});
    }
    scene.ambient = glm::dvec3(0.1);
    scene.camera.eye = {0, 0, 4};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.view_height = 0.8;
    check_same(scene, 32, 32, 1);
  }
}

TEST_CASE("waves go as deep as the scene asks, without a stack") {
  // Two mirrors face each other, with the eye in between.
  Scene scene;
  Material mirror;
  mirror.name = "mirror";
  mirror.ambient = mirror.reflect = glm::dvec3(1);
  add_material(scene, mirror);
  add_plane(scene, {{0, -1, 0}, {0, 1, 0}, 0}, {});
  add_plane(scene, {{0, 1, 0}, {0, -1, 0}, 0}, {});
  scene.ambient = glm::dvec3(1);
  scene.trace.depth = 100000;
  scene.camera.eye = {0, 0, 0};
  scene.camera.look_at = {0, 1, 0};
  const auto prepared = raytrace::prepare(scene);
  const Frame frame = raytrace::render(*prepared, make_camera(scene.camera, 1, 1, 1), {});
  CHECK(frame.color[0] == glm::vec3(100000));
  CHECK(frame.stats.rays.reflection == 99999);
}

TEST_CASE("waves take no more memory where every hit sends two rays") {
  // Sheets that mirror and transmit, with the eye between them: at each depth twice the rays of the one before.
  Scene scene;
  Material sheet;
  sheet.name = "sheet";
  sheet.ambient = sheet.reflect = sheet.refract = glm::dvec3(0.5);
  add_material(scene, sheet);
  constexpr int kSheets = 40;
  for (int i = 0; i < kSheets; ++i) {
    const double z = i - kSheets / 2;
    add_mesh(scene, mesh_of({{-1e4, -1e4, z}, {1e4, -1e4, z}, {0, 2e4, z}}, {{0, 1, 2}}), {}, {});
  }
  scene.ambient = glm::dvec3(1);
  scene.camera.eye = {0, 0, 0.5};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.view_height = 1;
  scene.trace.depth = tier() == "sanitized" ? 9 : 17;
  reset_peak_memory();
  const double before = peak_memory_mb();
  check_same(scene, 4, 4, 1);
  // The last level has 4 x 4 x 2^16 rays of 150 bytes and more.
  if (tier() != "sanitized") CHECK(peak_memory_mb() - before < 64);
}
