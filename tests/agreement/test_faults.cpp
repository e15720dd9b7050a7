// SPDX-License-Identifier: MIT
// Faults on purpose in both renderers: each spoils what it should and nothing where theory says so, and off is off.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/scene/tessellate.h"
#include "common/scene/toml.h"
#include "raster/faulty_tile.h"
#include "tests/agreement/pictures.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

Scene hard(const std::string& name) {
  return load_scene(SIDELIGHT_SOURCE_DIR "/scenes/hard/" + name + ".toml");
}

RenderOptions with(const Faults& faults, LayerMask layers) {
  RenderOptions options = keeping(layers);
  options.faults = faults;
  return options;
}

Camera camera_of(const Scene& scene) { return make_camera(scene.camera, 120, 90, 1); }

std::size_t wrong_surfaces(const Frame& a, const Frame& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.sample_primitive.size(); ++i)
    count += a.sample_primitive[i] != b.sample_primitive[i];
  return count;
}

std::size_t z_fighting(DepthFormat format, double near, double far) {
  const Scene scene = hard("depth-format");
  Faults faults;
  faults.depth_format = format;
  faults.near_plane = near;
  faults.far_plane = far;
  return wrong_surfaces(rastered(scene, camera_of(scene), with(faults, kRasterLayers)),
                        rastered(scene, camera_of(scene)));
}

std::size_t wrong_shadows(double offset) {
  const Scene scene = hard("shadow-offset");
  Faults faults;
  faults.shadow_offset = offset;
  const Frame faulty = traced(scene, camera_of(scene), with(faults, kRaytraceLayers));
  const Frame exact = traced(scene, camera_of(scene));
  CHECK(wrong_surfaces(faulty, exact) == 0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < exact.pixels(); ++i) count += faulty.color[i] != exact.color[i];
  return count;
}

// A square at depth 8 whose corners are seen `off` pixels right of pixel corners, 64 x 64 pixels, view height 1.
Scene square_scene(double off) {
  const double pixel = 8.0 / 64, x = off * pixel;
  Scene scene = test::scene_of(test::mesh_of(
      {{x - 2, -2, -8}, {x + 2, -2, -8}, {x + 2, 2, -8}, {x - 2, 2, -8}}, {{0, 1, 2}, {0, 2, 3}}));
  scene.ambient = glm::dvec3(1);
  return scene;
}

std::string snapping(const Scene& scene, int bits) {
  const Camera camera = make_camera(scene.camera, 64, 64, 1);
  Faults faults;
  faults.snap_bits = bits;
  return differences(rastered(scene, camera, with(faults, kRasterLayers)), rastered(scene, camera));
}

// How far the facets of a sphere of radius 1 lie inside it, at most.
double facet_depth(int segments) {
  const Scene scene = tessellated(test::scene_of(Sphere{}), segments);
  double deepest = 0;
  for (const Triangle& triangle : scene.triangles) {
    glm::dvec3 middle(0);
    for (const std::uint32_t v : triangle.vertex) middle += scene.positions[v] / 3.0;
    deepest = std::max(deepest, 1 - glm::length(middle));
  }
  return deepest;
}

}  // namespace

TEST_CASE(
    "faults: a shadow offset gives acne where it is too small, leaks where too large, nothing between") {
  CHECK(wrong_shadows(0) > 100);
  CHECK(wrong_shadows(0.3) > 10);
  CHECK(wrong_shadows(1e-9) == 0);  // far above rounding (2^-50), far below everything in the scene
}

TEST_CASE("faults: depth formats fight, a reversed float does not") {
  const std::size_t worst = z_fighting(DepthFormat::unorm16, 0.01, 1e4);
  CHECK(worst > 500);
  // A step of z at z = 40 is z² / (near 2^16): 2.4 and 0.005 here, half of the gap of 0.01.
  CHECK(z_fighting(DepthFormat::unorm16, 5, 1e4) < worst / 2);
  CHECK(z_fighting(DepthFormat::unorm24, 5, 1e4) == 0);
  CHECK(z_fighting(DepthFormat::reversed, 0.01, 1e4) == 0);
}

TEST_CASE("faults: between planes at 1 and 3 a depth format stores 3 (z - 1) / 2 z, or the reverse") {
  const Camera camera = plain_camera(64, 64);
  const auto stored = [&](DepthFormat format, double z) {
    Faults faults;
    faults.depth_format = format;
    faults.near_plane = 1;
    faults.far_plane = 3;
    return raster::StoredDepth(faults, camera).key(z / camera.depth_scale());
  };
  for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::float32})
    CHECK(stored(format, 1) == 0);
  CHECK(stored(DepthFormat::unorm16, 1.5) == 0x8000);  // 65535 / 2, to the nearest
  CHECK(stored(DepthFormat::unorm24, 1.5) == 0x800000);
  CHECK(stored(DepthFormat::float32, 1.5) == 0.5);
  CHECK(stored(DepthFormat::float32, 1.25) == double{0.3f});
  CHECK(stored(DepthFormat::unorm16, 3) == 0xFFFF);
  CHECK(stored(DepthFormat::reversed, 1) == -1);
  CHECK(stored(DepthFormat::reversed, 1.5) == -0.5);
  CHECK(stored(DepthFormat::reversed, 3) == 0);
}

