// SPDX-License-Identifier: MIT
// Every exit code of render, compare, info and view, from outside, each with what is left behind.
//
// Two codes are not here. 1 (the two pictures do not agree) is a fault of the program and nothing that a user could
// ask for: tests/planted_faults.sh puts such faults into the source and sees the code. 4 belongs to the verb diff.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "common/math/isa.h"
#include "tests/support/program.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

std::string joined(const Arguments& arguments) {
  std::string out;
  for (const std::string& each : arguments) out += each + ' ';
  return out;
}

// The command fails with the code, one line on stderr that holds `word`, nothing on stdout and no file.
void check_refused(const Arguments& arguments, int code, const std::string& word) {
  const Workplace here;
  const std::string command = joined(arguments);
  CAPTURE(command);
  const Outcome outcome = here.run(arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == code);
  CHECK(outcome.out.empty());
  CHECK(lines(outcome.err).size() == 1);
  CHECK(outcome.err.find(word) != std::string::npos);
  CHECK(here.made().empty());
}

void check_usage(const Arguments& arguments, const std::string& word) { check_refused(arguments, 2, word); }

// What to put into the good scene to make it a bad one.
struct Mistake {
  std::string from, to;  // where it first stands in kGoodScene
  std::string word;      // in the message
};

const Mistake kMistakes[] = {
    {"eye = [0, 1, 6]", "eye = [0, 1, 6", "bad.toml:3"},  // syntax: the list never ends
    {"radius = 1", "radius = ", "value"},                 // syntax: no value
    {"radius = 1", "radios = 1", "radius"},               // unknown key, with the nearest
    {"[[sphere]]", "[[spere]]", "sphere"},                // unknown table
    {"radius = 1", "radius = 'one'", "length"},           // wrong type
    {"eye = [0, 1, 6]", "eye = [0, 0]", "3"},             // too few numbers
    {"eye = [0, 1, 6]", "", "eye"},                       // missing keys
    {"radius = 1", "", "radius"},
    {"material = 'red'", "", "material"},
    {"intensity = [1, 1, 1]", "", "intensity"},
    {"position = [2, 4, 3]", "", "position"},
    {"vertical_fov = 40", "", "vertical_fov"},
    {"material = 'red'", "material = 'rad'", "red"},  // unknown material, with the nearest
    {"radius = 1", "radius = nan", "nan"},            // not a number
    {"eye = [0, 1, 6]", "eye = [0, inf, 6]", "inf"},
    {"radius = 1", "radius = 0", "radius"},  // out of range
    {"radius = 1", "radius = 1e16", "radius"},
    {"vertical_fov = 40", "vertical_fov = 180", "vertical_fov"},
    {"vertical_fov = 40", "vertical_fov = 40\nview_height = 1", "view_height"},  // both at once
    {"diffuse = [1, 0, 0]", "diffuse = -1", "diffuse"},
    {"diffuse = [1, 0, 0]", "ior = 5", "ior"},
    {"diffuse = [1, 0, 0]", "shininess = 2e6", "shininess"},
    {"intensity = [1, 1, 1]", "intensity = 1\nattenuation = [0, 0, 0]", "attenuation"},
    {"position = [2, 4, 3]", "direction = [1, 2, 3]\nattenuation = [1, 1, 0]", "attenuation"},
    {"position = [2, 4, 3]", "direction = [0, 0, 0]", "direction"},
    {"look_at = [0, 0, 0]", "look_at = [0, 1, 6]", "look_at"},  // nowhere to look
    {"radius = 1\nmaterial = 'red'",
     "radius = 1\nmaterial = 'red'\n[[mesh]]\nfile = 'no.obj'\nmaterial = 'red'", "no.obj"},
    {"radius = 1\nmaterial = 'red'",
     "radius = 1\nmaterial = 'red'\n[[mesh]]\nshape = 'knot'\nmaterial = 'red'", "torus"},
    {"[camera]", "[trace]\ndepth = 0\n[camera]", "depth"},
    {"[camera]", "[picture]\nsize = [0, 480]\n[camera]", "size"},
    {"diffuse = [1, 0, 0]", "diffuse = 1\ndiffuse = 1", "diffuse"},  // twice
};

