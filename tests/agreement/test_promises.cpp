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
#include "tests/hardcases/result.h"
#include "tests/picture/folder.h"

using namespace sidelight;
using namespace sidelight::test;
using test::HardCase;

namespace {

std::vector<std::string> all_scenes() {
  std::vector<std::string> files = shipped_scenes();
  files.push_back(kEverything);
  for (const std::string& hard : hard_scene_files()) files.push_back(hard);
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

// The bytes and the rays must be those of the plainest options. Returns how many pictures' bytes are not.
std::uint64_t check_unchanged(const std::string& file, const std::vector<RenderOptions>& others) {
  std::uint64_t unlike = 0;
  CAPTURE(file);
  const Scene scene = load_scene(file);
  const Camera camera = small_camera(scene, 2);
  const Frame flat = rastered(scene, camera, plainest()), deep = traced(scene, camera, plainest());
  for (const RenderOptions& options : others) {
    const std::string_view isa = isa_name(options.isa);
    CAPTURE(isa);
    CAPTURE(options.threads);
    CAPTURE(options.tile);
    const std::string in_flat = differences(rastered(scene, camera, options), flat);
    CHECK(in_flat == "");
    RenderOptions in_waves = options;  // what a pixel costs only the recursion tells
    in_waves.layers &= ~layer_bit(Layer::cost);
    const Frame again = traced(scene, camera, in_waves);
    const std::string in_deep = differences(again, deep) + differences(traced(scene, camera, options), deep);
    CHECK(in_deep == "");
    unlike += !in_flat.empty() + !in_deep.empty();
    CHECK(again.stats.rays.shadow == deep.stats.rays.shadow);
    CHECK(again.stats.rays.reflection == deep.stats.rays.reflection);
    CHECK(again.stats.rays.refraction == deep.stats.rays.refraction);
    CHECK(again.stats.self_shadowed == deep.stats.self_shadowed);
    CHECK(again.stats.cut_weight == deep.stats.cut_weight);
  }
  return unlike;
}
// On two scenes; the pictures are judged as the hard case `id`.
void check_unchanged_as(const std::string& id, const std::string& what,
                        const std::vector<RenderOptions>& others) {
  std::uint64_t unlike = 0;
  for (const std::string& file : two_scenes()) unlike += check_unchanged(file, others);
  HardCase(id).none(what + ": pictures with another bit", unlike, 2 * others.size() * two_scenes().size());
}

}  // namespace

TEST_CASE("promises: one visibility and a ledger that explains every pixel on every scene") {
  std::uint64_t samples = 0, mismatches = 0;
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
      samples += static_cast<std::uint64_t>(camera.columns()) * static_cast<std::uint64_t>(camera.rows());
      mismatches += result.visibility_mismatches;
    });
  }
  HardCase("RVR-1").none("every scene: samples whose object, primitive or depth differ", mismatches, samples);
}

TEST_CASE("promises: without shadows and mirrors and glass the two pictures are the same bytes") {
  std::uint64_t pictures = 0, unlike = 0;
  for (const std::string& file : all_scenes()) {
    const Scene scene = local_only(load_scene(file));
    for_each_camera(file, scene, [&](const Camera& camera, const std::string& what) {
      CAPTURE(what);
      const std::string different = differences(rastered(scene, camera), traced(scene, camera));
      CHECK(different == "");
      ++pictures;
      unlike += !different.empty();
    });
  }
  HardCase("RVR-3").none("every scene: local pictures that differ in any bit", unlike, pictures);
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
  check_unchanged_as("DET-1", "1 to 3 threads", others);
}

TEST_CASE("promises: the size of a tile changes no bit") {
  std::vector<RenderOptions> others(4, plainest());
  others[0].tile = 1;
  others[1].tile = 8;
  others[2].tile = 64;
  others[3].tile = 1000;
  check_unchanged_as("RVR-1", "tiles of 1 to 1000 pixels", others);
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
  check_unchanged_as("DET-2", "instruction sets", others);
}

// A crop must cast the rays of the whole picture, not those of a smaller one, and its tiles lie elsewhere.
TEST_CASE("promises: a crop is that part of the whole picture") {
  std::uint64_t crops = 0, unlike = 0;
  for (const std::string& file : two_scenes()) {
    CAPTURE(file);
    const Scene scene = load_scene(file);
    const Camera camera = small_camera(scene, 3);
    const RenderOptions whole = keeping(kAllLayers);
    const Frame flat = rastered(scene, camera, whole), deep = traced(scene, camera, whole);
    for (const Rect& crop : {Rect{5, 3, 42, 31}, Rect{66, 48, 67, 49}, Rect{0, 20, 67, 21}}) {
      RenderOptions options = whole;
      options.crop = crop;
      const std::string in_flat = differences(rastered(scene, camera, options), flat);
      const std::string in_deep = differences(traced(scene, camera, options), deep);
      CHECK(in_flat == "");
      CHECK(in_deep == "");
      crops += 2;
      unlike += !in_flat.empty() + !in_deep.empty();
    }
  }
  HardCase("MET-14").none("crops that are not that part of the picture", unlike, crops);
}
