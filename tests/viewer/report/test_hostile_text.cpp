// SPDX-License-Identifier: MIT
// Text of a scene, of its files and of the command line is inert wherever the program shows it: on standard output, on
// standard error, in JSON and in the metadata of pictures. Each case puts escape sequences, C1 controls, bidirectional
// overrides, zero-width characters, NUL and great length into one channel and runs the verbs on it.
#include <nlohmann/json.hpp>

#include "common/picture/image_io.h"
#include "tests/support/inert.h"
#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// As TOML writes it between double quotes: valid TOML, and all of it reaches the program.
const std::string kHostile =
    "\\u001B[2J\\u001B]52;c;aGk=\\u0007\\u009B31m\\u202E\\u2066\\u200B\\uFEFF\\u2028\\u0000\\u007F\\r\\n\\b"
    "\\U000E0041<script>alert(1)</script>{}%s%n";
// What a file's name can hold of it (no NUL, no slash), and a byte that is not UTF-8.
const std::string kHostileName =
    "\x1B[2J\x1B]52;c;aGk=\x07\xC2\x9B\xE2\x80\xAE\xEF\xBB\xBF\r\n\x7F\xFF\xC0\x80{}";
const std::string kLong(1 << 20, 'A');

// The longest line: a message (2000 bytes and a little), its file's name (1000) and its place.
constexpr std::size_t kMostOfALine = 3200;

void check_inert(const Outcome& outcome) {
  for (const std::string& text : {outcome.out, outcome.err}) {
    CHECK(harm_in(text) == "");
    for (const std::string& line : lines(text)) CHECK(line.size() <= kMostOfALine);
  }
}

void check_inert(const nlohmann::json& json) {
  if (json.is_string()) CHECK(harm_in(json.get<std::string>()) == "");
  if (json.is_structured())
    for (const auto& child : json) check_inert(child);
}

void check_metadata(const std::string& picture) {
  const ImageFile image = read_image(picture);
  for (const char* name : {"program", "renderer", "scene", "scene_hash", "size", "samples_per_pixel", "depth",
                           "shadows", "reflection", "refraction"}) {
    CAPTURE(name);
    CHECK(image.metadata.count(name) == 1);
  }
  for (const auto& [name, value] : image.metadata) {
    CAPTURE(name);
    CHECK(harm_in(value) == "");
    CHECK(value.find('\n') == std::string::npos);
    CHECK(value.size() <= 1000 + 18);  // as printable() bounds it
  }
}

// All verbs on a valid scene.
void check_verbs(const Workplace& here, const std::string& scene) {
  const Arguments small{scene, "-r", "16x12"};
  const auto fine = [&](const Arguments& arguments) {
    CAPTURE(arguments[0]);
    const Outcome outcome = here.run(arguments);
    CHECK(outcome.code == 0);
    check_inert(outcome);
    return outcome;
  };
  fine(Arguments{"info"} + small);
  fine(Arguments{"explain"} + small + Arguments{"--pixel", "8,6"});
  check_inert(nlohmann::json::parse(
      fine(Arguments{"explain"} + small + Arguments{"--pixel", "8,6", "--json", "-"}).out));
  check_inert(nlohmann::json::parse(
      fine(Arguments{"render"} + small + Arguments{"-o", "a.exr", "--stats", "-"}).out));
  fine(Arguments{"render"} + small + Arguments{"-o", "a.png"});
  check_metadata(here / "a.exr");
  check_metadata(here / "a.png");
  fine(Arguments{"compare"} + small + Arguments{"-o", "out"});
  check_inert(nlohmann::json::parse(read_bytes(here / "out/compare.json")));
  check_metadata(here / "out/side_by_side.png");
  fine(Arguments{"bench"} + small + Arguments{"-o", "bench", "--no-times", "--set", "samples=1"});
  check_inert(nlohmann::json::parse(read_bytes(here / "bench/bench.json")));
#ifdef SIDELIGHT_HAVE_OSMESA
  fine(Arguments{"view"} + small + Arguments{"--screenshot", "view.png"});
  check_metadata(here / "view.png");
#endif
}

