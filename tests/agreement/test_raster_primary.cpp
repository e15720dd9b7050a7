// SPDX-License-Identifier: MIT
// --primary raster: the ray tracer takes from the z-buffer what each sample shows, and paints the same picture in every
// bit. What it cannot take from there it refuses.
#include <doctest/doctest.h>

#include "common/error.h"
#include "common/scene/toml.h"
#include "tests/agreement/pictures.h"
#include "viewer/bench/stage.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// The same counts, too, but of eye rays, which there are none of.
void check_same(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  const auto finds = raster::prepare(scene);
  const auto traces = raytrace::prepare(scene);
  const Frame by_rays = raytrace::render(*traces, camera, options);
  const Frame from_raster = render_from_raster(*finds, *traces, camera, options);
  CHECK(differences(from_raster, by_rays) == "");
  const RenderStats &ours = from_raster.stats, &theirs = by_rays.stats;
  CHECK(ours.rays.primary == 0);
  CHECK(ours.rays.shadow == theirs.rays.shadow);
  CHECK(ours.rays.reflection == theirs.rays.reflection);
  CHECK(ours.rays.refraction == theirs.rays.refraction);
  CHECK(ours.self_shadowed == theirs.self_shadowed);
  CHECK(ours.cut_weight == theirs.cut_weight);
}

}  // namespace

TEST_CASE("promises: the tracer's picture is the same where the z-buffer finds what samples show") {
  std::vector<std::string> files = shipped_scenes();
  for (const std::string& file : hard_scene_files()) files.push_back(file);
  files.push_back(kEverything);
  for (const std::string& file : files) {
    CAPTURE(short_name(file));
    const Scene scene = load_scene(file);
    for (const int n : {1, 2}) {
      CAPTURE(n);
      RenderOptions options = keeping(kRaytraceLayers);
      check_same(scene, make_camera(scene.camera, 83, 61, n), options);
      options.crop = {11, 5, 48, 42};
      options.isa = Isa::scalar;
      options.tile = 7;
      options.layers = 0;
      options.keep_samples = false;
      check_same(scene, make_camera(scene.camera, 83, 61, n), options);
    }
  }
}

TEST_CASE("promises: what only eye rays have, no z-buffer stands in for") {
  const Scene scene = load_scene(kEverything);
  const auto finds = raster::prepare(scene);
  const auto traces = raytrace::prepare(scene);
  const Camera camera = make_camera(scene.camera, 8, 6, 1);
  RenderOptions options;
  options.layers = layer_bit(Layer::cost);
  CHECK_THROWS_AS(render_from_raster(*finds, *traces, camera, options), UsageError);
  options.layers = 0;
  options.faults.shadow_offset = 0.1;
  CHECK_THROWS_AS(render_from_raster(*finds, *traces, camera, options), UsageError);
}
