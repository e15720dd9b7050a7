// SPDX-License-Identifier: MIT
// The OBJ reader: what it accepts, and every kind of mistake with its line and column.
#include "common/scene/obj.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/scene/temp_folder.h"
#include "tests/support/text.h"

using namespace sidelight;
using glm::dvec3;
using test::contains;

namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

ObjFile parsed(const std::string& text, bool with_materials = false) {
  const TempFolder folder;
  return read_obj(folder.write("t.obj", text), with_materials);
}

// What read_obj throws for the file `name` of the folder, with the folder's own path taken out; empty for nothing.
std::string mistake(const TempFolder& folder, const std::string& name, bool with_materials) {
  std::string message;
  try {
    read_obj((folder.path / name).string(), with_materials);
  } catch (const InputError& error) {
    message = error.what();
  }
  const std::string prefix = folder.path.string() + "/";
  for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
    message.erase(at, prefix.size());
  return message;
}

// The same for a file of this text beside m.mtl.
std::string mistake(const std::string& text, bool with_materials = true) {
  static const TempFolder folder;
  static const std::string library =
      folder.write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl dark green\nKd 0 .2 0\n");
  folder.write("t.obj", text);
  return mistake(folder, "t.obj", with_materials);
}

std::vector<std::uint32_t> face_positions(const PolygonMesh& mesh, std::size_t face) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t k = 0; k < mesh.faces[face].count; ++k)
    numbers.push_back(mesh.corners[mesh.faces[face].first + k].position);
  return numbers;
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

}  // namespace

