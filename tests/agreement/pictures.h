// SPDX-License-Identifier: MIT
// What the tests of agreement share: the shipped scenes, both pictures of one, and the question "the same bytes?"
// answered with the name of what differs.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "common/picture/frame.h"
#include "common/scene/camera.h"
#include "common/scene/scene.h"
#include "raster/raster.h"
#include "raytrace/raytrace.h"
#include "tests/tier.h"

namespace sidelight::test {

// All scene files that are shipped, in order of name. A folder without any is a failure, not a quick success.
inline std::vector<std::string> shipped_scenes() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(SIDELIGHT_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  REQUIRE_MESSAGE(!files.empty(), "no scene in " SIDELIGHT_SOURCE_DIR "/scenes");
  return files;
}

// Those in which a fault on purpose shows; without it they keep every promise.
inline std::vector<std::string> hard_scene_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(SIDELIGHT_SOURCE_DIR "/scenes/hard"))
    files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  REQUIRE(!files.empty());
  return files;
}

// A small scene in which every rule of the model matters somewhere, and with it every fault.
inline const std::string kEverything = SIDELIGHT_SOURCE_DIR "/tests/agreement/everything.toml";

struct PictureSize {
  int width = 0, height = 0;
  std::string text() const { return std::to_string(width) + "x" + std::to_string(height); }
};

// "160x120", as tests/tiers.txt writes it.
inline PictureSize parse_size(const std::string& text) {
  PictureSize size;
  const char* const end = text.data() + text.size();
  const auto [cross, width_error] = std::from_chars(text.data(), end, size.width);
  REQUIRE_MESSAGE((width_error == std::errc() && cross != end && *cross == 'x'),
                  "size in tests/tiers.txt: ", text);
  const auto [rest, height_error] = std::from_chars(cross + 1, end, size.height);
  REQUIRE_MESSAGE((height_error == std::errc() && rest == end), "size in tests/tiers.txt: ", text);
  return size;
}

// As `--local` does: no light is blocked, no ray is mirrored or refracted.
inline Scene local_only(Scene scene) {
  scene.trace.shadows = scene.trace.reflection = scene.trace.refraction = false;
  return scene;
}

inline RenderOptions keeping(LayerMask layers) {
  RenderOptions options;
  options.layers = layers;
  options.keep_samples = true;
  return options;
}

// Calls visit(name, array of a, array of b, entries per pixel) for every array of a frame.
template <class Visit>
void for_each_array(const Frame& a, const Frame& b, const Visit& visit) {
  const auto samples = static_cast<std::size_t>(a.n) * static_cast<std::size_t>(a.n);
  visit("colour", a.color, b.color, 1);
  for (std::size_t l = 0; l < a.rgb.size(); ++l) visit(std::string(kLayerNames[l]), a.rgb[l], b.rgb[l], 1);
  visit("depth", a.depth, b.depth, 1);
  visit("object", a.object_id, b.object_id, 1);
  visit("primitive", a.primitive_id, b.primitive_id, 1);
  visit("normal", a.normal, b.normal, 1);
  visit("cost", a.cost, b.cost, 1);
  visit("primitives of samples", a.sample_primitive, b.sample_primitive, samples);
  visit("depths of samples", a.sample_depth, b.sample_depth, samples);
}

// The names of the arrays in which `part` differs in any bit from the same pixels of `whole`, each with the first
// pixel that does; empty where all are the same. `part` is `whole` or a crop of it. Arrays that only one frame holds
// (the z-buffer has no shadow layer) are left out.
inline std::string differences(const Frame& part, const Frame& whole) {
  std::string out;
  if (part.n != whole.n) out = "number of samples; ";
  const auto width = static_cast<std::size_t>(part.width());
  for_each_array(
      part, whole, [&](const std::string& name, const auto& a, const auto& b, std::size_t per_pixel) {
        if (a.empty() || b.empty()) return;
        const std::size_t bytes = per_pixel * sizeof(a[0]);
        const auto same = [&](std::size_t in_part, std::size_t in_whole, std::size_t pixels) {
          return std::memcmp(&a[in_part * per_pixel], &b[in_whole * per_pixel], pixels * bytes) == 0;
        };
        for (int y = part.window.y0; y < part.window.y1; ++y) {
          const std::size_t from = part.index(part.window.x0, y), in_whole = whole.index(part.window.x0, y);
          if (same(from, in_whole, width)) continue;
          std::size_t x = 0;
          while (same(from + x, in_whole + x, 1)) ++x;
          out += name + " at pixel " + std::to_string(part.window.x0 + static_cast<int>(x)) + "," +
                 std::to_string(y) + "; ";
          return;
        }
      });
  return out;
}

// A square picture of one ray a pixel.
inline Camera square_camera(const Scene& scene, int edge = tier_edge()) {
  return make_camera(scene.camera, edge, edge, 1);
}

// With every instruction set that this machine has, which must give the same bytes: so each hard case that is drawn holds
// for all of them.
inline Frame rastered(const Scene& scene, const Camera& camera,
                      RenderOptions options = keeping(kRasterLayers)) {
  const auto prepared = raster::prepare(scene);
  Frame first = raster::render(*prepared, camera, options);
  const Isa given = options.isa;
  for (const Isa isa : kIsas) {
    if (isa == given || !machine_has(isa)) continue;
    options.isa = isa;
    const std::string other = differences(raster::render(*prepared, camera, options), first);
    REQUIRE_MESSAGE(other.empty(), "--isa ", isa_name(isa), " gives another ", other);
  }
  return first;
}
// By the waves, and again by the recursion, their readable twin, which must give the same bytes. Layer cost only the
// recursion writes, so that with it both would be the same call.
inline Frame traced(const Scene& scene, const Camera& camera,
                    const RenderOptions& options = keeping(kRaytraceLayers)) {
  const auto prepared = raytrace::prepare(scene);
  Frame frame = raytrace::render(*prepared, camera, options);
  if (options.layers & layer_bit(Layer::cost)) return frame;
  const std::string twin = differences(raytrace::render_recursively(*prepared, camera, options), frame);
  REQUIRE_MESSAGE(twin.empty(), "the recursion gives another ", twin);
  return frame;
}

// For messages: nine digits tell any two floats apart.
inline std::string text(const glm::vec3& v) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "(%.9g, %.9g, %.9g)", double{v.x}, double{v.y}, double{v.z});
  return buffer.data();
}
// The file's own name, for messages.
inline std::string short_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace sidelight::test
