// SPDX-License-Identifier: MIT
// The pictures of scenes/README.md are what scenes/make_pictures.sh makes now, pixel by pixel. After a change of a
// scene or of what is seen, run the script, look at what it made, and commit it.
#include <filesystem>

#include "common/picture/image_io.h"
#include "tests/tier.h"
#include "tests/viewer/program.h"

using namespace sidelight;
using namespace sidelight::testing;
namespace fs = std::filesystem;

namespace {

const std::string kStored = SIDELIGHT_SOURCE_DIR "/scenes/pictures";

std::vector<std::string> scene_names() {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(SIDELIGHT_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".toml") out.push_back(entry.path().stem().string());
  std::sort(out.begin(), out.end());
  return out;
}

// Stored pictures that the script makes for the scene.
std::vector<std::string> stored_pictures(const std::string& scene) {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(kStored))
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

}  // namespace

TEST_CASE("walk: the pictures are what the program makes") {
  std::vector<std::string> scenes = test::tier_list("walk_pictures");
  if (scenes == std::vector<std::string>{"all"}) scenes = scene_names();
  REQUIRE_FALSE(scenes.empty());

  const Workplace here;
  const Arguments script{SIDELIGHT_SOURCE_DIR "/scenes/make_pictures.sh", "--program", SIDELIGHT_BINARY, "-o",
                         "made"};
  const Outcome outcome = here.command(script + scenes);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);

  std::vector<std::string> expected;
  for (const std::string& scene : scenes) {
    const std::vector<std::string> pictures = stored_pictures(scene);
    CAPTURE(scene);
    CHECK(pictures.size() >= 2);
    expected.insert(expected.end(), pictures.begin(), pictures.end());
  }
  std::sort(expected.begin(), expected.end());
  REQUIRE(here.names("made") == expected);
  for (const std::string& name : expected) {
    CAPTURE(name);
    check_same_pixels(here / ("made/" + name), kStored + "/" + name);
  }
}

TEST_CASE("walk: the pictures are those of the scenes, and small") {
  std::size_t of_scenes = 0;
  for (const std::string& scene : scene_names()) of_scenes += stored_pictures(scene).size();
  std::size_t files = 0;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(kStored)) {
    ++files;
    bytes += entry.file_size();
  }
  CHECK(files == of_scenes);
  CHECK(bytes < 1'500'000);
}

TEST_CASE("walk: the script refuses what it does not know") {
  const Workplace here;
  const std::string script = SIDELIGHT_SOURCE_DIR "/scenes/make_pictures.sh";
  CHECK(here.command({script, "--frobnicate"}).code == 2);
  CHECK(here.command({script, "--program", SIDELIGHT_BINARY, "-o", "made", "99-no-such-scene"}).code == 3);
  CHECK(here.names("made").empty());
}
