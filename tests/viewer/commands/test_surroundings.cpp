// SPDX-License-Identifier: MIT
// The program and viewer/demo.sh where users have them: folders with spaces, links, a display that is gone.
#include "tests/support/program.h"

using namespace sidelight::test;

// In a source tree whose program is built already, so that cmake has nothing to do.
TEST_CASE("surroundings: demo.sh through a link, from a folder with a space, with no display or a dead one") {
  const Workplace here;
  const std::string tree = here / "source tree ü";
  std::filesystem::create_directories(tree + "/viewer");
  std::filesystem::create_directories(tree + "/build/demo/viewer");
  std::filesystem::create_directory(here / "bin");
  for (const std::string name : {"/viewer/demo.sh", "/viewer/install_packages.sh", "/viewer/packages.txt"})
    std::filesystem::copy_file(SIDELIGHT_SOURCE_DIR + name, tree + name);
  std::filesystem::create_symlink(SIDELIGHT_BINARY, tree + "/build/demo/viewer/sidelight");
  std::filesystem::create_symlink("/bin/true", here / "bin/cmake");
  std::filesystem::create_symlink(tree + "/viewer/demo.sh", here / "demo");
  std::filesystem::copy_file(here / "good.toml", here / "a scene.toml");

  const std::string demo =
      "export PATH=\"$PWD/bin:$PATH\" CDPATH=/ SIDELIGHT_NO_INSTALL=1; ./demo 'a scene.toml' -o 'an out'";
  const Outcome without = here.run_in_shell(demo, {});
  CAPTURE(without.err);
  REQUIRE(without.code == 0);
  CHECK(std::filesystem::exists(here / "an out/report.html"));
  const std::string last = lines(without.out).back(), before = "where there is one: ";
  REQUIRE(last.find(before) != std::string::npos);
  const std::string window = last.substr(last.find(before) + before.size());
  // It finds the program and the scene, and no display.
  CHECK(here.command({"bash", "-c", window}).code == 6);

  const Outcome dead = here.run_in_shell("export DISPLAY=:4077; " + demo, {});
  CAPTURE(dead.err);
  CHECK(dead.code == 0);
  CHECK(dead.err.find("no window: ") != std::string::npos);
}

#ifdef SIDELIGHT_HAVE_OSMESA
TEST_CASE("surroundings: without OSMesa's library nothing is drawn off screen, and all else is as ever") {
  const Workplace here;
  std::filesystem::create_directory(here / "broken");
  write_bytes(here / "broken/libOSMesa.so.8", "");
  const std::string broken = "LD_LIBRARY_PATH=broken \"$0\" \"$@\"";
  CHECK(here.run_in_shell(broken, {"render", "good.toml", "-r", "8x6", "-q", "-o", "a.png"}).code == 0);
  const Outcome drawn =
      here.run_in_shell(broken, {"view", "good.toml", "-r", "8x6", "--screenshot", "b.png"});
  CHECK(drawn.code == 7);
  CHECK(drawn.err.find("nothing can be drawn off screen: ") != std::string::npos);
  CHECK(drawn.err.find("libOSMesa.so.8") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(here / "b.png"));
  // The comparison but for the one picture.
  CHECK(here.run_in_shell(broken, {"compare", "good.toml", "-r", "8x6", "-q", "-o", "c"}).code == 7);
  CHECK(here.run({"compare", "good.toml", "-r", "8x6", "-q", "-o", "d"}).code == 0);
  std::vector<std::string> all = here.names("d");
  std::erase(all, "side_by_side.png");
  CHECK(here.names("c") == all);
}
#endif
