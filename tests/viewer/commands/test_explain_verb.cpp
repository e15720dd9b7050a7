// SPDX-License-Identifier: MIT
// The verb explain, from outside: its colours are those of the picture's file in every bit, for all samples of a pixel
// and for one.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "common/picture/image_io.h"
#include "tests/support/program.h"
#include "viewer/report/shell_word.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

using Json = nlohmann::json;

glm::vec3 color(const Json& json) {
  return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

Json explained(const Workplace& here, const Arguments& more) {
  const Outcome outcome = here.run(Arguments{"explain", "good.toml", "-r", "64x48", "--json", "-"} + more);
  REQUIRE(outcome.code == 0);
  return Json::parse(outcome.out);
}

// The one pixel, as `render` writes it.
glm::vec3 rendered(const Workplace& here, const std::string& renderer, int x, int y) {
  const std::string crop =
      std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(x + 1) + "," + std::to_string(y + 1);
  REQUIRE(here.run({"render", "good.toml", "-r", "64x48", "--spp", "9", "--renderer", renderer, "--crop",
                    crop, "-o", "a.exr"})
              .code == 0);
  const ImageFile image = read_image(here / "a.exr");
  REQUIRE(image.channels.at("R").size() == 1);
  CHECK(image.x0 == x);
  CHECK(image.y0 == y);
  return {image.channels.at("R")[0], image.channels.at("G")[0], image.channels.at("B")[0]};
}

}  // namespace

TEST_CASE("explain: all samples, one sample, and the picture's file agree in every bit") {
  const Workplace here;
  // Sphere, glass before it, plane in shadow, background, an edge.
  for (const glm::ivec2& pixel : {glm::ivec2(30, 20), {42, 26}, {20, 40}, {0, 0}, {63, 47}, {38, 22}}) {
    const std::string name = std::to_string(pixel.x) + "," + std::to_string(pixel.y);
    CAPTURE(name);
    const Json all = explained(here, {"--pixel", name, "--spp", "9"});
    REQUIRE(all.at("samples").size() == 9);
    CHECK(all.at("samples").at(5).at("sample") == Json{2, 1});  // row by row
    for (const char* renderer : {"raster", "raytrace"})
      CHECK(color(all.at("color").at(renderer)) == rendered(here, renderer, pixel.x, pixel.y));

    for (const Json& sample : all.at("samples")) {
      const int i = sample.at("sample").at(0), j = sample.at("sample").at(1);
      if (j != (i + 1) % 3) continue;  // three of nine will do
      const Json one = explained(
          here, {"--pixel", name, "--spp", "9", "--sample", std::to_string(i) + "," + std::to_string(j)});
      REQUIRE(one.at("samples").size() == 1);
      CHECK(one.at("samples").at(0) == sample);
      CHECK(one.at("color").at("raytrace") == sample.at("raytrace").at("color"));
      CHECK(one.at("color").at("raster") == sample.at("raster").at("color"));
    }
  }
}

TEST_CASE("explain: fragments that were kept, and what a ray is multiplied by") {
  const Workplace here;
  const Json sample = explained(here, {"--pixel", "42,26"}).at("samples").at(0);
  std::vector<bool> kept;  // the red ball, the glass before it, the plane behind both
  for (const Json& fragment : sample.at("raster").at("fragments")) kept.push_back(fragment.at("kept"));
  CHECK(kept == std::vector<bool>{true, true, false});
  CHECK(color(sample.at("raytrace").at("children").at(0).at("coefficient")) == glm::vec3(0.9f));
}

TEST_CASE("explain: pixels, samples and settings that are none are wrong usage") {
  const Workplace here;
  for (const char* pixel : {"64,0", "0,48", "-1,0", "1", "1,2,3", "a,b", "", "1, 2", "99999999999,0"}) {
    CAPTURE(pixel);
    const Outcome outcome = here.run({"explain", "good.toml", "-r", "64x48", "--pixel", pixel});
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(lines(outcome.err).size() == 1);
  }
  const Outcome sample =
      here.run({"explain", "good.toml", "--pixel", "1,2", "--spp", "9", "--sample", "3,0"});
  CHECK(sample.code == 2);
  CHECK(sample.err.find("--sample wants two numbers i,j from 0,0 to 2,2") != std::string::npos);
  CHECK(here.run({"explain", "good.toml", "--pixel", "1,2", "--sample", "0,1"}).code == 2);
  for (const char* set : {"=2", "trace.depth", ""}) {
    CAPTURE(set);
    CHECK(here.run({"explain", "good.toml", "--pixel", "1,2", "--set", set}).code == 2);
  }
}

TEST_CASE("explain: a tree of rays that no one could read is refused, and it says what makes it smaller") {
  const Workplace here;
  write_bytes(here / "sheets.toml", sheets_of_glass());
  const Arguments middle{"explain", "sheets.toml", "-r", "64x48", "--pixel", "32,24"};
  CHECK(here.run(middle + Arguments{"--depth", "12"}).code == 0);
  for (const char* depth : {"20", "1000"}) {
    const Outcome outcome = here.run(middle + Arguments{"--depth", depth});
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find(
              "pixel 32,24: too many rays to explain, more than 262144 with their lights; a lower "
              "--depth or a higher --set trace.contribution_cut=C makes them fewer\n") != std::string::npos);
    if (outcome.code != 2) break;  // or the deeper one would fill the memory
  }
  CHECK(here.run(middle + Arguments{"--depth", "1000", "--set", "trace.contribution_cut=0.01"}).code == 0);
}

TEST_CASE("explain: the line to copy can be typed, whatever the scene is called") {
  CHECK(shell_file("scenes/a.toml") == "scenes/a.toml");
  CHECK(shell_file("-a.toml") == "./-a.toml");
  CHECK(shell_file("-a b.toml") == "'./-a b.toml'");
}
