// SPDX-License-Identifier: MIT
// Ctrl-C and SIGTERM in the middle of a verb's work: exit code 130, one line, and nothing half-written.
#include "tests/support/program.h"

using namespace sidelight::test;

namespace {

void check_interrupted(const Outcome& outcome) {
  CAPTURE(outcome.err);
  CHECK(outcome.code == 130);
  CHECK(outcome.out.empty());
  CHECK(lines(outcome.err).size() == 1);
}

// Sends the signal `after` the program could handle it.
void interrupt(const Workplace& here, const Arguments& arguments, int signal,
               std::chrono::milliseconds after) {
  CAPTURE(arguments[0]);
  Process process(Arguments{SIDELIGHT_BINARY} + arguments + Arguments{"-q"}, here / ".");
  process.await_handler(signal);
  std::this_thread::sleep_for(after);
  process.send(signal);
  check_interrupted(process.wait());
}

constexpr std::chrono::milliseconds kWorking{200};  // by then it is at work; any moment must do

// So many facets that reading the scene and writing it for POV-Ray take their time.
void write_large_scene(const Workplace& here) {
  write_bytes(here / "large.toml", kGoodScene +
                                       "[[mesh]]\nshape = 'torus'\nradii = [2, 1]\n"
                                       "segments = [700, 300]\nmaterial = 'red'\n");
}

bool is_writing(const Workplace& here) {
  for (const std::string& name : here.made())
    if (name.ends_with(".tmp")) return true;
  return false;
}

}  // namespace

TEST_CASE("exit code 130: interrupted in the middle of a picture") {
  const Workplace here;
  const Arguments large{"-r", "2000x1500", "--spp", "16"};
  interrupt(here, Arguments{"render", "good.toml", "-o", "a.exr"} + large, SIGINT, kWorking);
  interrupt(here, Arguments{"render", "good.toml", "-o", "a.exr"} + large, SIGTERM, kWorking);
  CHECK(here.made().empty());
}

TEST_CASE(
    "exit code 130: an interrupted comparison leaves no folder that it made, and those that were there") {
  const Workplace here;
  const auto compare_into = [&](const std::string& folder) {
    interrupt(here, {"compare", "good.toml", "-r", "2000x1500", "--spp", "16", "-o", folder}, SIGINT,
              kWorking);
  };
  compare_into("out");
  compare_into("new/out/");
  CHECK(here.made().empty());
  for (const char* folder : {"empty", "full", "full/inner"}) std::filesystem::create_directory(here / folder);
  compare_into("empty");
  compare_into("full/inner/out");
  CHECK(here.made() == std::vector<std::string>{"empty", "full"});
  CHECK(here.names("full") == std::vector<std::string>{"inner"});
  CHECK(here.names("full/inner").empty());
}

TEST_CASE("exit code 130: interrupted between the samples that explain tells of") {
  const Workplace here;
  const Arguments long_tale{"explain", "scenes/showcase.toml", "--pixel", "380,290", "--spp", "4096"};
  for (const int signal : {SIGINT, SIGTERM}) interrupt(here, long_tale, signal, kWorking);
}

TEST_CASE("exit code 130: interrupted within the one sample that explain tells of") {
  const Workplace here;
  write_bytes(here / "sheets.toml", sheets_of_glass());
  // A hundred thousand rays, and a few hundred megabytes of JSON: seconds.
  interrupt(here,
            {"explain", "sheets.toml", "-r", "64x48", "--pixel", "32,24", "--depth", "18", "--json", "-"},
            SIGINT, kWorking);
}

TEST_CASE("exit code 130: interrupted while the scene is read, where nothing would be rendered") {
  const Workplace here;
  write_large_scene(here);
  for (const int signal : {SIGINT, SIGTERM}) interrupt(here, {"info", "large.toml"}, signal, {});
}

TEST_CASE("exit code 130: interrupted while it waits for who writes its scene") {
  const Workplace here;
  REQUIRE(here.command({"mkfifo", "pipe.toml"}).code == 0);
  for (const int signal : {SIGINT, SIGTERM}) interrupt(here, {"info", "pipe.toml"}, signal, kWorking);
}

TEST_CASE("exit code 130: interrupted while a scene for POV-Ray is written, which leaves none") {
  const Workplace here;
  write_large_scene(here);
  const std::vector<std::string> before = here.made();
  Process process({SIDELIGHT_BINARY, "convert", "large.toml", "a.pov", "-q"}, here / ".");
  for (int tries = 0; tries < 60000 && !is_writing(here); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process.send(SIGINT);
  check_interrupted(process.wait());
  CHECK(here.made() == before);
}