// "file:line:column: ..." with both numbers from 1.
bool is_located(const std::string& message, const std::string& file) {
  return std::regex_search(message, std::regex("^" + file + ":[1-9][0-9]*:[1-9][0-9]*: ."));
}

}  // namespace

TEST_CASE("exit code 0: every verb that needs no display") {
  const Workplace here;
  CHECK(here.run({"--help"}).code == 0);
  CHECK(here.run({"--version"}).code == 0);
  CHECK(here.run(Arguments{"info"} + kSmall).code == 0);
  CHECK(here.run(Arguments{"render"} + kSmall + Arguments{"-o", "a.png"}).code == 0);
  CHECK(here.run(Arguments{"render"} + kSmall + Arguments{"-o", "b.exr", "--layers", "all", "--spp", "4"})
            .code == 0);
  CHECK(here.run(Arguments{"render"} + kSmall + Arguments{"-o", "c.png", "--linear16", "--local"}).code == 0);
  CHECK(here.run(Arguments{"compare"} + kSmall + Arguments{"-o", "out/deep"}).code == 0);
  CHECK(here.made() == std::vector<std::string>{"a.png", "b.exr", "c.png", "out"});
}

TEST_CASE("exit code 2: wrong usage") {
  const auto render = [](const Arguments& more) {
    return Arguments{"render"} + kSmall + Arguments{"-o", "a.png"} + more;
  };
  check_usage({}, "subcommand");
  check_usage({"rendr", "good.toml", "-o", "a.png"}, "no verb 'rendr', only view, compare");
  check_usage({"rendr", "good.toml", "-o", "a.png"}, "did you mean 'render'?");
  check_usage({"render", "good.toml"}, "--output");
  check_usage({"render", "-o", "a.png"}, "SCENE");
  check_usage({"compare", "good.toml"}, "--output");
  check_usage(render({"--dept", "3"}), "no '--dept'; did you mean '--depth'?");
  check_usage(render({"--dept=3"}), "no '--dept'; did you mean '--depth'?");
  check_usage({"diff", "a.exr", "a.exr", "--fail", "1/255"}, "--fail = 1/255, expected a number (");
  check_usage(render({"--frobnicate"}), "render: there is no '--frobnicate' (sidelight");
  check_usage(render({"--threads", "2"}), "render: there is no '--threads' (sidelight");
  check_usage({"bench", "good.toml", "-o", "o", "--set", "quality=4"}, "no knob 'quality', only renderer, ");
  check_usage({"help"}, "bench, convert, info\n");
  check_usage({"render", "good.toml", "--outptu", "a.png"}, "did you mean '--output'?");
  check_usage(render({"b.toml", "-Z", "c"}), "not expected: b.toml -Z c");
  check_usage(render({"--spp", "5"}), "square");
  check_usage(render({"--spp", "0"}), "square");
  check_usage(render({"--spp", "4225"}), "4096");
  check_usage(render({"--spp", "four"}), "--spp");
  check_usage(render({"--isa", "nonsense"}), "avx2");
  check_usage(render({"--depth", "0"}), "--depth");
  check_usage(render({"-j", "-1"}), "-j");
  check_usage(render({"--repeat", "0"}), "--repeat");
  check_usage(render({"--stats"}), "--stats");
  check_usage(render({"--renderer", "opengl"}), "raster-reference");
  for (const char* crop : {"0,0,0,5", "5,5,4,8", "0,0,17,12", "-1,0,4,4", "0,0,4", "0,0,4,4,4", "a,b,c,d"})
    check_usage(render({"--crop", crop}), "--crop");
}

TEST_CASE("exit code 2: sizes that are none") {
  for (const char* size :
       {"640", "640x", "x480", "0x480", "640x-1", "640x70000", "640x480x2", "640*480", "640x4 80"})
    check_usage({"render", "good.toml", "-o", "a.png", "-r", size}, "WxH");
}

TEST_CASE("exit code 2: an instruction set that the machine lacks") {
  if (machine_has(Isa::avx512)) return test::skip_test("this machine has them all");
  check_usage(Arguments{"render"} + kSmall + Arguments{"-o", "a.png", "--isa", "avx512"}, "avx512");
}

