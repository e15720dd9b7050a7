// SPDX-License-Identifier: MIT
// What the words of a command line are taken for.
#include <nlohmann/json.hpp>

#include "common/picture/image_io.h"
#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// One line that says `word`, exit code 2, and nothing made or changed.
void refuse(const Workplace& here, const Arguments& arguments, const std::string& word) {
  const std::vector<std::string> made = here.made();
  const Outcome outcome = here.run(arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(lines(outcome.err).size() == 1);
  CHECK(outcome.err.find(word) != std::string::npos);
  CHECK(here.made() == made);
  CHECK(read_bytes(here / "good.toml") == kGoodScene);
}

nlohmann::json stats(const Workplace& here, const Arguments& more) {
  const Outcome outcome = here.run(render_small({"-q", "-o", "a.png", "--stats", "-"}) + more);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return nlohmann::json::parse(outcome.out);
}

}  // namespace

TEST_CASE("command line: after -- a scene may begin with a dash, and what is missing is named") {
  const Workplace here;
  write_bytes(here / "-r.toml", kGoodScene);
  CHECK(here.run({"render", "-o", "a.png", "-r", "16x12", "--", "-r.toml"}).code == 0);
  refuse(here, {"render", "--", "-r.toml"}, "--output is required");
  refuse(here, {"render", "--", "-r.toml", "-o", "a.png"}, "not expected: -o a.png");
}

TEST_CASE("command line: the flags that diff has for scenes are among those that are meant") {
  const Workplace here;
  refuse(here, {"diff", "a.exr", "good.toml", "--sp", "4"}, "no '--sp'; did you mean '--spp'?");
  refuse(here, {"diff", "a.exr", "good.toml", "--isa", ""}, "wants a value");
}

TEST_CASE("command line: a verb has no flag that would change nothing in it") {
  const Workplace here;
  const std::string crop = "--crop 0,0,4,4", isa = "--isa scalar", threads = "-j 2";
  const auto refuse_flags = [&](const Arguments& verb, const std::vector<std::string>& flags) {
    const std::string help = here.run({verb[0], "--help"}).out;
    for (const std::string& flag : flags) {
      const std::string name = flag.substr(0, flag.find(' '));
      refuse(here, verb + Arguments{name, flag.substr(name.size() + 1)}, name);
      CHECK_MESSAGE(help.find(name + " ") == std::string::npos, name);
    }
    CHECK(help.find("--depth ") != std::string::npos);
  };
  refuse_flags({"info", "good.toml"}, {crop, isa, threads});
  refuse_flags({"explain", "good.toml", "--pixel", "1,1"}, {crop, isa});
  refuse_flags({"convert", "good.toml", "a.pov"}, {crop, isa, threads});
}

TEST_CASE("command line: zeros before a number do not make it octal") {
  const Workplace here;
  CHECK(stats(here, {"--spp", "04"}).at("spp") == 4);
  CHECK(stats(here, {"-j", "010"}).at("threads") == 10);
  CHECK(stats(here, {"--repeat", "010"}).at("frame_ms").at("runs") == 10);
  CHECK(stats(here, {"--snap-bits", "010", "--renderer", "raster"}).at("faults") == "snap-bits 10");
  CHECK(stats(here, {"--tessellate", "0020"}).at("faults") == "tessellate 20");
  REQUIRE(here.run(render_small({"-o", "a.exr", "--depth", "010"})).code == 0);
  CHECK(read_image(here / "a.exr").metadata.at("depth") == "10");
  CHECK(stats(here, {"-j", "0"}).at("threads") == stats(here, {"-j", "00"}).at("threads"));
  refuse(here, render_small({"-o", "b.png", "--spp", "011"}), "a square number");
}

TEST_CASE("command line: whole numbers are decimal") {
  const Workplace here;
  for (const std::string flag : {"--spp", "--depth", "-j", "--repeat", "--snap-bits", "--tessellate"})
    for (const std::string number : {"0x10", "1e1", "four"})
      refuse(here, render_small({"-o", "a.png", flag, number}),
             flag + ": wants a whole number in decimal; got '" + number + "'");
}

TEST_CASE("command line: what is written does not take the place of what is read") {
  const Workplace here;
  REQUIRE(here.run(render_small({"-o", "a.png"})).code == 0);
  REQUIRE(here.run(render_small({"-o", "b.png", "--local"})).code == 0);
  const std::string a = read_bytes(here / "a.png"), b = read_bytes(here / "b.png");
  const std::string here_too = here / "good.toml";  // by another path
  refuse(here, render_small({"-o", "c.png", "--stats", "good.toml"}), "SCENE and --stats want two files");
  refuse(here, render_small({"-o", "c.png", "--stats", here_too}), "SCENE and --stats want two files");
  refuse(here, {"explain", "good.toml", "--pixel", "1,1", "--json", "good.toml"}, "SCENE and --json");
  refuse(here, {"view", "good.toml", "--frame-log", "good.toml"}, "SCENE and --frame-log");
  write_bytes(here / "good.pov", kGoodScene);  // what its name says does not matter
  refuse(here, {"convert", "good.pov", "./good.pov"}, "SCENE and OUT want two files");
  CHECK(read_bytes(here / "good.pov") == kGoodScene);
  refuse(here, {"diff", "a.png", "b.png", "-o", "a.png"}, "A and -o want two files");
  refuse(here, {"diff", "a.png", "b.png", "-o", "b.png"}, "B and -o want two files");
  refuse(here, {"diff", "a.png", "b.png", "--json", "b.png"}, "B and --json want two files");
  refuse(here, {"diff", "a.png", "good.toml", "--json", "./good.toml"}, "B and --json want two files");
  CHECK(read_bytes(here / "a.png") == a);
  CHECK(read_bytes(here / "b.png") == b);
}
