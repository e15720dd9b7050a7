// SPDX-License-Identifier: MIT
// The layer cost counts what it says: against counts made by hand, and in sum against the statistics. That it
// depends on neither threads, tiles, crop nor instruction set is a case of test_promises.cpp, with all other
// layers.
#include <doctest/doctest.h>

#include <numeric>
#include <set>

#include "common/scene/toml.h"
#include "raster/setup.h"
#include "tests/agreement/pictures.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr LayerMask kCost = layer_bit(Layer::cost);

Camera camera_of(const glm::dvec3& eye, const glm::dvec3& look_at, int size, int n) {
  CameraSettings settings;
  settings.eye = eye;
  settings.look_at = look_at;
  settings.view_height = 2;  // at distance 1
  return make_camera(settings, size, size, n);
}

RenderOptions cost_only() {
  RenderOptions options;
  options.layers = kCost;
  return options;
}

// The cost that every pixel of a frame has.
float cost_everywhere(const Frame& frame) {
  const std::set<float> all(frame.cost.begin(), frame.cost.end());
  CHECK(all.size() == 1);
  return *all.begin();
}

// A unit sphere three units before the eye, a wall behind it, and no light.
Scene sphere_before_wall() {
  Scene scene = scene_of(Sphere{{0, 0, 0}, 1, 0});
  add_plane(scene, {{0, 0, -5}, {0, 0, 1}, 0}, {});
  return scene;
}
Camera camera_at_sphere(int n) { return camera_of({0, 0, 3}, {0, 0, 0}, 64, n); }

Material grey() {
  Material material;
  material.diffuse = glm::dvec3(0.5);
  return material;
}
Material mirror() {
  Material material = grey();
  material.reflect = glm::dvec3(0.5);
  return material;
}
Material glass() {
  Material material = grey();
  material.refract = glm::dvec3(0.5);
  material.ior = 1.5;
  return material;
}

// Two planes, one above the other, seen from above and lit from above. (Not at y = 0, where nothing rounds
// and rays may start in the plane itself.)
struct Floors {
  Scene scene;

  explicit Floors(const Material& upper, const Material& lower = grey()) {
    add_plane(scene, {{0, 2, 0}, {0, 1, 0}, add_material(scene, upper)}, {});
    add_plane(scene, {{0, 1, 0}, {0, 1, 0}, add_material(scene, lower)}, {});
    add_lamp({0, 7, 0});
    scene.trace.depth = 2;
  }
  void add_lamp(const glm::dvec3& position) {
    Light lamp;
    lamp.position = position;
    lamp.intensity = glm::dvec3(1);
    scene.lights.push_back(lamp);
  }
  float cost(int n = 1) const {
    return cost_everywhere(traced(scene, camera_of({0, 4, 0}, {0, 0, 0}, 5, n), cost_only()));
  }
};

double sum(const KeptArray<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

TEST_CASE("cost: the z-buffer tries the wall everywhere and the sphere within its box") {
  const Scene scene = sphere_before_wall();
  for (const int n : {1, 2}) {
    CAPTURE(n);
    const Camera camera = camera_at_sphere(n);
    const raster::SampleBox box = raster::box_of_primitive(scene, camera, 0);
    const Frame frame = rastered(scene, camera, cost_only());
    int wrong = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        int tests = n * n;  // of the wall
        for (int Y = n * y; Y < n * (y + 1); ++Y)
          for (int X = n * x; X < n * (x + 1); ++X)
            tests += box.x0 <= X && X < box.x1 && box.y0 <= Y && Y < box.y1;
        wrong += frame.cost[frame.index(x, y)] != static_cast<float>(tests);
      }
    CHECK(wrong == 0);
    // The near face of the cube around the sphere is two units away: half as wide as the picture.
    CHECK(frame.cost[frame.index(16, 47)] == static_cast<float>(2 * n * n));
    CHECK(frame.cost[frame.index(12, 32)] == static_cast<float>(n * n));
    CHECK(frame.cost[frame.index(32, 51)] == static_cast<float>(n * n));
  }
}

