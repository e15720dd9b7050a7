// SPDX-License-Identifier: MIT
// The fast renderers against the references, which share with them scene, camera and visibility only.
//
// Ids and depths must be the same bits. Colours are float in one and double in the other, and must agree to
// 1e-5 max(1, value); the local layers in every pixel. A shadow, mirrored or refracted ray, however, may meet an edge:
// then the last bit of a direction decides what it sees. A pixel that differs is excused only where the reference
// itself jumps by at least half as much when its eye moves by a hair; each is named, and there may be few of them.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/scene/toml.h"
#include "tests/agreement/pictures.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr std::array kLocalLayers{Layer::ambient, Layer::diffuse, Layer::specular};
constexpr std::array kSecondaryLayers{Layer::shadow, Layer::reflection, Layer::refraction};

float largest(const glm::vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
bool close(const glm::vec3& a, const glm::vec3& b) {
  for (int c = 0; c < 3; ++c)
    if (!(std::abs(a[c] - b[c]) <= 1e-5f * std::max(1.0f, std::abs(b[c]))))
      return false;  // so NaN is not close
  return true;
}

// The size at which the references can be waited for.
PictureSize reference_size(const Scene& scene) {
  const bool many = scene.primitive_object.size() > 2000;
  return parse_size(test::tier_value(many ? "reference_size_many" : "reference_size"));
}

void check_visibility(const Frame& fast, const Frame& slow) {
  CHECK(fast.sample_primitive == slow.sample_primitive);
  CHECK(fast.object_id == slow.object_id);
  CHECK(fast.primitive_id == slow.primitive_id);
  CHECK(std::memcmp(fast.sample_depth.data(), slow.sample_depth.data(),
                    slow.sample_depth.size() * sizeof(double)) == 0);
  CHECK(std::memcmp(fast.depth.data(), slow.depth.data(), slow.depth.size() * sizeof(float)) == 0);
}

// Calls visit(index, x, y) for each pixel in which the two arrays are not close.
template <class Visit>
void for_each_stray(const Frame& frame, std::span<const glm::vec3> fast, std::span<const glm::vec3> slow,
                    const Visit& visit) {
  REQUIRE(fast.size() == slow.size());
  for (int y = frame.window.y0; y < frame.window.y1; ++y)
    for (int x = frame.window.x0; x < frame.window.x1; ++x)
      if (const std::size_t i = frame.index(x, y); !close(fast[i], slow[i])) visit(i, x, y);
}

void check_close(const char* name, const Frame& frame, std::span<const glm::vec3> fast,
                 std::span<const glm::vec3> slow) {
  for_each_stray(frame, fast, slow, [&](std::size_t i, int x, int y) {
    FAIL_CHECK(name << " at pixel " << x << "," << y << ": fast " << text(fast[i]) << ", reference "
                    << text(slow[i]));
  });
}

void check_local_layers(const Frame& fast, const Frame& slow) {
  for (const Layer layer : kLocalLayers)
    check_close(kLayerNames[static_cast<std::size_t>(layer)].data(), fast, fast.layer(layer),
                slow.layer(layer));
  check_close("normal", fast, fast.normal, slow.normal);
}

// How far the reference's layer moves in one pixel when the eye moves by `step` in four directions.
float jump_of_reference(const Scene& scene, const Camera& camera, int x, int y, Layer layer,
                        const glm::vec3& here, double step) {
  RenderOptions options = keeping(kRaytraceLayers);
  options.threads = 1;
  options.crop = {x, y, x + 1, y + 1};
  float jump = 0;
  for (const glm::dvec3& way : {camera.right, -camera.right, camera.up, -camera.up}) {
    Camera moved = camera;
    moved.eye += step / glm::length(way) * way;
    const Frame frame = raytrace::render_reference(scene, moved, options);
    jump = std::max(jump, largest(frame.layer(layer)[0] - here));
  }
  return jump;
}

// Why the two tracers differ in a pixel's layer; empty if there is no excuse. Secondary rays are double in both, so
// what parts them is some ulps of double, a hair of 1e-12; only whether N.L, Nv.L and Rl.V are positive is float.
std::string excuse(const Scene& scene, const Camera& camera, int x, int y, Layer layer, const glm::vec3& fast,
                   const glm::vec3& slow) {
  const double distance = glm::length(scene.camera.look_at - scene.camera.eye);
  const float enough = largest(fast - slow) / 2;
  const std::string ray = layer == Layer::shadow       ? "a shadow ray"
                          : layer == Layer::reflection ? "a mirrored ray"
                                                       : "a refracted ray";
  if (jump_of_reference(scene, camera, x, y, layer, slow, 1e-12 * distance) >= enough)
    return ray + ", or one behind it, meets an edge";
  if (jump_of_reference(scene, camera, x, y, layer, slow, 1e-6 * distance) >= enough)
    return ray + " leaves or ends where a light turns away";
  return "";
}

// Colours and ledger layers. Returns the number of pixels that differ with an excuse.
std::size_t check_traced_colors(const Scene& scene, const Camera& camera, const Frame& fast,
                                const Frame& slow) {
  std::vector<bool> excused(fast.pixels());
  std::size_t strays = 0;
  for (const Layer layer : kSecondaryLayers)
    for_each_stray(fast, fast.layer(layer), slow.layer(layer), [&](std::size_t i, int x, int y) {
      const glm::vec3 &a = fast.layer(layer)[i], &b = slow.layer(layer)[i];
      const std::string why = excuse(scene, camera, x, y, layer, a, b);
      const std::string_view name = kLayerNames[static_cast<std::size_t>(layer)];
      const std::string what = std::string(name) + " at pixel " + std::to_string(x) + "," +
                               std::to_string(y) + ": fast " + text(a) + ", reference " + text(b);
      if (why.empty()) {
        FAIL_CHECK(what << ", and no edge near");
      } else {
        MESSAGE(what << ": " << why);
      }
      strays += excused[i] ? 0 : 1;
      excused[i] = true;
    });
  for_each_stray(fast, fast.color, slow.color, [&](std::size_t i, int x, int y) {
    CHECK_MESSAGE(excused[i], "colour at pixel ", x, ",", y, ": fast ", text(fast.color[i]), ", reference ",
                  text(slow.color[i]), ", though every layer agrees");
  });
  CHECK(static_cast<double>(strays) <= std::max(3.0, 1e-4 * static_cast<double>(fast.pixels())));
  return strays;
}

// Both tracers send the same rays. A light whose term is zero is not asked for, and a narrow highlight falls below the
// range of float (1e-38) long before that of double, so the fast one may ask less often; with s = 1 it may not.
void check_counts(const Scene& scene, const Camera& camera, const RenderStats& fast,
                  const RenderStats& slow) {
  CHECK(fast.rays.primary == slow.rays.primary);
  CHECK(fast.rays.reflection == slow.rays.reflection);
  CHECK(fast.rays.refraction == slow.rays.refraction);
  CHECK(fast.rays.shadow <= slow.rays.shadow);
  CHECK(fast.self_shadowed <= slow.self_shadowed);
  if (fast.rays.shadow == slow.rays.shadow && fast.self_shadowed == slow.self_shadowed) return;
  Scene broad = scene;
  for (Material& material : broad.materials) material.shininess = 1;
  const RenderStats ours = traced(broad, camera, {}).stats;
  const RenderStats theirs = raytrace::render_reference(broad, camera, {}).stats;
  CHECK(ours.rays.shadow == theirs.rays.shadow);
  CHECK(ours.self_shadowed == theirs.self_shadowed);
}

void check_rastered(const Scene& scene, const Camera& camera) {
  const Frame fast = rastered(scene, camera);
  const Frame slow = raster::render_reference(scene, camera, keeping(kRasterLayers));
  check_visibility(fast, slow);
  check_local_layers(fast, slow);
  check_close("colour", fast, fast.color, slow.color);
}

void check_traced(const Scene& scene, const Camera& camera) {
  const Frame fast = traced(scene, camera);
  const Frame slow = raytrace::render_reference(scene, camera, keeping(kRaytraceLayers));
  check_visibility(fast, slow);
  check_local_layers(fast, slow);
  const std::size_t strays = check_traced_colors(scene, camera, fast, slow);
  // A ray that parts from its twin may have others behind it, or not.
  if (strays == 0) check_counts(scene, camera, fast.stats, slow.stats);
  MESSAGE(strays << " pixels excused; " << slow.stats.rays.shadow << " shadow, " << slow.stats.rays.reflection
                 << " mirrored, " << slow.stats.rays.refraction << " refracted rays");
}

void check_scene(const std::string& file, const PictureSize& size) {
  const std::string what = short_name(file) + " at " + size.text();
  CAPTURE(what);
  const Scene scene = load_scene(file);
  const Camera camera = make_camera(scene.camera, size.width, size.height, 1);
  check_rastered(scene, camera);
  check_traced(scene, camera);
}

}  // namespace