void check_verbs(const std::string& scene_text) {
  const Workplace here;
  write_bytes(here / "hostile.toml", scene_text);
  check_verbs(here, "hostile.toml");
}

// The good scene with material "red" under another name, as TOML writes it in quotes.
std::string with_material(const std::string& name) {
  std::string text = kGoodScene;
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  };
  replace("[material.red]", "[material.\"" + name + "\"]");
  replace("'red'", "\"" + name + "\"");
  return text;
}

// Refused as bad input, in one line that begins with a place.
void check_refused(const Workplace& here, const std::string& scene) {
  for (const char* verb : {"info", "compare"}) {
    Arguments command{verb, scene};
    if (std::string(verb) == "compare") command = command + Arguments{"-o", "out"};
    const Outcome outcome = here.run(command);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(outcome.out.empty());
    CHECK(lines(outcome.err).size() == 1);
    check_inert(outcome);
  }
}

const std::string kOwnMaterials = "[[mesh]]\nfile = 'm.obj'\n";
const std::string kFace = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl ";

}  // namespace

TEST_CASE("hostile text: title, lesson, steps") {
  const std::string quoted = "\"" + kHostile + "\"",
                    steps = "[[step]]\ntext = " + quoted + "\nset = { \"title\" = " + quoted + " }\n";
  check_verbs("title = " + quoted + "\nlesson = " + quoted + "\n" + kGoodScene + steps);
  check_verbs("title = '" + kLong + "'\nlesson = '" + kLong + "'\n" + kGoodScene + "[[step]]\ntext = '" +
              kLong + "'\n");
}

TEST_CASE("hostile text: names of materials") {
  check_verbs(with_material(kHostile));
  check_verbs(with_material(kLong));
}

