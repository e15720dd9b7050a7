// SPDX-License-Identifier: MIT
// The flags of the faults on purpose: what they refuse, and that every output says they are on.
#include <nlohmann/json.hpp>

#include "common/picture/image_io.h"
#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

void check_refused(const Arguments& arguments) {
  const Workplace here;
  const Outcome outcome =
      here.run(Arguments{"render", "good.toml", "-r", "16x12", "-o", "a.png"} + arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(here.made().empty());
}

}  // namespace

TEST_CASE("fault flags: numbers out of range are wrong usage") {
  check_refused({"--renderer", "raster", "--depth-format", "unorm16", "--near", "5", "--far", "5"});
  check_refused({"--renderer", "raster", "--depth-format", "unorm16", "--near", "0"});
  check_refused({"--renderer", "raster", "--depth-format", "unorm8"});
  check_refused({"--renderer", "raster", "--near", "1"});
  check_refused({"--renderer", "raster", "--snap-bits", "17"});
  check_refused({"--tessellate", "7"});
  check_refused({"--tessellate", "2"});
  check_refused({"--shadow-offset", "-1"});
  check_refused({"--shadow-offset", "nan"});
  check_refused({"--precision", "double"});
}

TEST_CASE("fault flags: a renderer that does not make a fault says so, and explain knows none") {
  check_refused({"--renderer", "raytrace", "--snap-bits", "4"});
  check_refused({"--renderer", "raster", "--shadow-offset", "0"});
  check_refused({"--renderer", "raytrace-reference", "--precision", "float"});
  const Workplace here;
  CHECK(here.run({"explain", "good.toml", "--pixel", "3,3", "--snap-bits", "4"}).code == 2);
}

TEST_CASE("fault flags: compare counts spoiled pixels apart and exits with 1") {
  const Workplace here;
  const Outcome outcome = here.run({"compare", "scenes/hard/shadow-offset.toml", "-r", "64x48", "-o", "out",
                                    "--no-times", "--shadow-offset", "0", "--tessellate", "16"});
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("faults on purpose: shadow-offset 0, tessellate 16") != std::string::npos);
  // On shadows it changes colours alone.
  CHECK(outcome.err.find("; 0 of them show another surface") != std::string::npos);
  const auto json = nlohmann::json::parse(read_bytes(here / "out/compare.json"));
  CHECK(json["faults"].size() == 2);
  CHECK(json["faults"]["shadow-offset"].get<int>() > 0);
  CHECK(json["faults"]["tessellate"].get<int>() > 0);
  CHECK(json["unexplained"] == 0);
  CHECK(json["visibility_mismatches"] == 0);
  for (const char* file : {"out/raster.exr", "out/side_by_side.png", "out/report.html"})
    CHECK(read_bytes(here / file).find("shadow-offset 0, tessellate 16") != std::string::npos);
  CHECK(read_bytes(here / "out/report.html").find(" --shadow-offset 0 --tessellate 16</code>") !=
        std::string::npos);
}

// Floats, a million from the eye, make the two pictures name different facets of one ball in one colour. Alone they change
// nothing, as there is no triangle; still the flakes that they make of the ball are theirs.
TEST_CASE("fault flags: what two faults spoil together is counted in none of the promises") {
  const Workplace here;
  const Outcome outcome = here.run({"compare", "scenes/hard/far-ball.toml", "-r", "160x120", "-o", "out",
                                    "-q", "--precision", "float", "--tessellate", "64"});
  CHECK(outcome.code == 1);
  const auto json = nlohmann::json::parse(read_bytes(here / "out/compare.json"));
  CHECK(json["faults"]["tessellate"].get<int>() > 0);
  CHECK(json["faults"]["precision"].get<int>() > 0);
  CHECK(json["unexplained"] == 0);
  CHECK(json["visibility_mismatches"] == 0);
  REQUIRE(here.run({"compare", "scenes/hard/far-ball.toml", "-r", "160x120", "-o", "alone", "-q",
                    "--precision", "float"})
              .code == 0);
}

TEST_CASE("fault flags: facets spoil the depth of pixels whose colour they keep") {
  const Workplace here;
  REQUIRE(here.run({"compare", "scenes/hard/far-ball.toml", "-r", "64x48", "-o", "out", "-q", "--tessellate",
                    "16"})
              .code == 1);
  const auto json = nlohmann::json::parse(read_bytes(here / "out/compare.json"));
  CHECK(json["faults"]["tessellate"].get<int>() >= json["covered"].get<int>());  // and round the balls
}

TEST_CASE("fault flags: a fault that spoils nothing is named with 0 and exits with 0") {
  const Workplace here;
  const Outcome outcome = here.run({"compare", "scenes/hard/depth-format.toml", "-r", "64x48", "-o", "out",
                                    "-q", "--depth-format", "reversed"});
  CHECK(outcome.code == 0);
  CHECK(outcome.err == "");
  CHECK(nlohmann::json::parse(read_bytes(here / "out/compare.json"))["faults"]["depth-format"] == 0);
}

TEST_CASE("fault flags: the statistics say what is on, and nothing when off") {
  const Workplace here;
  const Arguments render{"render", "good.toml", "-r", "16x12", "-q", "-o", "a.png", "--stats", "-"};
  CHECK(nlohmann::json::parse(here.run(render + Arguments{"--tessellate", "8"}).out)["faults"] ==
        "tessellate 8");
  CHECK(read_image(here / "a.png").metadata.at("title") == "FAULTS ON PURPOSE (tessellate 8): good.toml");
  CHECK_FALSE(nlohmann::json::parse(here.run(render).out).contains("faults"));
}
