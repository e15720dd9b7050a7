// SPDX-License-Identifier: MIT
// sidelight convert as its users meet it.
#include "tests/support/program.h"

using namespace sidelight::test;

TEST_CASE("convert: a file, and nothing to say where POV-Ray can express it all") {
  const Workplace here;
  const Outcome outcome = here.run({"convert", "good.toml", "good.pov"});
  CHECK(outcome.code == 0);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.empty());
  CHECK(here.made() == std::vector<std::string>{"good.pov"});
  CHECK(read_bytes(here / "good.pov").rfind("//", 0) == 0);
}

TEST_CASE("convert: what cannot be expressed is named on standard error and in the file") {
  const Workplace here;
  const Outcome outcome = here.run({"convert", "scenes/13-everything.toml", "a.pov"});
  CHECK(outcome.code == 0);
  const std::vector<std::string> said = lines(outcome.err);
  REQUIRE(said.size() == 2);
  for (const std::string& line : said) {
    const std::string start = "scenes/13-everything.toml: not the same in POV-Ray: ";
    REQUIRE(line.rfind(start, 0) == 0);
    CHECK(read_bytes(here / "a.pov").find(line.substr(start.size())) != std::string::npos);
  }
  CHECK(here.run({"convert", "scenes/13-everything.toml", "b.pov", "-q"}).err.empty());
  CHECK(read_bytes(here / "a.pov") == read_bytes(here / "b.pov"));
}

TEST_CASE("convert: size, depth and switches are the command line's") {
  const Workplace here;
  CHECK(here.run({"convert", "good.toml", "a.pov", "-r", "33x22", "--depth", "3", "--local"}).code == 0);
  const std::string text = read_bytes(here / "a.pov");
  CHECK(text.find("+W33 +H22") != std::string::npos);
  CHECK(text.find("max_trace_level 3 ") != std::string::npos);
  CHECK(text.find("ior") == std::string::npos);
}

TEST_CASE("convert: wrong usage, and a place that cannot be written") {
  const Workplace here;
  CHECK(here.run({"convert", "good.toml"}).code == 2);
  CHECK(here.run({"convert", "good.toml", "a.png"}).code == 2);
  CHECK(here.run({"convert", "good.toml", "a.pov", "--spp", "4"}).code == 2);
  CHECK(here.run({"convert", "good.toml", "a.pov", "--crop", "0,0,4,4"}).code == 2);
  const std::string help = here.run({"convert", "--help"}).out;
  for (const char* flag : {"--spp", "--crop"}) CHECK(help.find(flag) == std::string::npos);
  CHECK(here.run({"convert", "missing.toml", "a.pov"}).code == 3);
  CHECK(here.run({"convert", "good.toml", "missing/a.pov"}).code == 7);
  CHECK(here.made().empty());
}
