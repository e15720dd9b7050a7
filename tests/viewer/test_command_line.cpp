// SPDX-License-Identifier: MIT
// What the words of a command line are taken for.
#include "tests/viewer/program.h"

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
