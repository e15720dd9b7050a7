// SPDX-License-Identifier: MIT
// Files that were spoilt in a few places are read or refused, never worse: a valid scene, or an InputError that begins
// with file:line:column. Seeded, so that a failure can be repeated; tests/fuzz searches the same ground by coverage.
//
// What keeps each of them short is not measured in seconds but by what the reader counts (Effort in toml_tables.h);
// its limits are tested here too, since spoilt files seldom reach them.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <regex>

#include "common/scene/toml.h"
#include "tests/agreement/pictures.h"
#include "tests/picture/folder.h"
#include "tests/scene/toml_text.h"
#include "tests/support/inert.h"
#include "tests/support/random.h"

using namespace sidelight;
using namespace sidelight::test;
using test::error_of;
using test::kCamera;
using test::kMaterial;
using test::Random;

namespace {

const std::string kSpoilt[] = {"nan",
                               "inf",
                               "-inf",
                               "1e400",
                               "-1e400",
                               "1e-400",
                               "-0.0",
                               "1e-45",
                               "1e15",
                               "1.0000001e15",
                               "1e308",
                               "9223372036854775807",
                               "-9223372036854775808",
                               "99999999999999999999",
                               "4096",
                               "0",
                               "-1",
                               "true",
                               "''",
                               "{}",
                               "[]",
                               "[[]]",
                               "{a={a={a={}}}}",
                               "1979-05-27T07:32:00Z",
                               "0x7f",
                               "\"\\uD800\"",
                               std::string(5000, '['),
                               std::string(5000, '{'),
                               "[" + std::string(5000, '0') + "]",
                               "'" + std::string(100'000, 'x') + "'",
                               "\xFF",
                               "\xE2\x80\xAE",
                               std::string("\0", 1),
                               "\x1B[2J"};

// One change of `text`, which is not empty.
void spoil(std::string& text, Random& random) {
  const auto place = [&] {
    return static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(text.size())));
  };
  const std::size_t at = place();
  const auto line = [&](std::size_t i) {  // first and length of the one with text[i], its end included
    const std::size_t first = text.rfind('\n', i == 0 ? 0 : i - 1) + 1, end = text.find('\n', i);
    const std::size_t from = first > i ? 0 : first;
    return std::pair(from, (end == std::string::npos ? text.size() : end + 1) - from);
  };
  switch (random.below(7)) {
    case 0:
      text[at] = static_cast<char>(random.below(256));
      return;
    case 1:
      text.erase(at, 1 + random.below(8));
      return;
    case 2:
      text.insert(at, 1, "[]{}=,.'\"#\\\n\0-9e"[random.below(16)]);
      return;
    case 3:
      text.resize(at + 1);
      return;
    case 4: {  // a line twice, or gone
      const auto [first, length] = line(at);
      const std::string copy = text.substr(first, length);
      if (random.below(2))
        text.erase(first, length);
      else
        text.insert(line(place()).first, copy);
      return;
    }
    default: {  // the word at hand, mostly a number or a name, becomes something else
      constexpr char kWord[] = "+-.0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ_abcdefghijklmnopqrstuvwxyz";
      const std::size_t first = text.find_first_of(kWord, at);
      if (first == std::string::npos) return;
      const std::size_t end = std::min(text.find_first_not_of(kWord, first), text.size());
      text.replace(first, end - first, kSpoilt[random.below(std::size(kSpoilt))]);
    }
  }
}

