// SPDX-License-Identifier: MIT
// The fast z-buffer shows what its readable twin shows, bit for bit, with the same counts on every instruction set: over
// random scenes of tiny, small and large triangles, around and behind the eye, seen edge-on, one upon another at equal
// depth, beside spheres and planes, in crops, with any tile, thread and sample count. (The twin makes the layer cost.)
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/agreement/pictures.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// The frame, after it was compared with the twin's, on every instruction set and with other threads and tiles.
Frame judged(const Scene& scene, const Camera& camera, RenderOptions options = keeping(kRasterLayers)) {
  options.threads = 1;
  const Frame fast = rastered(scene, camera, options);
  options.layers |= layer_bit(Layer::cost);
  const Frame twin = rastered(scene, camera, options);
  CHECK(differences(fast, twin) == "");
  CHECK(fast.stats.visibility.tests == twin.stats.visibility.tests);

  options.layers &= ~layer_bit(Layer::cost);
  const auto prepared = raster::prepare(scene);
  for (const Isa isa : kIsas) {
    if (!machine_has(isa)) continue;
    options.isa = isa;
    options.threads = 3;
    const Frame other = raster::render(*prepared, camera, options);
    CHECK(other.stats.visibility.tests == fast.stats.visibility.tests);
    CHECK(other.stats.visibility.fragments == fast.stats.visibility.fragments);
    CHECK(other.stats.visibility.filtered == fast.stats.visibility.filtered);
    CHECK(other.stats.visibility.in_double == fast.stats.visibility.in_double);
    CHECK(other.stats.visibility.exact == fast.stats.visibility.exact);
  }
  options.tile = 7;
  CHECK(differences(raster::render(*prepared, camera, options), twin) == "");
  return fast;
}

Camera any_camera(Random& random, int n) {
  CameraSettings settings;
  settings.eye = random.in_box(1);
  settings.look_at = settings.eye + random.direction();
  settings.up = random.direction();
  settings.view_height = random.log_uniform(0.1, 10);
  return make_camera(settings, 75, 51, n);
}

// `count` triangles of about `size`, around the point `distance` before the eye.
PolygonMesh shards(Random& random, const Camera& camera, int count, double distance, double size) {
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 at =
        camera.eye + distance * (camera.forward + 0.7 * random.in_box(glm::length(camera.up)));
    for (int k = 0; k < 3; ++k) positions.push_back(at + random.in_box(size));
    const auto first = static_cast<std::uint32_t>(3 * i);
    faces.push_back({first, first + 1, first + 2});
  }
  return mesh_of(positions, faces);
}

}  // namespace

TEST_CASE("visible: shards of every size, near and far, beside a sphere and a plane") {
  Random random(71);
  for (const double size : {1e-4, 1e-2, 0.05, 0.3, 2.0, 50.0})
    for (const int n : {1, 2}) {
      CAPTURE(size);
      CAPTURE(n);
      const Camera camera = any_camera(random, n);
      Scene scene = scene_of(shards(random, camera, 300, random.uniform(0.5, 3), size));
      add_sphere(scene, {camera.eye + 2.0 * camera.forward, 0.4 * glm::length(camera.up), 0}, {});
      add_plane(scene, {camera.eye + random.direction(), random.direction(), 0}, {});
      judged(scene, camera);
      RenderOptions cropped = keeping(kRasterLayers);
      cropped.crop = {11, 3, 62, 40};
      judged(scene, camera, cropped);
    }
}