TEST_CASE("faults: what lies on the near or the far plane is between them") {
  Faults faults;
  faults.depth_format = DepthFormat::float32;
  const Scene wall = test::scene_of(Plane{{0, 0, -12}, {0, 0, 1}, 0});
  const auto is_seen = [&](double near, double far) {
    faults.near_plane = near;
    faults.far_plane = far;
    const Frame frame = rastered(wall, plain_camera(16, 16), with(faults, kRasterLayers));
    return std::all_of(frame.depth.begin(), frame.depth.end(), [](float depth) { return depth == 12; });
  };
  CHECK(is_seen(12, 20));
  CHECK(is_seen(4, 12));
  CHECK_FALSE(is_seen(std::nextafter(12.0, 20.0), 20));
  CHECK_FALSE(is_seen(4, std::nextafter(12.0, 4.0)));
}

TEST_CASE("faults: the near and the far plane cut") {
  const Scene scene = hard("depth-format");
  Faults faults;
  faults.depth_format = DepthFormat::reversed;
  faults.near_plane = 12;
  faults.far_plane = 20;
  const Frame cut = rastered(scene, camera_of(scene), with(faults, kRasterLayers));
  std::size_t covered = 0;
  for (const float depth : cut.depth) {
    if (depth == 0) continue;
    ++covered;
    CHECK(depth >= 12);
    CHECK(depth <= 20);
  }
  CHECK(covered > 0);
}

TEST_CASE("faults: snapping moves nothing that is on the grid, and opens cracks elsewhere") {
  CHECK(snapping(square_scene(0), 0) == "");
  CHECK(snapping(square_scene(0.25), 2) == "");
  CHECK(snapping(square_scene(0.25), 1) != "");
  const Scene scene = hard("snap-bits");
  const Frame exact = rastered(scene, camera_of(scene));
  std::size_t before = exact.pixels();
  for (const int bits : {0, 3, 6}) {  // the finer the grid, the fewer
    Faults faults;
    faults.snap_bits = bits;
    const std::size_t wrong =
        wrong_surfaces(rastered(scene, camera_of(scene), with(faults, kRasterLayers)), exact);
    CHECK(wrong > 0);
    CHECK(wrong < before);
    before = wrong;
  }
}

TEST_CASE("faults: facets are four times nearer to the sphere with twice the segments") {
  // 1 - cos of half an angle: 4 but for terms of the order of the angle squared, here (2 pi / 32)² = 4 %.
  for (const int n : {32, 64, 128})
    CHECK(facet_depth(n) / facet_depth(2 * n) == doctest::Approx(4).epsilon(0.04));
}

TEST_CASE("faults: float decides wrongly far from the origin, in both renderers alike") {
  const Scene scene = hard("precision");
  Faults faults;
  faults.float_precision = true;
  const Frame flat = rastered(scene, camera_of(scene), with(faults, kRasterLayers));
  const Frame deep = traced(scene, camera_of(scene), with(faults, kRaytraceLayers));
  CHECK(wrong_surfaces(flat, rastered(scene, camera_of(scene))) > 0);
  CHECK(wrong_surfaces(deep, traced(scene, camera_of(scene))) > 0);
  CHECK(first_non_finite(flat) == "");
  CHECK(first_non_finite(deep) == "");
}

// A sheet hangs one above a floor, and a lamp above both: it hides the lamp from shadow rays that begin below it.
TEST_CASE("faults: shadow rays begin as far from the surface as they are told, in float, too") {
  const auto square = [](double y, double size) {
    return mesh_of({{-size, y, -size}, {size, y, -size}, {size, y, size}, {-size, y, size}},
                   {{0, 1, 2}, {0, 2, 3}});
  };
  Scene scene = scene_of(square(0, 4));
  add_mesh(scene, square(1, 0.5), {}, {});
  scene.lights = {lamp({0, 4, 0}, 1)};
  scene.camera.eye = {3, 0.5, 0.1};
  scene.camera.look_at = {0.1, 0, 0.1};
  scene.camera.view_height = 0.1;
  for (const bool in_float : {false, true})
    for (const double offset : {0.1, 0.99, 1.02, 3.0}) {
      CAPTURE(in_float);
      CAPTURE(offset);
      Faults faults;
      faults.shadow_offset = offset;
      faults.float_precision = in_float;
      const Frame frame = traced(scene, make_camera(scene.camera, 1, 1, 1), with(faults, kRaytraceLayers));
      CHECK((frame.layer(Layer::shadow)[0] == glm::vec3(0)) == (offset > 1.01));
    }
}

TEST_CASE("faults: threads and tiles change no bit of a faulty picture") {
  const Scene scene = hard("depth-format");
  Faults faults;
  faults.depth_format = DepthFormat::unorm16;
  faults.near_plane = 0.01;
  faults.far_plane = 1e4;
  faults.snap_bits = 2;
  faults.float_precision = true;
  RenderOptions one = with(faults, kRasterLayers), many = one;
  one.threads = 1;
  many.threads = 3;
  many.tile = 7;
  CHECK(differences(rastered(scene, camera_of(scene), many), rastered(scene, camera_of(scene), one)) == "");
}
