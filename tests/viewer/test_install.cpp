// SPDX-License-Identifier: MIT
// The program away from the folder where it was built.
#include "tests/viewer/program.h"

using namespace sidelight::test;

TEST_CASE("install: the installed program has all it needs with it") {
  const Workplace here;
  REQUIRE(here.command({"cmake", "--install", SIDELIGHT_BUILD_DIR, "--prefix", here / "new"}).code == 0);
  const Arguments render{
      here / "new/bin/sidelight", "render", "good.toml", "-r", "16x12", "-q", "-o", "a.png"};
  const Outcome outcome = here.command(render);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  const std::string picture = read_bytes(here / "a.png");
  REQUIRE(here.run({"render", "good.toml", "-r", "16x12", "-q", "-o", "b.png"}).code == 0);
  CHECK(picture == read_bytes(here / "b.png"));

  // The codec is its own, not that of the build folder.
  for (const auto& file : std::filesystem::recursive_directory_iterator(here / "new"))
    if (file.path().filename() == "libsidelight_codec.so") write_bytes(file.path().string(), "no library");
  const Outcome broken = here.command(render);
  CHECK(broken.code == 7);
  CHECK(broken.err.find("new/") != std::string::npos);
}