TEST_CASE("visible: vertices on the rays of samples, edges through them, and shared by many") {
  // At the origin, 2^-k a sample: every vertex lies on a sample's ray or half way between two, exactly; or up to two of
  // the units off that it is rounded to on the screen, 2^-19 sample each, so that edges pass samples by less than that.
  const Camera camera = plain_camera(64, 48, 0.75);
  Random random(72);
  const double sample = camera.up.y / camera.height;  // at distance 1
  for (const auto& [reach, off] :
       {std::pair<std::int64_t, double>{3, 0}, {12, 0}, {80, 0}, {12, 0x1p-17}, {80, 0x1p-17}}) {
    CAPTURE(reach);
    CAPTURE(off);
    std::vector<glm::dvec3> positions;
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < 400; ++i) {
      const glm::dvec3 at = random.on_grid(40);
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 half_steps = at + random.on_grid(reach) + random.in_box(off);
        const double depth = static_cast<double>(1 + random.below(2));
        positions.push_back({half_steps.x * sample / 2 * depth, half_steps.y * sample / 2 * depth, -depth});
      }
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Frame frame = judged(scene_of(mesh_of(positions, faces)), camera);
    CHECK((off > 0 || frame.stats.visibility.exact > 0));
  }
}

TEST_CASE("visible: sheets in one plane, whose depths differ in rounding at most") {
  Random random(73);
  const Camera camera = any_camera(random, 1);
  const glm::dvec3 across = random.direction(), along = random.direction(),
                   center = camera.eye + 3.0 * camera.forward;
  for (const double same : {0.02, 0.2, 4.0, 0.0}) {  // 0: of all sizes, in any order
    CAPTURE(same);
    std::vector<glm::dvec3> positions;
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < (same > 0 ? 200 : 4000); ++i) {
      const double u = random.uniform(-2, 2), v = random.uniform(-2, 2);
      const double size = same > 0 ? same : i % 100 == 0 ? 4 : random.log_uniform(0.002, 0.5);
      for (int k = 0; k < 3; ++k)
        positions.push_back(center + (u + size * random.uniform(-1, 1)) * across +
                            (v + size * random.uniform(-1, 1)) * along);
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    judged(scene_of(mesh_of(positions, faces)), camera);
  }
}

TEST_CASE("visible: a fan around the eye's own axis, seen edge-on and in part") {
  // The axis is a line through the eye: each triangle's plane contains it, or nearly does.
  Random random(74);
  const Camera camera = plain_camera(64, 48);
  for (const double off : {0.0, 0x1p-50, 0x1p-30, 1e-6}) {
    CAPTURE(off);
    std::vector<glm::dvec3> positions{{0, off, -1}, {0, off, -4}};
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < 24; ++i) {
      const glm::dvec3 rim = snapped(random.in_box(1));
      positions.push_back({rim.x, rim.y, -2.5});
      faces.push_back({0, 1, i + 2});
    }
    judged(scene_of(mesh_of(positions, faces)), camera);
  }
}

TEST_CASE("visible: long slivers and huge triangles across one another") {
  Random random(75);
  for (const double width : {1e-9, 1e-5, 1e-2}) {
    CAPTURE(width);
    const Camera camera = any_camera(random, 1);
    std::vector<glm::dvec3> positions;
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < 60; ++i) {
      const glm::dvec3 at = camera.eye + random.uniform(1, 4) * camera.forward + random.in_box(1);
      const glm::dvec3 end = at + random.log_uniform(0.01, 1e4) * random.direction();
      positions.insert(positions.end(), {at, end, end + random.in_box(width)});
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    judged(scene_of(mesh_of(positions, faces)), camera);
  }
}