TEST_CASE("exit code 2: layers and formats that do not fit") {
  const auto render = [](const Arguments& more) { return Arguments{"render"} + kSmall + more; };
  check_usage(render({"-o", "a.exr", "--layers", "paint"}), "ambient");
  check_usage(render({"-o", "a.exr", "--layers", "shadow", "--renderer", "raster"}), "raster");
  for (const char* reference : {"raster-reference", "raytrace-reference"})
    check_usage(render({"-o", "a.exr", "--layers", "depth,cost", "--renderer", reference}), reference);
  check_usage(render({"-o", "a.png", "--layers", "depth"}), ".exr");
  check_usage(render({"-o", "a.exr", "--linear16"}), ".png");
  check_usage(render({"-o", "a.jpg"}), ".png");
  check_usage(render({"-o", "folder"}), ".png");
}

TEST_CASE("exit code 2: an empty value, as of a shell's unset variable, is not taken for none") {
  const Arguments render = Arguments{"render"} + kSmall + Arguments{"-o", "a.png"};
  for (const char* flag : {"--stats", "-r", "--crop", "--layers", "--isa", "--depth", "--spp", "--renderer"})
    check_usage(render + Arguments{flag, ""}, "wants a value; got ''");
  check_usage(render + Arguments{"--stats="}, "--stats");
  check_usage({"explain", "good.toml", "--pixel", "1,1", "--json", ""}, "--json");
  check_usage({"explain", "good.toml", "--pixel", "1,1", "--sample", ""}, "--sample");
  check_usage({"diff", "a.png", "good.toml", "--json", ""}, "--json");
  check_usage({"view", "good.toml", "--screenshot", ""}, "--screenshot");
  check_usage({"bench", "good.toml", "-o", "out", "--sweep", ""}, "--sweep");
  check_usage({"compare", "good.toml", "-o", ""}, "--output");
  check_usage({"info", ""}, "SCENE");
}

TEST_CASE("exit code 2: two outputs into one file") {
  const Arguments render = Arguments{"render"} + kSmall;
  check_usage(render + Arguments{"-o", "a.png", "--stats", "a.png"}, "two files");
  check_usage(render + Arguments{"-o", "a.png", "--stats", "./a.png"}, "two files");
  check_usage({"diff", "a.exr", "b.exr", "-o", "d.png", "--json", "d.png"}, "two files");
}

TEST_CASE("exit code 2: a screenshot is a .png, and no window with frames to log") {
  for (const char* name : {"a.jpg", "a", "png"})
    check_usage({"view", "good.toml", "--screenshot", name}, ".png");
  check_usage({"view", "good.toml", "--screenshot", "a.png", "--frame-log", "a.csv"}, "--frame-log");
  check_usage({"view", "good.toml", "--screenshot", "a.png", "--size", "70000x9"}, "from 1 to 16384");
}

TEST_CASE("exit code 3: each mistake in a scene file is one line with its place") {
  const Workplace here;
  REQUIRE(here.run({"info", "good.toml"}).code == 0);
  for (const Mistake& mistake : kMistakes) {
    std::string text = kGoodScene;
    REQUIRE(text.find(mistake.from) != std::string::npos);
    text.replace(text.find(mistake.from), mistake.from.size(), mistake.to);
    write_bytes(here / "bad.toml", text);
    CAPTURE(mistake.to);
    const Outcome outcome = here.run({"render", "bad.toml", "-o", "a.png"});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(outcome.out.empty());
    CHECK(lines(outcome.err).size() == 1);
    CHECK(is_located(outcome.err, "bad.toml"));
    CHECK(outcome.err.find(mistake.word) != std::string::npos);
  }
  CHECK(here.made() == std::vector<std::string>{"bad.toml"});
}

TEST_CASE("exit code 3: a mistake in a mesh is named where the mesh file has it") {
  const Workplace here;
  write_bytes(here / "bad.toml", kGoodScene + "[[mesh]]\nfile = 'bad.obj'\nmaterial = 'red'\n");
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* face : {"f 1 2 4", "f 1 2", "f 1 2 -4", "f 1 2 x", "v 1 2", "v 1 2 nan"}) {
    write_bytes(here / "bad.obj", corners + face + "\n");
    CAPTURE(face);
    const Outcome outcome = here.run({"info", "bad.toml"});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(lines(outcome.err).size() == 1);
    CHECK(is_located(outcome.err, "bad.obj"));
  }
}

