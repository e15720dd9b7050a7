// SPDX-License-Identifier: MIT
// The three promises of the README, on every shipped scene: one visibility, one local model, and a ledger in which
// every difference is booked. How large the pictures are says tests/tiers.txt; no scene and no check is ever left out.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "common/picture/compare.h"
#include "common/picture/image_io.h"
#include "common/scene/toml.h"
#include "tests/agreement/pictures.h"
#include "tests/picture/folder.h"

using namespace sidelight;
using namespace sidelight::testing;

namespace {

std::vector<std::string> all_scenes() {
  std::vector<std::string> files = shipped_scenes();
  files.push_back(kEverything);
  return files;
}

// For what depends on the renderers more than on the scene.
std::vector<std::string> two_scenes() { return {kEverything, SIDELIGHT_SOURCE_DIR "/scenes/showcase.toml"}; }

// Calls check(camera, what is rendered) for each size and number of samples of this tier.
template <class Check>
void for_each_camera(const std::string& file, const Scene& scene, const Check& check) {
  for (const std::string& size_text : test::tier_list("agreement_sizes"))
    for (const std::string& samples : test::tier_list("agreement_samples")) {
      const PictureSize size = parse_size(size_text);
      const Camera camera =
          make_camera(scene.camera, size.width, size.height, samples_per_edge(std::stoi(samples)));
      check(camera, short_name(file) + " at " + size_text + ", " + samples + " samples");
    }
}

// Small, odd in both directions, and not a multiple of any tile.
Camera small_camera(const Scene& scene, int n) { return make_camera(scene.camera, 67, 49, n); }

// What is written is what the frame holds: the file is decoded and compared channel by channel.
ImageFile through_file(const Frame& frame, const std::string& path) {
  write_exr(path, frame);
  return read_image(path);
}

template <class Channels>
void check_same_channels(const Channels& a, const Channels& b, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    CAPTURE(name);
    REQUIRE(a.contains(name));
    REQUIRE(b.contains(name));
    const auto &left = a.at(name), &right = b.at(name);
    REQUIRE(left.size() == right.size());
    CHECK(std::memcmp(left.data(), right.data(), left.size() * sizeof(left[0])) == 0);
  }
}

RenderOptions plainest() {
  RenderOptions options = keeping(kAllLayers);
  options.threads = 1;
  options.isa = Isa::scalar;
  return options;
}

// The bytes and the rays must be those of the plainest options.
void check_unchanged(const std::string& file, const std::vector<RenderOptions>& others) {
  CAPTURE(file);
  const Scene scene = load_scene(file);
  const Camera camera = small_camera(scene, 2);
  const Frame flat = rastered(scene, camera, plainest()), deep = traced(scene, camera, plainest());
  for (const RenderOptions& options : others) {
    const std::string_view isa = isa_name(options.isa);
    CAPTURE(isa);
    CAPTURE(options.threads);
    CAPTURE(options.tile);
    CHECK(differences(rastered(scene, camera, options), flat) == "");
    const Frame again = traced(scene, camera, options);
    CHECK(differences(again, deep) == "");
    CHECK(again.stats.rays.shadow == deep.stats.rays.shadow);
    CHECK(again.stats.rays.reflection == deep.stats.rays.reflection);
    CHECK(again.stats.rays.refraction == deep.stats.rays.refraction);
    CHECK(again.stats.self_shadowed == deep.stats.self_shadowed);
    CHECK(again.stats.cut_weight == deep.stats.cut_weight);
  }
}

}  // namespace

TEST_CASE("promises: one visibility and a ledger that explains every pixel on every scene") {
  for (const std::string& file : all_scenes()) {
    const Scene scene = load_scene(file);
    for_each_camera(file, scene, [&](const Camera& camera, const std::string& what) {
      CAPTURE(what);
      const Comparison result = compare(rastered(scene, camera), traced(scene, camera), scene.lights.size());
      MESSAGE(what << ": " << result.visibility_mismatches << " mismatches, " << result.unexplained
                   << " unexplained; explained by shadow " << result.shadow.pixels << ", reflection "
                   << result.reflection.pixels << ", refraction " << result.refraction.pixels << " pixels");
      CHECK_MESSAGE(result.visibility_mismatches == 0, "first at ", result.mismatch_x, ",",
                    result.mismatch_y);
      CHECK_MESSAGE(result.unexplained == 0, "first at ", result.unexplained_x, ",", result.unexplained_y);
      CHECK(result.covered > 0);  // an empty picture would keep any promise
    });
  }
}

TEST_CASE("promises: without shadows and mirrors and glass the two pictures are the same bytes") {
  for (const std::string& file : all_scenes()) {
    const Scene scene = local_only(load_scene(file));
    for_each_camera(file, scene, [&](const Camera& camera, const std::string& what) {
      CAPTURE(what);
      CHECK(differences(rastered(scene, camera), traced(scene, camera)) == "");
    });
  }
}

TEST_CASE("promises: so are the two EXR files when read back") {
  const TemporaryFolder folder;
  for (const std::string& file : all_scenes()) {
    CAPTURE(file);
    const Scene scene = local_only(load_scene(file));
    const Camera camera = small_camera(scene, 3);
    const ImageFile flat = through_file(rastered(scene, camera), folder / "raster.exr");
    const ImageFile deep = through_file(traced(scene, camera), folder / "raytrace.exr");
    CHECK(flat.width == camera.width);
    CHECK(flat.height == camera.height);
    check_same_channels(flat.channels, deep.channels,
                        {"R", "G", "B", "depth.Z", "normal.X", "normal.Y", "normal.Z"});
    check_same_channels(flat.ids, deep.ids, {"object.id", "primitive.id"});
  }
}

TEST_CASE("promises: the number of threads changes no bit") {
  std::vector<RenderOptions> others(2, plainest());
  others[0].threads = 2;
  others[1].threads = 3;
  for (const std::string& file : two_scenes()) check_unchanged(file, others);
}

TEST_CASE("promises: the size of a tile changes no bit") {
  std::vector<RenderOptions> others(4, plainest());
  others[0].tile = 1;
  others[1].tile = 8;
  others[2].tile = 64;
  others[3].tile = 1000;
  for (const std::string& file : two_scenes()) check_unchanged(file, others);
}

TEST_CASE("promises: the instruction set changes no bit") {
  std::vector<RenderOptions> others;
  for (const Isa isa : {Isa::avx2, Isa::avx512}) {
    if (!machine_has(isa)) continue;
    others.push_back(plainest());
    others.back().isa = isa;
  }
  if (others.empty()) return test::skip_test("this machine has the scalar instruction set only");
  MESSAGE("compared with scalar: " << others.size() << " instruction sets of this machine");
  for (const std::string& file : two_scenes()) check_unchanged(file, others);
}

// A crop must cast the rays of the whole picture, not those of a smaller one, and its tiles lie elsewhere.
TEST_CASE("promises: a crop is that part of the whole picture") {
  for (const std::string& file : two_scenes()) {
    CAPTURE(file);
    const Scene scene = load_scene(file);
    const Camera camera = small_camera(scene, 3);
    const RenderOptions whole = keeping(kAllLayers);
    const Frame flat = rastered(scene, camera, whole), deep = traced(scene, camera, whole);
    for (const Rect& crop : {Rect{5, 3, 42, 31}, Rect{66, 48, 67, 49}, Rect{0, 20, 67, 21}}) {
      RenderOptions options = whole;
      options.crop = crop;
      CHECK(differences(rastered(scene, camera, options), flat) == "");
      CHECK(differences(traced(scene, camera, options), deep) == "");
    }
  }
}