// Tiles of 64 x 64 that one surface fills need no drawing, but where anything else may be before it.
TEST_CASE("visible: walls that fill tiles, what is before and behind them, and where they meet") {
  Random random(77);
  CameraSettings settings;
  settings.view_height = 0.8;
  for (int round = 0; round < 24; ++round) {
    CAPTURE(round);
    settings.eye = random.in_box(1);
    settings.look_at = settings.eye + random.direction();
    const Camera camera = make_camera(settings, 256, 192, round % 3 == 2 ? 2 : 1);
    const glm::dvec3 right = glm::normalize(camera.right), up = glm::normalize(camera.up);
    const auto at = [&](double distance) { return camera.eye + distance * camera.forward; };
    // Nearly across the view, the first two much like each other; some edges are seen, of halves too.
    Scene scene = empty_scene();
    scene.ambient = glm::dvec3(0.2);
    scene.lights = {lamp(camera.eye + random.in_box(1), 0.8)};
    for (int wall = 0; wall < 4; ++wall) {
      const bool alike = wall < 2;
      const glm::dvec3 tilt = (alike ? 1e-4 : 0.3) * random.in_box(1);
      const double size = alike ? 4 : random.uniform(0.5, 4);
      const glm::dvec3 x = size * (right + tilt), y = size * (up + 0.5 * tilt);
      const glm::dvec3 middle = at(alike ? 2 : random.uniform(1.5, 4)) + random.in_box(0.5);
      add_mesh(
          scene,
          mesh_of({middle - x - y, middle + x - y, middle + x + y, middle - x + y}, {{0, 1, 2}, {0, 2, 3}}),
          {}, {});
    }
    // A few small and tiny ones, of any side, before, at and behind them; most tiles have none.
    for (const double size : {0.05, 0.002})
      if (round % 4 != 0) add_mesh(scene, shards(random, camera, 3, random.uniform(0.5, 3), size), {}, {});
    if (round % 5 == 0) add_sphere(scene, {at(random.uniform(0.5, 3)) + 0.3 * right, 0.05, 0}, {});
    if (round % 2 == 0)
      add_plane(scene, {at(random.uniform(1, 3)), camera.forward + 0.2 * random.in_box(1), 0}, {});
    judged(scene, camera);
  }
}

TEST_CASE("visible: a lattice of 16384 columns, of which a corner is drawn") {
  Random random(76);
  CameraSettings settings;
  settings.look_at = {0, 0, -1};
  const Camera camera = make_camera(settings, 16384, 8192, 1);
  RenderOptions corner = keeping(kRasterLayers);
  corner.crop = {16324, 8150, 16384, 8192};
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  const glm::dvec3 seen = camera.direction(16360, 8170) / camera.depth_scale();
  for (std::uint32_t i = 0; i < 300; ++i) {
    const glm::dvec3 at = random.uniform(1, 2) * (seen + random.in_box(4e-3));
    for (int k = 0; k < 3; ++k) positions.push_back(at + random.in_box(random.log_uniform(1e-5, 1e-1)));
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  judged(scene_of(mesh_of(positions, faces)), camera, corner);
}

// Where nothing is doubtful.
TEST_CASE("visible: a triangle's signs are counted, three a test and its side") {
  for (const double size : {0.02, 0.1, 0.4}) {
    CAPTURE(size);
    const Scene scene = scene_of_triangle({0.003, 0.004, -1}, {0.003 + size, 0.0053, -1}, {0.0047, size, -1});
    const VisibilityCounts counts = rastered(scene, plain_camera(64, 48)).stats.visibility;
    CHECK(counts.tests > 0);
    CHECK(counts.filtered == 3 * counts.tests + 1);
    CHECK(counts.exact == 0);
  }
}

TEST_CASE("visible: every pixel is written, whatever the frame's memory held") {
  Random random(73);
  const Camera camera = make_camera({{0, 0, 4}, {0, 0, 0}}, 1280, 1024, 1);  // memory used again
  Scene scene = scene_of(shards(random, camera, 300, 2, 0.2));
  add_sphere(scene, {{1, 0, 0}, 0.5, 0}, {});
  RenderOptions options = keeping(kRasterLayers);
  const Frame first = rastered(scene, camera, options);
  {
    Frame spoiled = first;
    const auto spoil = [](auto& array) {
      std::fill_n(reinterpret_cast<unsigned char*>(array.data()), array.size() * sizeof(array[0]), 0xff);
    };
    spoil(spoiled.color);
    for (auto& layer : spoiled.rgb) spoil(layer);
    spoil(spoiled.depth);
    spoil(spoiled.object_id);
    spoil(spoiled.primitive_id);
    spoil(spoiled.normal);
    spoil(spoiled.sample_primitive);
    spoil(spoiled.sample_depth);
  }
  CHECK(differences(rastered(scene, camera, options), first) == "");
}