TEST_CASE("hostile text: a scene file's name") {
  const Workplace here;
  write_bytes(here / kHostileName, kGoodScene);
  check_verbs(here, kHostileName);
  check_refused(here, kHostileName + "-which-is-not-there");
  check_refused(here, kHostileName + std::string(100'000, 'A'));
}

TEST_CASE("hostile text: names in mesh files, in warnings and messages") {
  const Workplace here;
  write_bytes(here / "m.obj", "mtllib m.mtl\n\x1B[2J 1 2\n\xC2\x9B \xE2\x80\xAE\n" + kFace +
                                  kHostileName.substr(0, 4) + "\xFF\xE2\x80\xAE" + kLong + "\nf 1 2 3\n");
  write_bytes(here / "m.mtl", "newmtl " + kHostileName.substr(0, 4) + "\xFF\xE2\x80\xAE" + kLong +
                                  "\n\x1B]0;title\x07 1\nKd 1 0 0\nillum 9\n");
  write_bytes(here / "mesh.toml", kGoodScene + kOwnMaterials);
  check_verbs(here, "mesh.toml");

  for (const std::string& bytes :
       {std::string("\x1B[2J"), std::string("\xC2\x9B\xE2\x80\xAE\xFF"), std::string("\0", 1), kLong}) {
    for (const std::string& line :
         {"v " + bytes, "f 1 " + bytes, "usemtl " + bytes, "mtllib " + bytes, "f " + bytes}) {
      write_bytes(here / "m.obj", "v 0 0 0\n" + line + "\n");
      check_refused(here, "mesh.toml");
    }
    write_bytes(here / "m.obj", "mtllib m.mtl\n");
    for (const std::string& line :
         {"Kd " + bytes, bytes, "newmtl a\nNs " + bytes, "newmtl a\nKd 1 1 1 " + bytes}) {
      write_bytes(here / "m.mtl", line + "\n");
      check_refused(here, "mesh.toml");
    }
  }
}

TEST_CASE("hostile text: a mesh file's name") {
  const Workplace here;
  write_bytes(here / "\x1B[2J\xC2\x9B.obj", "l 1 2\n" + kFace.substr(0, kFace.find("usemtl")) + "f 1 2 3\n");
  write_bytes(here / "mesh.toml",
              kGoodScene + "[[mesh]]\nfile = \"\\u001B[2J\\u009B.obj\"\nmaterial = 'red'\n");
  check_verbs(here, "mesh.toml");
  for (const std::string& name : {kHostile, kLong}) {
    write_bytes(here / "mesh.toml", kGoodScene + "[[mesh]]\nfile = \"" + name + "\"\nmaterial = 'red'\n");
    check_refused(here, "mesh.toml");
  }
}

TEST_CASE("hostile text: mistakes in a scene file") {
  const Workplace here;
  for (const std::string& name : {kHostile, kLong}) {
    const std::string quoted = "\"" + name + "\"";
    for (const std::string& text :
         {quoted + " = 1\n" + kGoodScene, "[" + quoted + "]\n" + kGoodScene,
          kGoodScene + "[[" + quoted + "]]\n", "title = 1\ntitle = " + quoted + "\n" + kGoodScene,
          "ambient = " + quoted + "\n" + kGoodScene,
          kGoodScene + "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = " + quoted + "\n",
          kGoodScene + "[[mesh]]\nshape = " + quoted + "\n",
          kGoodScene + "[material." + quoted + "]\nior = 9\n",
          kGoodScene + "[[step]]\ntext = ''\nmode = " + quoted + "\n",
          kGoodScene + "[[step]]\ntext = ''\nset = { " + quoted + " = 1 }\n",
          kGoodScene + "[[step]]\ntext = ''\nset = { \"trace.depth\" = " + quoted + " }\n"}) {
      write_bytes(here / "bad.toml", text);
      check_refused(here, "bad.toml");
    }
  }
  for (const std::string& bytes :
       {std::string("\x1B[2J"), std::string("\xFF"), std::string("\xC0\x80"), std::string("\xED\xA0\x80"),
        std::string("\0", 1), std::string("\xE2\x80\xAE"), std::string("\xC2\x9B"), kLong}) {
    for (const std::string& text :
         {bytes + "\n" + kGoodScene, bytes + " = 1\n" + kGoodScene, "title = " + bytes + "\n" + kGoodScene,
          "title = 1\n" + kGoodScene + "# " + bytes}) {
      write_bytes(here / "bad.toml", text);
      check_refused(here, "bad.toml");
    }
  }
}

TEST_CASE("hostile text: arguments") {
  const Workplace here;
  const std::string name = kHostileName;
  const auto check = [&](int code, const Arguments& arguments) {
    const Outcome outcome = here.run(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == code);
    CHECK(lines(outcome.err).size() == 1);
    check_inert(outcome);
  };
  for (const std::string& text : {name, std::string(100'000, 'A')}) {
    check(2, {text});
    check(2, {"info", "good.toml", text});
    check(2, {"info", "good.toml", "--" + text});
    check(2, {"render", "good.toml", "-o", text});
    check(2, {"explain", "good.toml", "--pixel", text});
    check(2, {"view", "good.toml", "--screenshot", "a.png", "--size", text});
    for (const char* flag :
         {"-r", "--spp", "--depth", "--crop", "-j", "--isa", "--renderer", "--layers", "--repeat"})
      check(2, {"render", "good.toml", "-o", "a.exr", flag, text});
    check(7, {"render", "good.toml", "-r", "16x12", "-o", text + "/a.png"});
    check(7, {"compare", "good.toml", "-r", "16x12", "-q", "-o", "good.toml/" + text});
  }
  const Outcome outcome = here.run({"compare", "good.toml", "-r", "16x12", "-o", name});
  CHECK(outcome.code == 0);
  check_inert(outcome);
}
