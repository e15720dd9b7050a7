// SPDX-License-Identifier: MIT
// Stored pictures: nothing that is seen may change unnoticed. Each scene below, by both renderers, at 80x60 with four
// samples a pixel, is compared with the linear EXR beside this file.
//
// The tolerance: every correct renderer is within 1e-5 max(1, value) of the reference in all but a few pixels, where a
// secondary ray meets an edge (agreement/test_references.cpp). Two correct ones are then within twice that of each
// other. So a faster kernel passes, and anything that an eye could see does not.
//
// SIDELIGHT_BLESS=1 (tests/run.sh --bless) makes what is rendered now the stored picture, and says what it rewrote:
// look at it before you commit it. A failure leaves the actual picture and the difference in the build folder.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <glm/common.hpp>
#include <span>

#include "common/picture/image_io.h"
#include "common/picture/tolerance.h"
#include "common/scene/toml.h"
#include "tests/agreement/pictures.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr Tolerance kTolerance{.fail = 2e-5, .allow = 3};  // times max(1, value); pixels
const std::string kFailures = SIDELIGHT_BUILD_DIR "/image_failures";

bool blessing() {
  const char* bless = std::getenv("SIDELIGHT_BLESS");
  return bless && std::string(bless) == "1";
}

// Per pixel the greatest channel of |actual - stored| / max(1, |stored|). (Dividing in float adds a relative 2^-23.)
std::vector<double> relative_differences(KeptArray<glm::vec3> actual, std::vector<glm::vec3> stored) {
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const glm::vec3 scale = glm::max(glm::vec3(1), glm::abs(stored[i]));
    actual[i] /= scale;
    stored[i] /= scale;
  }
  return pixel_differences(actual, stored);
}

void bless(const std::string& path, const Frame& actual) {
  if (std::filesystem::exists(path) && std::ranges::equal(colors(read_image(path)), actual.color)) return;
  write_exr(path, actual);
  MESSAGE("blessed " << path);
}

void write_failure(const std::string& name, const Frame& actual, std::span<const glm::vec3> stored) {
  std::filesystem::create_directories(kFailures);
  write_exr(kFailures + "/" + name + "_actual.exr", actual);
  Frame difference = actual;
  for (std::size_t i = 0; i < stored.size(); ++i) difference.color[i] = glm::abs(actual.color[i] - stored[i]);
  write_exr(kFailures + "/" + name + "_difference.exr", difference);
}

void check_picture(const std::string& name, const Frame& actual) {
  CAPTURE(name);
  const std::string path = SIDELIGHT_SOURCE_DIR "/tests/images/" + name + ".exr";
  if (blessing()) bless(path, actual);
  const ImageFile file = read_image(path);
  REQUIRE(file.width == actual.width());
  REQUIRE(file.height == actual.height());
  const std::vector<glm::vec3> stored = colors(file);

  const std::vector<double> differences = relative_differences(actual.color, stored);
  const Excess excess = count_excess(differences, kTolerance);
  if (excess.within(kTolerance)) return;
  write_failure(name, actual, stored);
  const std::size_t worst = worst_pixels(differences, file.width, kTolerance.fail, 1, 1).front();
  const auto width = static_cast<std::size_t>(file.width);
  FAIL_CHECK(excess.over << " pixels differ; the worst is " << worst % width << "," << worst / width << ": "
                         << text(actual.color[worst]) << ", stored " << text(stored[worst]) << "; see "
                         << kFailures << "/" << name << "_difference.exr");
}

void check_scene(const std::string& name) {
  const Scene scene = load_scene(SIDELIGHT_SOURCE_DIR "/scenes/" + name + ".toml");
  const Camera camera = make_camera(scene.camera, 80, 60, 2);
  check_picture(name + "_raster", rastered(scene, camera, {}));
  check_picture(name + "_raytrace", traced(scene, camera, {}));
}

}  // namespace

TEST_CASE("images: stored pictures of eight scenes") {
  for (const char* name : {"03-specular", "04-many-lights", "06-shadows", "07-mirrors", "08-refraction",
                           "09-total-internal-reflection", "10-nested-glass", "showcase"})
    check_scene(name);
}
