// SPDX-License-Identifier: MIT
// What compare and view --screenshot write, beside the pictures' colours.
#include "common/picture/image_io.h"
#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;

#ifdef SIDELIGHT_HAVE_OSMESA
TEST_CASE("compare: pictures too wide to be drawn side by side are compared all the same") {
  const Workplace here;
  const Arguments narrow{"compare", "good.toml", "-r", "16x12", "-o", "out"};
  Outcome outcome = here.run(narrow);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.find("side_by_side.png") != std::string::npos);
  const std::vector<std::string> all = here.names("out");

  outcome = here.run({"compare", "good.toml", "-r", "9000x2", "-o", "out"});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.find("0 visibility mismatches") != std::string::npos);
  CHECK(outcome.err.find("no side_by_side.png, which would be 18") != std::string::npos);
  CHECK(outcome.err.find("report.html, causes.png") != std::string::npos);
  // That of the run before is gone, and nothing else.
  std::vector<std::string> others = all;
  std::erase(others, "side_by_side.png");
  CHECK(here.names("out") == others);
}

TEST_CASE("view: a screenshot's metadata are those of what it shows") {
  const Workplace here;
  const auto shot = [&](const std::string& keys, const Arguments& more) {
    const Arguments asked =
        Arguments{"view", "good.toml", "-r", "16x12", "-q", "--press", keys, "--screenshot", "a.png"} + more;
    REQUIRE(here.run(asked).code == 0);
    return read_image(here / "a.png").metadata;
  };
  const auto before = shot("h", {}), after = shot("d f g", {"--spp", "4"});
  CHECK(before.at("shadows") == "on");
  CHECK(after.at("shadows") == "off");
  CHECK(after.at("reflection") == "off");
  CHECK(after.at("refraction") == "on");
  CHECK(std::stoi(after.at("depth")) == std::stoi(before.at("depth")) + 1);
  CHECK(after.at("samples_per_pixel") == "4");
  CHECK(after.at("scene_hash") == before.at("scene_hash"));
}
#endif