std::string spoilt(const std::string& whole, Random& random) {
  std::string text = whole;
  for (std::uint32_t changes = 1 + random.below(4); changes > 0 && !text.empty(); --changes)
    spoil(text, random);
  return text;
}

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// What renderers may rely on.
bool is_valid(const Scene& scene) {
  const std::size_t primitives = scene.triangles.size() + scene.spheres.size() + scene.planes.size();
  bool good = scene.primitive_object.size() == primitives && finite(scene.camera.eye) &&
              finite(scene.camera.look_at) && scene.camera.view_height > 0 && scene.width > 0 &&
              scene.height > 0 && scene.trace.depth > 0;
  for (const std::uint32_t object : scene.primitive_object) good = good && object < scene.objects.size();
  for (std::uint32_t i = 0; i < primitives; ++i)
    good = good && primitive_material(scene, i) < scene.materials.size();
  for (const Sphere& sphere : scene.spheres) good = good && finite(sphere.center) && sphere.radius > 0;
  for (const Plane& plane : scene.planes)
    good = good && finite(plane.point) && std::abs(glm::length(plane.normal) - 1) < 1e-12;
  for (const glm::dvec3& position : scene.positions) good = good && finite(position);
  return good;
}

// What is wrong with how the reader took `text`; empty if nothing.
std::string complaint(const std::string& text, const std::string& path, const std::regex& place) {
  try {
    return is_valid(parse_scene(text, path)) ? "" : "a scene that is not valid";
  } catch (const InputError& error) {
    const std::string said = error.what();
    if (!std::regex_search(said, place, std::regex_constants::match_continuous)) return "no place: " + said;
    if (said.size() > 3200) return "a message of " + std::to_string(said.size()) + " bytes";
    return harm_in(said);
  } catch (const std::exception& error) {
    return std::string("another exception: ") + error.what();
  }
}

}  // namespace

TEST_CASE("mutations: a spoilt scene file is read or refused at its line and column") {
  const std::regex place("[^:]*scene\\.toml:[1-9][0-9]*:[1-9][0-9]*: .");
  const std::vector<std::string> files = shipped_scenes();
  const std::uint64_t each = test::tier_count("mutated_files") / files.size() + 1;
  for (std::size_t file = 0; file < files.size(); ++file) {
    const std::string whole = read_bytes(files[file]);
    Random random(file);
    int refused = 0;
    for (std::uint64_t i = 0; i < each; ++i) {
      const std::string text = spoilt(whole, random);
      const std::string wrong = complaint(text, "/nowhere/scene.toml", place);
      refused += error_of(text) != "no error";
      if (wrong.empty()) continue;
      CAPTURE(files[file]);
      CAPTURE(i);
      CHECK(wrong == "");
    }
    CHECK(refused > 0);  // else this file was not spoilt at all
  }
}

TEST_CASE("mutations: a spoilt mesh or material file is read or refused at its line and column") {
  const TemporaryFolder folder;
  const std::string mesh =
      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvt 0 0\nusemtl red\nf 1//1 3//1 2//1\nf 1 "
      "2 4\n"
      "f 2 3 4\nf 3 1 4\nusemtl glass\nf -4/1 -3/1 -2/1\nv 1 1 0\nf 1 2 5 \\\n 3\n";
  const std::string materials =
      "newmtl red\nKa 0.1\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 20\nnewmtl glass\nTf 0.9\nNi 1.5\nillum 7\n";
  const std::string scene = "[[mesh]]\nfile = 'm.obj'\n" + kCamera;
  // A file that ceases to be readable, or to name its materials, is a mistake in the file that needs it.
  const std::regex place("[^:]*(m\\.obj|m\\.mtl|scene\\.toml):[1-9][0-9]*:[1-9][0-9]*: .");
  Random random(1);
  for (std::uint64_t i = 0; i < test::tier_count("mutated_files"); ++i) {
    const bool spoil_mesh = random.below(2) == 0;
    write_bytes(folder / "m.obj", spoil_mesh ? spoilt(mesh, random) : mesh);
    write_bytes(folder / "m.mtl", spoil_mesh ? materials : spoilt(materials, random));
    const std::string wrong = complaint(scene, folder / "scene.toml", place);
    if (wrong.empty()) continue;
    CAPTURE(i);
    CHECK(wrong == "");
  }
}

