// SPDX-License-Identifier: MIT
// [[mesh]] in its three sorts, and its transform.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <set>
#include <tuple>

#include "tests/scene/temp_folder.h"
#include "tests/scene/toml_text.h"

using namespace sidelight;
using glm::dvec3;
using test::error_of;
using test::kCamera;
using test::kMaterial;
using test::parse;

namespace {

// One triangle with a corner on each axis, under the transform.
const std::string kAxes =
    "[[mesh]]\nvertices = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nfaces = [[0, 1, 2]]\n"
    "material = 'm'\ntransform = ";

// Where the transform takes the unit points of the axes.
std::array<dvec3, 3> images_of_axes(const std::string& transform) {
  const Scene scene = parse(kAxes + transform);
  REQUIRE(scene.triangles.size() == 1);
  // A mirroring transform turns the triangle around, but not the positions.
  REQUIRE(scene.positions.size() == 3);
  return {scene.positions[0], scene.positions[1], scene.positions[2]};
}

std::size_t triangles_of(const std::string& shape) {
  return parse("[[mesh]]\nmaterial = 'm'\n" + shape).triangles.size();
}

}  // namespace

TEST_CASE("toml: a mesh written out") {
  const Scene scene = parse(R"([[mesh]]
vertices = [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 1e-31, -5]]
faces = [[0, 1, 2, 3], [2, 1, 0]]
material = "m"
)");
  REQUIRE(scene.objects.size() == 1);
  CHECK(scene.objects[0].count == 3);
  CHECK(scene.triangles.size() == 3);
  REQUIRE(scene.positions.size() == 4);
  CHECK(scene.positions[0] == dvec3(-5, 0, 5));
  CHECK(scene.positions[3] == dvec3(-5, 0, -5));
}

TEST_CASE("toml: generated shapes with their numbers and default segments") {
  CHECK(triangles_of("shape = 'box'\nsize = [1, 2, 3]") == 12);
  CHECK(triangles_of("shape = 'cylinder'\nradius = 1\nheight = 2\nsegments = 3") == 4 * 3);
  CHECK(triangles_of("shape = 'cylinder'\nradius = 1\nheight = 2") == 4 * 64);
  CHECK(triangles_of("shape = 'cone'\nradius = 1\nheight = 2\nsegments = 4096") == 2 * 4096);
  CHECK(triangles_of("shape = 'cone'\nradius = 1\nheight = 2") == 2 * 64);
  CHECK(triangles_of("shape = 'torus'\nradii = [2, 1]\nsegments = [5, 3]") == 2 * 5 * 3);
  CHECK(triangles_of("shape = 'torus'\nradii = [1.0, 0.3]") == 2 * 64 * 32);
}

TEST_CASE("toml: a transform's parts") {
  const auto moved = images_of_axes("{ translate = [10, 20, 30] }");
  CHECK(moved[0] == dvec3(11, 20, 30));
  const auto scaled = images_of_axes("{ scale = 2 }");
  CHECK(scaled[2] == dvec3(0, 0, 2));
  const auto stretched = images_of_axes("{ scale = [2, 3, -4] }");
  CHECK(stretched == std::array{dvec3(2, 0, 0), dvec3(0, 3, 0), dvec3(0, 0, -4)});
  const auto turned = images_of_axes("{ rotate = [0, 0, 30] }");
  CHECK(turned[0].x == doctest::Approx(std::sqrt(0.75)));
  CHECK(turned[0].y == doctest::Approx(0.5));
  CHECK(turned[2] == dvec3(0, 0, 1));
}

TEST_CASE("toml: quarter turns are exact") {
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  CHECK(images_of_axes("{ rotate = [90, 0, 0] }") == std::array{x, z, -y});
  CHECK(images_of_axes("{ rotate = [0, 90, 0] }") == std::array{-z, y, x});
  CHECK(images_of_axes("{ rotate = [0, 0, 90] }") == std::array{y, -x, z});
  CHECK(images_of_axes("{ rotate = [0, 0, -90] }") == std::array{-y, x, z});
  CHECK(images_of_axes("{ rotate = [0, 180, 0] }") == std::array{-x, y, -z});
  CHECK(images_of_axes("{ rotate = [0, 0, 270.0] }") == std::array{-y, x, z});
  CHECK(images_of_axes("{ rotate = [360, -720, 1e15] }") == images_of_axes("{ rotate = [0, 0, 280] }"));
}

TEST_CASE("toml: a transform is T Rz Ry Rx S") {
  // z is scaled to 2z, turned about x to -2y, about y left alone, about z to 2x, then moved.
  const auto image = images_of_axes("{ scale = [1, 1, 2], rotate = [90, 90, 90], translate = [0, 0, 5] }");
  CHECK(image[2] == dvec3(2, 0, 5));
  CHECK(image[0] == dvec3(0, 0, 4));  // x: about y to -z
}

TEST_CASE("toml: a matrix goes row by row") {
  const auto image = images_of_axes("{ matrix = [0, -1, 0, 10,  1, 0, 0, 20,  0, 0, 1, 30,  0, 0, 0, 1] }");
  CHECK(image == std::array{dvec3(10, 21, 30), dvec3(9, 20, 30), dvec3(10, 20, 31)});
}

TEST_CASE("toml: a mesh file relative to the scene, with the scene's material") {
  const TempFolder folder;
  folder.write("a.obj", "mtllib no-such.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\n");
  const Scene scene = parse_scene("mesh = [{ file = 'a.obj', material = 'm' }]" + kCamera + kMaterial,
                                  (folder.path / "scene.toml").string());
  REQUIRE(scene.triangles.size() == 1);
  CHECK(scene.materials.size() == 1);
  CHECK(scene.materials[scene.triangles[0].material].name == "m");
}

TEST_CASE("toml: a mesh file brings its own materials and warnings") {
  const TempFolder folder;
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
  folder.write(
      "a.obj",
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl green\nf 1 2 3\nusemtl red\nf 3 2 1\nl 1 2\n");
  const Scene scene =
      parse_scene("mesh = [{ file = 'a.obj' }]" + kCamera + kMaterial, (folder.path / "scene.toml").string());
  REQUIRE(scene.triangles.size() == 2);
  CHECK(scene.objects.size() == 1);
  CHECK(scene.materials[scene.triangles[0].material].diffuse == dvec3(0, 1, 0));
  CHECK(scene.materials[scene.triangles[1].material].diffuse == dvec3(1, 0, 0));
  CHECK_FALSE(scene.warnings.empty());
}

TEST_CASE("toml: a mesh file's face needs a material from somewhere") {
  const TempFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n  f 1 2 3\n");
  const std::string error =
      error_of("mesh = [{ file = 'a.obj' }]" + kCamera, (folder.path / "scene.toml").string());
  CHECK(error.find("a.obj:4:3: ") != std::string::npos);
  CHECK(error.find("before any usemtl") != std::string::npos);
}

TEST_CASE("toml: mesh files that are not there, folders, pipes and empty names") {
  const TempFolder folder;
  const std::string path = (folder.path / "scene.toml").string();
  for (const std::string name : {"gone.obj", ".", "", "/dev/null", "a\\u0000b"}) {
    CAPTURE(name);
    const std::string error =
        error_of("[[mesh]]\nfile = \"" + name + "\"\nmaterial = 'm'" + kCamera + kMaterial, path);
    CHECK(error.find("scene.toml:2:8: 'file' is ") != std::string::npos);
  }
}