TEST_CASE("cost: the tracer's eye rays ask the wall, and the sphere where they meet its cube") {
  const Frame frame = traced(sphere_before_wall(), camera_at_sphere(1), cost_only());
  int wrong = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool in_cube = 16 <= x && x < 48 && 16 <= y && y < 48;  // as above; no ray is near the edge
      wrong += frame.cost[frame.index(x, y)] != (in_cube ? 2.0f : 1.0f);
    }
  CHECK(wrong == 0);
}

TEST_CASE("cost: a triangle that is seen edge-on costs the z-buffer nothing") {
  const Camera camera = camera_of({0, 0, 3}, {0, 0, 0}, 8, 1);
  const Scene across = scene_of_triangle({0, -9, 0}, {0, 9, 0}, {9, 0, 0});
  const Scene edge_on = scene_of_triangle({0, -9, 0}, {0, 9, 0}, {0, 0, -9});
  CHECK(sum(rastered(across, camera, cost_only()).cost) > 0);
  CHECK(sum(rastered(edge_on, camera, cost_only()).cost) == 0);
}

TEST_CASE("cost: each kind of ray of the tracer counts") {
  // An eye ray asks both planes; so does the shadow ray from the upper one, which nothing blocks.
  Floors plain(grey());
  CHECK(plain.cost() == 2 + 2);
  CHECK(plain.cost(3) == 9 * (2 + 2));
  plain.add_lamp({1, 9, 0});
  CHECK(plain.cost() == 2 + 2 + 2);
  plain.scene.trace.shadows = false;
  CHECK(plain.cost() == 2);

  Floors mirrored(mirror());
  CHECK(mirrored.cost() == 2 + 2 + 2);  // the mirrored ray asks both, and leaves the scene
  mirrored.scene.trace.depth = 1;
  CHECK(mirrored.cost() == 2 + 2);

  // Glass: the refracted ray starts above its own surface, meets that, passes it, and asks both again for
  // what comes after. From the lower plane the shadow ray asks the upper one, and is blocked.
  CHECK(Floors(glass()).cost() == 2 + 2 + (2 + 2 + 1));
}

TEST_CASE("cost: where solids overlap, the queries about media count") {
  // Glass below glass: now what is met together with a surface must be looked for. A query asks both planes, once
  // each, for a plane is not met twice. Eye, shadow, query; refracted: own surface, query, lower surface, query,
  // shadow, and the query for a further refracted ray, which is too deep to be sent.
  CHECK(Floors(glass(), glass()).cost() == 2 + 2 + 2 + (2 + 2 + 2 + 2 + 1 + 2));
}

TEST_CASE("cost: the pixels add up to the statistics, and to nothing else than asked for") {
  std::vector<std::string> files = shipped_scenes();
  files.push_back(kEverything);
  for (const std::string& file : files) {
    CAPTURE(short_name(file));
    const Scene scene = load_scene(file);
    const Camera camera = make_camera(scene.camera, 53, 37, 2);
    const Frame flat = rastered(scene, camera, keeping(kRasterLayers | kCost));
    const Frame deep = traced(scene, camera, keeping(kAllLayers));
    CHECK(sum(flat.cost) == static_cast<double>(flat.stats.visibility.tests));
    CHECK(sum(deep.cost) == static_cast<double>(deep.stats.visibility.tests));

    // Not asked for, it is not made, counted all the same, and changes nothing. (Waves count packets otherwise.)
    const Frame plain_flat = rastered(scene, camera), plain_deep = traced(scene, camera);
    CHECK(plain_flat.cost.empty());
    CHECK(plain_deep.cost.empty());
    CHECK(plain_flat.stats.visibility.tests == flat.stats.visibility.tests);
    const auto prepared = raytrace::prepare(scene);
    const Frame counted = raytrace::render_recursively(*prepared, camera, keeping(kRaytraceLayers));
    CHECK(counted.stats.visibility.tests == deep.stats.visibility.tests);
    CHECK(plain_deep.stats.visibility.tests > 0);
    CHECK(differences(plain_flat, flat) == "");
    CHECK(differences(plain_deep, deep) == "");
  }
}