TEST_CASE("exit code 3: files that are not there or not scenes") {
  check_refused({"info", "no_such.toml"}, 3, "no_such.toml");
  check_refused({"render", "scenes", "-o", "a.png"}, 3, "scenes");
  check_refused({"compare", "/dev/null/x.toml", "-o", "out"}, 3, "/dev/null/x.toml");
  const Workplace here;
  std::filesystem::create_symlink("round.toml", here / "round.toml");  // there, but not to be reached
  const Outcome outcome = here.run({"info", "round.toml"});
  CHECK(outcome.code == 3);
  CHECK(outcome.err.find("round.toml: cannot be reached: ") == 0);
}

TEST_CASE("exit code 3: a size that memory refuses is named") {
  check_refused({"render", "good.toml", "-o", "a.png", "-r", "65535x65535", "--spp", "4096"}, 3,
                "65535x65535");
  check_refused({"compare", "good.toml", "-o", "out", "-r", "65535x65535", "--spp", "4096"}, 3,
                "65535x65535");
}

TEST_CASE("exit code 3: with faults on purpose, compare counts the memory of three pairs of pictures") {
  const Workplace here;
  const auto gigabytes = [&](const Arguments& faults) {
    const Outcome outcome =
        here.run(Arguments{"compare", "good.toml", "-o", "out", "-r", "65535x65535"} + faults);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    std::smatch found;
    REQUIRE(std::regex_search(outcome.err, found, std::regex("needs ([0-9.]+) GB")));
    return std::stod(found[1]);
  };
  const double one_pair = gigabytes({});
  // Printed to a tenth: 0.05 of our own and three times 0.05.
  CHECK(std::abs(gigabytes({"--snap-bits", "4"}) - 3 * one_pair) < 0.21);
}

// A bare picture of this size takes a third of what may be used; finished, more than five times all of it.
TEST_CASE("exit code 3: the window counts the memory of its finished pictures") {
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  const int edge = std::min(65535, static_cast<int>(std::sqrt(0.8 * machine / 72)));
  const std::string size = std::to_string(edge) + "x" + std::to_string(edge);
  check_refused({"view", "good.toml", "--screenshot", "a.png", "-r", size}, 3, size);
}

TEST_CASE("exit code 5: light beyond what float holds is reported with its pixel and not written") {
  const Workplace here;
  std::string text = kGoodScene;
  text.replace(text.find("[1, 1, 1]"), 9, "[1e15, 1, 1]");
  text.replace(text.find("diffuse = [1, 0, 0]"), 19, "diffuse = 1e15\nlocal = 1e15");
  write_bytes(here / "bright.toml", text);
  for (const Arguments& arguments :
       {Arguments{"render", "bright.toml", "-o", "a.png"}, {"compare", "bright.toml", "-o", "out"}}) {
    const Outcome outcome = here.run(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 5);
    CHECK(lines(outcome.err).size() == 1);
    CHECK(outcome.err.find("pixel (") != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(here / "a.png"));

  // Here looking at it is the purpose: it is shown, and the code tells.
  const auto shown = [&](const Arguments& arguments) {
    const Outcome outcome = here.run(arguments + Arguments{"-r", "16x12"});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 5);
    CHECK(lines(outcome.err).size() == 1);
    CHECK(outcome.err.find("pixel (") != std::string::npos);
    return outcome.out;
  };
  CHECK(shown({"explain", "bright.toml", "--pixel", "8,6"}).find("z-buffer    (inf") != std::string::npos);
  CHECK(shown({"explain", "bright.toml", "--pixel", "8,6", "--json", "-"}).find("null") != std::string::npos);
#ifdef SIDELIGHT_HAVE_OSMESA
  shown({"view", "bright.toml", "--screenshot", "b.png"});
  CHECK(std::filesystem::exists(here / "b.png"));
#endif
}

TEST_CASE("exit code 6: no display") { check_refused({"view", "good.toml"}, 6, "display"); }