TEST_CASE("obj: vertices, normals and all forms of corners") {
  const ObjFile obj = parsed("# a comment\n" + kTriangle +
                             "vn 0 0 1\nvn 0 0 2\nvt 0.5\nvt 0.5 0.5\nvt 0.5 0.5 0\n"
                             "o thing\ng a b\ns off\n"
                             "f 1 2 3\n"
                             "  f 1/1 2/2 3/3\n"
                             "f 1//1 2//1 3//2\n"
                             "f 1/1/1 2/2/1 3/3/2\n"
                             "f -3 -2 -1\n"
                             "f -3//-2 -2//-2 -1//-1\n");
  CHECK(obj.warnings.empty());
  REQUIRE(obj.mesh.faces.size() == 6);
  CHECK(obj.mesh.positions == std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(obj.mesh.normals == std::vector<dvec3>{{0, 0, 1}, {0, 0, 2}});
  for (std::size_t face = 0; face < 6; ++face) {
    CAPTURE(face);
    CHECK(face_positions(obj.mesh, face) == std::vector<std::uint32_t>{0, 1, 2});
    const bool has_normals = face == 2 || face == 3 || face == 5;
    CHECK(obj.mesh.corners[obj.mesh.faces[face].first].normal == (has_normals ? 0 : kNone));
    CHECK(obj.mesh.corners[obj.mesh.faces[face].first + 2].normal == (has_normals ? 1 : kNone));
    CHECK(obj.mesh.faces[face].material == kNone);
  }
  CHECK(obj.mesh.faces[1].line == 14);
  CHECK(obj.mesh.faces[1].column == 3);
}

TEST_CASE("obj: negative indices count back from where they stand") {
  const ObjFile obj = parsed(kTriangle + "f -1 -2 -3\n" + kTriangle + "f -1 -2 -3\n");
  CHECK(face_positions(obj.mesh, 0) == std::vector<std::uint32_t>{2, 1, 0});
  CHECK(face_positions(obj.mesh, 1) == std::vector<std::uint32_t>{5, 4, 3});
}

TEST_CASE("obj: numbers are the doubles they say") {
  const ObjFile obj = parsed(
      "v +1.5 -.5 1.\n"
      "v 1e-45 4.9e-324 -0.0\n"
      "v 0.1 1e300 123456789012345678\n"
      "v 1e-400 -1e-4000 0.30000000000000004\n");
  CHECK(obj.mesh.positions[0] == dvec3(1.5, -0.5, 1));
  CHECK(obj.mesh.positions[1] == dvec3(1e-45, std::numeric_limits<double>::denorm_min(), 0));
  CHECK(obj.mesh.positions[2] == dvec3(0.1, 1e300, 123456789012345678.0));
  CHECK(obj.mesh.positions[3] == dvec3(0, 0, 0.1 + 0.2));
}

TEST_CASE("obj: line ends, tabs, comments and continued lines") {
  const std::vector<std::pair<const char*, std::string>> files{
      {"plain", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"no final newline", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"},
      {"CRLF", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n"},
      {"tabs and blanks", "\tv\t0 0\t0  \nv 1  0 0\t\n \n\n  v 0 1 0\nf\t1 2\t3 \t"},
      {"comments", "#v 9 9 9\nv 0 0 0 # origin\nv 1 0 0 #\nv 0 1 0\n#\nf 1 2 3 #1 2"},
      {"continued", "v 0 0 \\\n0\nv 1 0\\\n 0\nv \\\r\n0 1 0\nf 1 \\\n2 \\\n\\\n3"},
      {"byte order mark", "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
  };
  for (const auto& [name, text] : files) {
    CAPTURE(name);
    const ObjFile obj = parsed(text);
    CHECK(obj.warnings.empty());
    CHECK(obj.mesh.positions == std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    REQUIRE(obj.mesh.faces.size() == 1);
    CHECK(face_positions(obj.mesh, 0) == std::vector<std::uint32_t>{0, 1, 2});
  }
}

TEST_CASE("obj: empty files, files of comments, and a very long line") {
  CHECK(parsed("").mesh.faces.empty());
  CHECK(parsed("# nothing").mesh.faces.empty());
  CHECK(parsed("o a\n\\\n\\").warnings.size() == 1);
  const std::string blanks(1'000'000, ' ');
  CHECK(parsed(kTriangle + "f 1" + blanks + "2" + blanks + "3").mesh.faces.size() == 1);
  CHECK(mistake(kTriangle + "f 1" + blanks + "2" + blanks + "x") ==
        "t.obj:4:2000005: 'x' is not a corner, expected v, v/vt, v//vn or v/vt/vn in whole numbers");
}

TEST_CASE("obj: a face of ten thousand corners, and not one more") {
  CHECK(parsed(kTriangle + "f" + repeated(" 1", 10'000)).mesh.corners.size() == 10'000);
  CHECK(mistake(kTriangle + "f" + repeated(" 1", 10'001)) ==
        "t.obj:4:20003: a face of more than 10000 corners");
}

TEST_CASE("obj: mistakes name their line and column") {
  const std::vector<std::pair<std::string, std::string>> table{
      // numbers
      {"v 1 2", "t.obj:1:1: v with 2 numbers, expected 3, 4, 6 or 7"},
      {"v", "t.obj:1:1: v with 0 numbers"},
      {"v 1 2 3 4 5", "t.obj:1:1: v with 5 numbers"},
      {"v 1 2 3 4 5 6 7 8", "t.obj:1:17: '8' is one number too many for v, expected 3, 4, 6 or 7"},
      {"v 1 two 3", "t.obj:1:5: 'two' is not a number"},
      {"v 1 2 3x", "t.obj:1:7: '3x' is not a number"},
      {"v 0x10 2 3", "t.obj:1:3: '0x10' is not a number"},
      {"v 1,5 2 3", "t.obj:1:3: '1,5' is not a number"},
      {"v +-1 2 3", "t.obj:1:3: '+-1' is not a number"},
      {"v + 2 3", "t.obj:1:3: '+' is not a number"},
      {"v 1 nan 3", "t.obj:1:5: 'nan' is not a finite number"},
      {"v 1 2 -inf", "t.obj:1:7: '-inf' is not a finite number"},
      {"v 1e400 2 3", "t.obj:1:3: '1e400' is not a finite number"},
      {"v 1 2 3 nan", "t.obj:1:9: 'nan' is not a finite number"},
      {"\n\n\tv 1 \\\n  2 \\\n x", "t.obj:5:2: 'x' is not a number"},
      {"v 1 2 \x01\x1b[31m", "t.obj:1:7: '\\x01\\x1B[31m' is not a number"},
      {"vn 1 2", "t.obj:1:1: vn with 2 numbers, expected 3"},
      {"vn 1 2 3 4", "t.obj:1:10: '4' is one number too many for vn, expected 3"},
      {"vn 0 0 inf", "t.obj:1:8: 'inf' is not a finite number"},
      {"vt", "t.obj:1:1: vt with 0 numbers, expected 1, 2 or 3"},
      {"vt 0 z", "t.obj:1:6: 'z' is not a number"},
      // faces
      {kTriangle + "f", "t.obj:4:1: a face of 0 corners, expected at least 3"},
      {kTriangle + " f 1 2", "t.obj:4:2: a face of 2 corners, expected at least 3"},
      {kTriangle + "f 1 2 4", "t.obj:4:7: index '4' of v, expected 1 to 3 or -3 to -1"},
      {kTriangle + "f 1 0 2", "t.obj:4:5: index '0' of v, expected 1 to 3 or -3 to -1"},
      {kTriangle + "f 1 2 -4", "t.obj:4:7: index '-4' of v"},
      {kTriangle + "f 1 2 2147483648", "t.obj:4:7: index '2147483648' of v"},
      {kTriangle + "f 1 2 4294967297", "t.obj:4:7: index '4294967297' of v"},
      {kTriangle + "f 1 2 99999999999999999999", "t.obj:4:7: index '99999999999999999999' of v"},
      {kTriangle + "f 1 2 -99999999999999999999", "t.obj:4:7: index '-99999999999999999999' of v"},
      {"f 1 2 3\n" + kTriangle,
       "t.obj:1:3: index '1' of v, expected none, since there is no v before this line"},
      {kTriangle + "f 1/1 2/1 3/1", "t.obj:4:5: index '1' of vt, expected none"},
      {kTriangle + "vt 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1", "t.obj:6:11: index '2' of vt, expected 1 to 1"},
      {kTriangle + "vn 0 0 1\nf 1//1 2//2 3//1", "t.obj:5:11: index '2' of vn, expected 1 to 1"},
      {kTriangle + "vt 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/-2", "t.obj:6:19: index '-2' of vn"},
      {kTriangle + "vn 0 0 1\nf 1//1 2 3//1",
       "t.obj:5:8: some corners of the face have a normal and some have none"},
      {kTriangle + "vn 0 0 1\nf 1 2 3//1",
       "t.obj:5:7: some corners of the face have a normal and some have none"},
      {kTriangle + "f 1 2 a", "t.obj:4:7: 'a' is not a corner, expected v, v/vt, v//vn or v/vt/vn"},
      {kTriangle + "f 1 2 3.0", "t.obj:4:7: '3.0' is not a corner"},
      {kTriangle + "f 1 2 /1", "t.obj:4:7: '/1' is not a corner"},
      {kTriangle + "f 1 2 3/", "t.obj:4:9: '3/' is not a corner"},
      {kTriangle + "vt 0\nf 1 2 3/1/", "t.obj:5:11: '3/1/' is not a corner"},
      {kTriangle + "vt 0\nvn 0 0 1\nf 1/1/1/1 2 3", "t.obj:6:3: '1/1/1/1' is not a corner"},
      // other files
      {"# made by hand\nply\nformat ascii 1.0\nelement vertex 3",
       "t.obj:2:1: not one statement of a Wavefront OBJ file, expected v and f"},
      {"solid cube\nfacet normal 0 0 1\nendsolid", "t.obj:1:1: not one statement of a Wavefront OBJ file"},
      // materials
      {"usemtl red", "t.obj:1:8: unknown material 'red', and no mtllib before this line defines any"},
      {"mtllib m.mtl\nusemtl  rde", "t.obj:2:9: unknown material 'rde', the nearest is 'red'"},
      {"mtllib m.mtl\nusemtl dark  grene",
       "t.obj:2:8: unknown material 'dark grene', the nearest is 'dark green'"},
      {"mtllib m.mtl\nusemtl", "t.obj:2:1: usemtl without a name"},
      {"mtllib # none", "t.obj:1:1: mtllib without a file"},
      {"mtllib m.mtl gone.mtl", "t.obj:1:14: cannot read 'gone.mtl': No such file or directory"},
      {"mtllib .", "t.obj:1:8: cannot read '.': not a regular file"},
      {"mtllib" + repeated(" m.mtl", 65), "t.obj:1:392: more than 64 material files"},
  };
  for (const auto& [text, expected] : table) {
    CAPTURE(text);
    const std::string found = mistake(text);
    INFO("expected: ", expected);
    CHECK(found.substr(0, expected.size()) == expected);
  }
}

TEST_CASE("obj: files that cannot be read") {
  const TempFolder folder;
  CHECK(mistake(folder, "gone.obj", false) == "gone.obj: cannot read 'gone.obj': No such file or directory");
  std::filesystem::create_directory(folder.path / "folder.obj");
  CHECK(mistake(folder, "folder.obj", false) == "folder.obj: cannot read 'folder.obj': not a regular file");
  folder.write("large.obj", "");
  std::filesystem::resize_file(folder.path / "large.obj", (1u << 30) + 1);  // sparse
  CHECK(mistake(folder, "large.obj", false) ==
        "large.obj: cannot read 'large.obj': 1073741825 bytes, expected at most 1 GiB");
}

TEST_CASE("obj: what is skipped is named once, where it is first") {
  const ObjFile obj = parsed(
      "v 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0 .1 .2 .3\n"
      "l 1 2\nl 2 3\np 1\ncurv 0 1 1 2\nf 1 2 3\n",
      true);
  CHECK(obj.mesh.faces.size() == 1);
  REQUIRE(obj.warnings.size() == 4);
  CHECK(contains(obj.warnings[0], "t.obj:1:1: numbers of v after x y z are skipped"));
  CHECK(contains(obj.warnings[1], "t.obj:4:1: 'l' statements are skipped"));
  CHECK(contains(obj.warnings[2], "t.obj:6:1: 'p' statements are skipped"));
  CHECK(contains(obj.warnings[3], "t.obj:7:1: 'curv' statements are skipped"));

  std::string noise = "o noise\n";
  for (int i = 0; i < 1000; ++i) noise += "kind" + std::to_string(i) + " 1 2\n";
  CHECK(parsed(noise).warnings.size() == 17);
}

TEST_CASE("obj: materials, in the order of first use") {
  const TempFolder folder;
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nnewmtl unused\n");
  folder.write("b c.mtl", "newmtl dark green\nKd 0 .2 0\nnewmtl red\nKd .5 0 0\n");
  const std::string path =
      folder.write("t.obj", kTriangle +
                                "f 1 2 3\nmtllib a.mtl a.mtl\nmtllib b c.mtl\n"
                                "usemtl unused\nusemtl dark   green\nf 1 2 3\nusemtl red\nf 1 2 3\n"
                                "usemtl dark green\nf 1 2 3\n");
  const ObjFile obj = read_obj(path, true);
  REQUIRE(obj.materials.size() == 2);
  CHECK(obj.materials[0].name == "dark green");
  CHECK(obj.materials[1].name == "red");
  CHECK(obj.materials[1].diffuse == dvec3(1, 0, 0));
  const std::vector<std::uint32_t> expected{kNone, 0, 1, 0};
  for (std::size_t i = 0; i < 4; ++i) CHECK(obj.mesh.faces[i].material == expected[i]);
  CHECK(obj.files ==
        std::vector<std::string>{path, (folder.path / "a.mtl").string(), (folder.path / "b c.mtl").string()});
  REQUIRE(obj.warnings.size() == 1);
  CHECK(contains(obj.warnings[0], "t.obj:6:8: materials that an earlier file defines are skipped"));

  const ObjFile bare = read_obj(path, false);
  CHECK(bare.materials.empty());
  CHECK(bare.files.size() == 1);
  for (const PolygonMesh::Face& face : bare.mesh.faces) CHECK(face.material == kNone);
}

TEST_CASE("obj: without materials, MTL files and usemtl do not matter") {
  CHECK(mistake("mtllib gone.mtl\nusemtl gone\n" + kTriangle + "f 1 2 3", false) == "");
}

TEST_CASE("obj: mutilated files are read or refused, never worse") {
  const std::string whole =
      kTriangle + "vn 0 0 1\nvt 0 0\nmtllib m.mtl\nusemtl red\nf 1/1/1 2/1/1 3/1/1\nl 1 2\n";
  for (std::size_t length = 0; length <= whole.size(); ++length) mistake(whole.substr(0, length));
  std::uint64_t state = 1;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>(state >> 33) % below;
  };
  const std::string bytes("\0\n\\#/- e9vf\xFF", 12);
  for (int i = 0; i < 500; ++i) {
    std::string text = whole;
    for (int k = 0; k < 3; ++k) text[random(text.size())] = bytes[random(bytes.size())];
    mistake(text);
  }
}