TEST_CASE("references: the scene with everything in it") { check_scene(kEverything, {64, 48}); }

// Who excuses must be watched, too. A card above the floor ends at x = 0 and the light falls straight down, so its shadow
// ends exactly where the middle column of an odd picture looks.
TEST_CASE("references: a pixel is excused at the edge of a shadow and not beside it") {
  const Scene scene = parse_scene(
      "camera = { eye = [0, 0.5, 4], look_at = [0, 0, 0], view_height = 0.1 }\n"
      "light = [{ direction = [0, -1, 0], intensity = 1 }]\n"
      "material.white = { diffuse = 1 }\n"
      "plane = [{ point = [0, 0, 0], normal = [0, 1, 0], material = 'white' }]\n"
      "mesh = [{ vertices = [[0, 1, -9], [9, 1, -9], [9, 1, 2], [0, 1, 2]], faces = [[0, 1, 2, 3]], material "
      "= 'white' }]\n",
      "edge.toml");
  const Camera camera = make_camera(scene.camera, 15, 15, 1);
  const auto excuse_at = [&](int x) {
    RenderOptions options = keeping(kRaytraceLayers);
    options.crop = {x, 7, x + 1, 8};
    const glm::vec3 shadow = raytrace::render_reference(scene, camera, options).layer(Layer::shadow)[0];
    return excuse(scene, camera, x, 7, Layer::shadow, glm::vec3(1) - shadow, shadow);  // the other answer
  };
  CHECK(excuse_at(7) != "");
  CHECK(excuse_at(6) == "");
  CHECK(excuse_at(8) == "");
}

TEST_CASE("references: every shipped scene") {
  for (const std::string& file : shipped_scenes()) check_scene(file, reference_size(load_scene(file)));
}
