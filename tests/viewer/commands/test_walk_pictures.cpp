// SPDX-License-Identifier: MIT
// The pictures of scenes/README.md and of tests/hardcases/README.md are what their scripts make now, pixel by pixel.
// After a change of a scene or of what is seen, run the script, look at what it made, and commit it.
#include <filesystem>

#include "common/picture/image_io.h"
#include "tests/support/program.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
namespace fs = std::filesystem;

namespace {

// A page's scenes, the script that makes its pictures, and where they are kept; all relative to the project's folder.
struct Gallery {
  std::string scenes, script, stored;
  std::size_t least;  // pictures of a scene
};
const Gallery kWalk{"scenes", "scenes/make_pictures.sh", "scenes/pictures", 2};
const Gallery kHard{"scenes/hard", "tests/hardcases/make_pictures.sh", "tests/hardcases/pictures", 1};

std::string in_source(const std::string& path) { return SIDELIGHT_SOURCE_DIR "/" + path; }

std::vector<std::string> scene_names(const Gallery& gallery) {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(in_source(gallery.scenes)))
    if (entry.path().extension() == ".toml") out.push_back(entry.path().stem().string());
  std::sort(out.begin(), out.end());
  return out;
}

// Stored pictures that the script makes for the scene.
std::vector<std::string> stored_pictures(const Gallery& gallery, const std::string& scene) {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(in_source(gallery.stored)))
    if (entry.path().filename().string().rfind(scene + "-", 0) == 0)
      out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

void check_same_pixels(const std::string& made, const std::string& stored) {
  const ImageFile a = read_image(made), b = read_image(stored);
  CHECK(a.width == b.width);
  CHECK(a.height == b.height);
  CHECK(a.channels == b.channels);
}

// Those of `scenes`; "all" stands for every one.
void check_made_anew(const Gallery& gallery, std::vector<std::string> scenes) {
  if (scenes == std::vector<std::string>{"all"}) scenes = scene_names(gallery);
  REQUIRE_FALSE(scenes.empty());

  const Workplace here;
  const Arguments script{in_source(gallery.script), "--program", SIDELIGHT_BINARY, "-o", "made"};
  const Outcome outcome = here.command(script + scenes);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);

  std::vector<std::string> expected;
  for (const std::string& scene : scenes) {
    const std::vector<std::string> pictures = stored_pictures(gallery, scene);
    CAPTURE(scene);
    CHECK(pictures.size() >= gallery.least);
    expected.insert(expected.end(), pictures.begin(), pictures.end());
  }
  std::sort(expected.begin(), expected.end());
  REQUIRE(here.names("made") == expected);
  for (const std::string& name : expected) {
    CAPTURE(name);
    check_same_pixels(here / ("made/" + name), in_source(gallery.stored + "/" + name));
  }
}

// Each belongs to a scene, and they are `most` bytes together at most, `largest` each.
void check_files(const Gallery& gallery, std::uintmax_t most, std::uintmax_t largest) {
  std::size_t of_scenes = 0;
  for (const std::string& scene : scene_names(gallery)) of_scenes += stored_pictures(gallery, scene).size();
  std::size_t files = 0;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(in_source(gallery.stored))) {
    ++files;
    bytes += entry.file_size();
    CHECK(entry.file_size() <= largest);
  }
  CHECK(files == of_scenes);
  CHECK(bytes < most);
}

void check_refuses(const Gallery& gallery) {
  const Workplace here;
  const std::string script = in_source(gallery.script);
  CHECK(here.command({script, "--frobnicate"}).code == 2);
  CHECK(here.command({script, "--program", SIDELIGHT_BINARY, "-o", "made", "99-no-such-scene"}).code == 3);
  CHECK(here.names("made").empty());
}

}  // namespace

TEST_CASE("walk: the pictures are what the program makes") {
  check_made_anew(kWalk, test::tier_list("walk_pictures"));
}
TEST_CASE("hard cases: the pictures are what the program makes") {
  check_made_anew(kHard, test::tier_list("hard_pictures"));
}

// The page says so: a flask whose water touches the glass, left of the middle, and one with overlapping water, right.
TEST_CASE("hard cases: the touching flask is the mirror image of the overlapping one") {
  const ImageFile a = read_image(in_source(kHard.stored + "/touching-glass-right.png")),
                  b = read_image(in_source(kHard.stored + "/touching-glass-right-too.png"));
  REQUIRE(a.width == b.width);
  REQUIRE(a.height == b.height);
  std::vector<glm::vec3> mirrored = colors(b);
  for (auto row = mirrored.begin(); row != mirrored.end(); row += b.width) std::reverse(row, row + b.width);
  CHECK(colors(a) == mirrored);
}

TEST_CASE("walk: the pictures are those of the scenes, and small") { check_files(kWalk, 1'500'000, 60'000); }
TEST_CASE("hard cases: the pictures are those of the scenes, and small") {
  check_files(kHard, 400'000, 60'000);
}

TEST_CASE("walk: the script refuses what it does not know") { check_refuses(kWalk); }
TEST_CASE("hard cases: the script refuses what it does not know") { check_refuses(kHard); }
