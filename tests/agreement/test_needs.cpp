// SPDX-License-Identifier: MIT
// Needs are no knob: entering what a scene does not need changes no bit of either picture.
#include "common/scene/needs.h"

#include <doctest/doctest.h>

#include "common/scene/toml.h"
#include "tests/agreement/pictures.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("needs: a claim of what a scene does not need changes no bit") {
  const PictureSize size = parse_size(test::tier_list("agreement_sizes").front());
  std::vector<std::string> files = shipped_scenes();
  files.push_back(kEverything);
  std::array<int, kNeeds> claimed{};
  for (const std::string& file : files) {
    const Scene scene = load_scene(file);
    const Camera camera = make_camera(scene.camera, size.width, size.height, 1);
    const Frame raster_frame = rastered(scene, camera), trace_frame = traced(scene, camera);
    for (std::size_t i = 0; i < kNeeds; ++i) {
      Needs needs = needs_of(scene);
      if (needs.has[i]) continue;
      needs.has[i] = true;
      ++claimed[i];
      INFO(file, " claims ", kNeedNames[i]);
      CHECK(differences(raster_frame, raster::render(*raster::prepare_for(needs, scene), camera,
                                                     keeping(kRasterLayers))) == "");
      CHECK(differences(trace_frame, raytrace::render(*raytrace::prepare_for(needs, scene), camera,
                                                      keeping(kRaytraceLayers))) == "");
    }
  }
  for (const Need need : {Need::mirrors, Need::refraction, Need::overlapping_solids, Need::light_attenuation,
                          Need::secondary_attenuation})
    CHECK_MESSAGE(claimed[static_cast<std::size_t>(need)] > 0, kNeedNames[static_cast<std::size_t>(need)]);
}
