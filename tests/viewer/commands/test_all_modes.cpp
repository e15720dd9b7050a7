// SPDX-License-Identifier: MIT
// compare --all-modes: pictures for slides.
#include <array>

#include "common/picture/image_io.h"
#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// The greatest difference of two pictures' values.
float apart(const std::string& a, const std::string& b) {
  const ImageFile left = read_image(a), right = read_image(b);
  REQUIRE(left.width == right.width);
  REQUIRE(left.height == right.height);
  float most = 0;
  for (const char* channel : {"R", "G", "B"})
    for (std::size_t i = 0; i < left.channels.at(channel).size(); ++i)
      most = std::max(most, std::abs(left.channels.at(channel)[i] - right.channels.at(channel)[i]));
  return most;
}

}  // namespace

TEST_CASE("all modes: every layer of both renderers and every step of the ledger") {
  const Workplace here;
  const Arguments command{"compare",   "good.toml", "-r",         "32x24", "--crop",
                          "2,3,30,20", "-q",        "--no-times", "-o"};
  REQUIRE(here.run(command + Arguments{"out", "--all-modes"}).code == 0);
  REQUIRE(here.run(command + Arguments{"plain"}).code == 0);

  std::vector<std::string> expected{"ledger_1_raster.png", "ledger_2_minus_shadow.png",
                                    "ledger_3_plus_reflection.png", "ledger_4_plus_refraction.png",
                                    "signed_difference.png"};
  for (std::size_t i = 0; i < kLayerNames.size(); ++i) {
    const LayerMask bit = layer_bit(static_cast<Layer>(i));
    const std::string name = "_" + std::string(kLayerNames[i]) + ".png";
    if ((kRasterLayers | layer_bit(Layer::cost)) & bit) expected.push_back("raster" + name);
    if (kAllLayers & bit) expected.push_back("raytrace" + name);
  }
  std::sort(expected.begin(), expected.end());
  CHECK(here.names("out/modes") == expected);

  // Nothing else changes, and what is the same thing is the same picture.
  std::vector<std::string> others = here.names("out");
  std::erase(others, "modes");
  CHECK(others == here.names("plain"));
  for (const std::string& name : others)
    CHECK(read_bytes(here / ("out/" + name)) == read_bytes(here / ("plain/" + name)));
  CHECK(apart(here / "out/modes/ledger_1_raster.png", here / "out/raster.png") == 0);
  // To one step of 8 bits, which is at most 0.0090 in linear light: the sum is rounded otherwise than the picture.
  CHECK(apart(here / "out/modes/ledger_4_plus_refraction.png", here / "out/raytrace.png") < 0.0091f);
  CHECK(apart(here / "out/modes/ledger_2_minus_shadow.png", here / "out/raster.png") > 0.1f);
  CHECK(apart(here / "out/modes/raster_object.png", here / "out/modes/raytrace_object.png") == 0);
}

TEST_CASE("all modes: those of an earlier comparison do not stay beside a later one") {
  const Workplace here;
  const Arguments command{"compare", "good.toml", "-r", "16x12", "-q", "-o", "out"};
  REQUIRE(here.run(command + Arguments{"--all-modes"}).code == 0);
  REQUIRE(here.names("out/modes").size() > 5);
  REQUIRE(here.run(command + Arguments{"--all-modes", "--primary", "raster"}).code == 0);
  CHECK_FALSE(std::filesystem::exists(here / "out/modes/raytrace_cost.png"));
  REQUIRE(here.run(command).code == 0);
  CHECK_FALSE(std::filesystem::exists(here / "out/modes"));

  // What it did not write itself stays.
  REQUIRE(here.run(command + Arguments{"--all-modes"}).code == 0);
  write_bytes(here / "out/modes/notes.txt", "mine");
  REQUIRE(here.run(command).code == 0);
  CHECK(here.names("out/modes") == std::vector<std::string>{"notes.txt"});
}

TEST_CASE("all modes: with the z-buffer's surfaces every layer but the cost, which is not made then") {
  const Workplace here;
  const Arguments command{"compare", "good.toml", "-r", "32x24", "-q", "--no-times", "--all-modes", "-o"};
  REQUIRE(here.run(command + Arguments{"rays"}).code == 0);
  REQUIRE(here.run(command + Arguments{"raster", "--primary", "raster"}).code == 0);
  std::vector<std::string> expected = here.names("rays/modes");
  CHECK(std::erase(expected, "raytrace_cost.png") == 1);
  CHECK(here.names("raster/modes") == expected);
  for (const std::string& name : expected)
    CHECK(apart(here / ("raster/modes/" + name), here / ("rays/modes/" + name)) == 0);
}
