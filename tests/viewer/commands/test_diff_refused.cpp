// SPDX-License-Identifier: MIT
// What the verb diff does not take: files that are no pictures, and wrong usage.
#include "common/picture/image_io.h"
#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

void write_grey(const std::string& path, int width, int height) {
  Frame frame = make_frame(width, height, 1, {});
  frame.color.assign(frame.pixels(), glm::vec3(0.5f, 0.25f, 0.125f));
  write_png(path, to_image8(frame.color, width, height));
}

}  // namespace

TEST_CASE("diff: exit code 3 for what cannot be read as a picture") {
  const Workplace here;
  write_grey(here / "a.png", 6, 4);
  write_bytes(here / "text.png", "not a picture");
  write_bytes(here / "cut.png", read_bytes(here / "a.png").substr(0, 60));
  REQUIRE(here.command({"oiiotool", "a.png", "--ch", "R,G", "-o", "two.exr"}).code == 0);
  for (const char* bad : {"missing.png", "text.png", "cut.png", "two.exr", "scenes", "missing.toml"}) {
    CAPTURE(bad);
    const Outcome outcome = here.run({"diff", "a.png", bad});
    CHECK(outcome.code == 3);
    CHECK(lines(outcome.err).size() == 1);
    CHECK(outcome.err.find(bad) != std::string::npos);
  }
  CHECK(here.run({"diff", "missing.png", "a.png"}).code == 3);
}

TEST_CASE(
    "diff: what libraries say of a broken picture is one line, and colours in whole numbers are no colours") {
  const Workplace here;
  write_grey(here / "a.png", 60, 40);
  std::string bytes = read_bytes(here / "a.png");
  bytes[bytes.find("IDAT") + 10] ^= 0x55;
  write_bytes(here / "corrupt.png", bytes);
  for (const Arguments& more : {Arguments{}, Arguments{"-q"}}) {
    const Outcome outcome = here.run(Arguments{"diff", "a.png", "corrupt.png"} + more);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(lines(outcome.err).size() == 1);
    CHECK(outcome.err.find("corrupt.png: ") == 0);
    CHECK(outcome.err.find("\\x0A") == std::string::npos);
  }
  REQUIRE(here.command({"oiiotool", "a.png", "-d", "uint32", "-o", "uint.exr"}).code == 0);
  const Outcome outcome = here.run({"diff", "a.png", "uint.exr"});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 3);
  CHECK(outcome.err.find("channel R is of type uint") != std::string::npos);
}

TEST_CASE("diff: exit code 2 for wrong usage") {
  const Workplace here;
  write_grey(here / "a.png", 6, 4);
  const auto refused = [&](const Arguments& arguments, const std::string& word) {
    const Outcome outcome = here.run(Arguments{"diff"} + arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(lines(outcome.err).size() == 1);
    CHECK(outcome.err.find(word) != std::string::npos);
  };
  refused({"a.png"}, "B");
  refused({"a.png", "a.png", "--fail", "-1"}, "--fail");
  refused({"a.png", "a.png", "--fail", "nan"}, "--fail");
  refused({"a.png", "a.png", "--failpercent", "-0.1"}, "--failpercent");
  refused({"a.png", "a.png", "--hardfail", "nan"}, "--hardfail");
  refused({"a.png", "a.png", "--allow", "-1"}, "--allow: wants a number of pixels, 0 or more; got '-1'");
  refused({"a.png", "a.png", "--allow", "1.5"}, "--allow");
  refused({"a.png", "a.png", "-o", "d.exr"}, ".png");
  refused({"good.toml", "a.png"}, "good.toml");
  refused({"a.png", "a.png", "--spp", "4"}, ".toml");
  refused({"a.png", "a.png", "--renderer", "raster"}, ".toml");
  refused({"a.png", "good.toml", "--renderer", "opengl"}, "raytrace");
}