TEST_CASE("effort: steps count the shapes that they change") {
  // 262,144 quads make 524,288 triangles; eight of those are the limit of 2^22.
  std::string text = kCamera + kMaterial +
                     "[[mesh]]\nshape = 'torus'\nradii = [2, 1]\nsegments = [4096, 64]\nmaterial = 'm'\n";
  for (int step = 0; step < 7; ++step) text += "[[step]]\ntext = ''\nset = { \"mesh.0.material\" = 'm' }\n";
  CHECK(error_of(text) == "no error");
  text += "[[step]]\ntext = ''\nset = { \"trace.depth\" = 1 }\n";  // changes no shape
  CHECK(error_of(text) == "no error");
  CHECK(error_of(text + "[[step]]\ntext = ''\nset = { \"mesh.0.material\" = 'm' }\n")
            .find("4718592 triangles of generated shapes") != std::string::npos);
}

TEST_CASE("effort: a mesh file counts as often as it is read") {
  const TemporaryFolder folder;
  write_bytes(folder / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n#");
  std::filesystem::resize_file(folder / "m.obj", 256u << 20);  // sparse; the rest is one comment
  std::string text = kCamera + kMaterial;
  for (int i = 0; i < 17; ++i) text += "[[mesh]]\nfile = 'm.obj'\nmaterial = 'm'\n";  // 4.25 GiB
  CHECK(error_of(text, folder / "scene.toml")
            .find("scene.toml:56:8: 'file' is the text 'm.obj', expected mesh files of at most 4 GiB") !=
        std::string::npos);
}

TEST_CASE("effort: faces of many corners count as often as their mesh is read") {
  const TemporaryFolder folder;
  // 34 faces of 10,000 corners, along a parabola: convex, and so soon in triangles, but what they cost is not foreseen.
  std::string mesh, face = "f";
  for (int i = 0; i < 10'000; ++i) {
    mesh += "v " + std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
    face += " " + std::to_string(1 + i);
  }
  for (int i = 0; i < 34; ++i) mesh += face + "\n";
  write_bytes(folder / "m.obj", mesh);
  const std::string table = "[[mesh]]\nfile = 'm.obj'\nmaterial = 'm'\n";
  const std::string step = "[[step]]\ntext = ''\nset = { \"mesh.0.material\" = 'm' }\n";
  const std::string start = kCamera + kMaterial + table + table;
  const auto mistake = [&](const std::string& text) { return error_of(text, folder / "scene.toml"); };
  const std::string too_much =
      "with this mesh the squares of the faces' corner counts add up to 1.02e+10 (again for each step "
      "that changes one), expected at most 1e+10";
  CHECK(mistake(start) == "no error");
  CHECK(mistake(start + table).find(too_much) != std::string::npos);
  CHECK(mistake(start + step).find(too_much) != std::string::npos);
}

TEST_CASE("effort: a mesh file has at most 64 material files, however they are named") {
  const TemporaryFolder folder;
  write_bytes(folder / "m.mtl", "newmtl red\n");
  std::string text, name = "m.mtl";
  for (int i = 0; i < 65; ++i, name = "./" + name) text += "mtllib " + name + "\n";
  write_bytes(folder / "m.obj", text);
  CHECK(error_of("[[mesh]]\nfile = 'm.obj'\n" + kCamera, folder / "scene.toml")
            .find("m.obj:65:8: more than 64 material files") != std::string::npos);
}

TEST_CASE("effort: files of no size that never end are not read") {
  // A pipe in a mesh's or material file's place is refused; /proc/kmsg would be a regular file of size 0 that blocks.
  const TemporaryFolder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  const std::string scene = "[[mesh]]\nfile = 'm.obj'\n" + kCamera;
  write_bytes(folder / "m.obj", "mtllib pipe\n");
  CHECK(error_of(scene, folder / "scene.toml").find("m.obj:1:8: cannot read") != std::string::npos);
  write_bytes(folder / "m.obj", "mtllib /dev/zero\n");
  CHECK(error_of(scene, folder / "scene.toml").find("m.obj:1:8: cannot read") != std::string::npos);
}
