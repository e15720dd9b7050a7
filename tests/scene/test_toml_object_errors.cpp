// SPDX-License-Identifier: MIT
// Mistakes in the tables of a scene file that make objects; rows as in test_toml_errors.cpp.
#include <doctest/doctest.h>

#include <string>

#include "tests/scene/toml_text.h"

using namespace sidelight;
using test::check;
using test::error_of;
using test::kCamera;
using test::kMaterial;

TEST_CASE("toml errors: spheres and planes") {
  const std::string sphere = "[[sphere]]\ncenter = [0, 0, 0]\n", plane = "[[plane]]\npoint = [0, 0, 0]\n";
  check({{sphere + "radius = 0\nmaterial = 'm'", "3:10", "'radius' is 0, expected a length above 0"},
         {sphere + "radius = -1\nmaterial = 'm'", "3:10", "'radius' is -1"},
         {sphere + "radius = 9e-31\nmaterial = 'm'", "3:10", "'radius' is 9e-31"},
         {sphere + "radius = 2e15\nmaterial = 'm'", "3:10", "'radius' is 2e+15"},
         {sphere + "radius = 1\nmaterial = 'n'", "4:12",
          "'material' is the text 'n', expected a material: one of m; did you mean 'm'?"},
         {sphere + "radius = 1\nmaterial = 1", "4:12", "expected a text"},
         {plane + "normal = [0, 0, 0]\nmaterial = 'm'", "3:10", "expected a direction"},
         {plane + "normal = 1\nmaterial = 'm'", "3:10", "expected an array of 3"}});
  CHECK(
      error_of(sphere + "radius = 1\nmaterial = 'm'" + kCamera).find("a material: one, but there are none") !=
      std::string::npos);
  std::string many;  // of which a message names 20
  for (int i = 10; i < 31; ++i) many += "[material.n" + std::to_string(i) + "]\n";
  CHECK(error_of(sphere + "radius = 1\nmaterial = 'other'" + kCamera + many).find("n28, n29, ...") !=
        std::string::npos);
}

TEST_CASE("toml errors: meshes written out") {
  const std::string mesh = "[[mesh]]\nmaterial = 'm'\n",
                    three = mesh + "vertices = [[0,0,0],[1,0,0],[0,1,0]]\n";
  std::string huge = "[0";
  for (int i = 0; i < 10'000; ++i) huge += ",0";
  check({{mesh + "file = 'a.obj'\nshape = 'box'", "4:1", "has 'file' and 'shape', expected exactly one of"},
         {mesh + "file = 'a.obj'\nvertices = []", "4:1", "has 'file' and 'vertices'"},
         {mesh + "file = 'a.obj'\nfaces = []", "4:1", "unknown key 'faces' in [[mesh]] with a file"},
         {mesh + "faces = [[0, 1, 2]]", "1:1", "has none of them"},
         {three, "1:1", "lacks 'faces'"},
         {"[[mesh]]\nvertices = []\nfaces = []", "1:1", "lacks 'material'"},
         {mesh + "vertices = [[0,0,0],[1,0,0]]\nfaces = [[0, 1, 1]]", "3:12", "expected 3 vertices or more"},
         {mesh + "vertices = [[0,0,0],[1,0]]\nfaces = [[0, 1, 1]]", "3:21", "expected an array of 3 numbers"},
         {mesh + "vertices = 1\nfaces = [[0, 1, 1]]", "3:12", "expected an array of vertices"},
         {three + "faces = 1", "4:9", "expected an array of faces"},
         {three + "faces = []", "4:9", "expected 1 face or more"},
         {three + "faces = [0, 1, 2]", "4:10", "'faces' is 0, expected faces of 3 to 10000"},
         {three + "faces = [[0, 1, 2], [0, 1]]", "4:21",
          "'faces' is an array of 2, expected faces of 3 to 10000"},
         {three + "faces = [" + huge + "]]", "4:10", "'faces' is an array of 10001"},
         {three + "faces = [[0, 1, 3]]", "4:17", "'faces' is 3, expected a whole number from 0 to 2"},
         {three + "faces = [[0, -1, 2]]", "4:14", "'faces' is -1"},
         {three + "faces = [[0, 1.0, 2]]", "4:14", "'faces' is 1.0, expected a whole number"}});
}

TEST_CASE("toml errors: shapes") {
  const std::string mesh = "[[mesh]]\nmaterial = 'm'\n";
  const std::string cone = mesh + "shape = 'cone'\nradius = 1\n", torus = mesh + "shape = 'torus'\n";
  std::string many;
  for (int i = 0; i < 5; ++i) many += torus + "radii = [2, 1]\nsegments = [1024, 256]\n";
  for (int i = 0; i < 4; ++i) many += torus + "radii = [2, 1]\nsegments = [2048, 128]\n";
  check(
      {{mesh + "shape = 'tours'", "3:9", "expected one of box, cylinder, cone, torus; did you mean 'torus'?"},
       {mesh + "shape = 1", "3:9", "expected a text"},
       {mesh + "shape = 'box'", "1:1", "[[mesh]] of shape 'box' lacks 'size'"},
       {mesh + "shape = 'box'\nsize = 1", "4:8", "expected an array of 3"},
       {mesh + "shape = 'box'\nsize = [1, 0, 1]", "4:12", "'size' is 0, expected a length"},
       {mesh + "shape = 'box'\nsize = [1, 1e-31, 1]", "4:12", "expected a length"},
       {mesh + "shape = 'cylinder'\nheight = 1", "1:1", "lacks 'radius'"},
       {cone, "1:1", "lacks 'height'"},
       {cone + "height = 0", "5:10", "'height' is 0"},
       {cone + "height = 1\nsegments = 2", "6:12", "'segments' is 2, expected a whole number from 3 to 4096"},
       {cone + "height = 1\nsegments = 4097", "6:12", "'segments' is 4097"},
       {cone + "height = 1\nsegments = 3.0", "6:12", "'segments' is 3"},
       {torus, "1:1", "lacks 'radii'"},
       {torus + "radii = 1", "4:9", "expected [major, minor]"},
       {torus + "radii = [1, 1]", "4:13", "'radii' is 1, expected a minor radius below the major one"},
       {torus + "radii = [1, 0]", "4:13", "'radii' is 0, expected a length"},
       {torus + "radii = [2, 1]\nsegments = 64", "5:12", "expected [around, tube]"},
       {torus + "radii = [2, 1]\nsegments = [64, 2]", "5:17", "'segments' is 2"},
       {torus + "radii = [2, 1]\nsegments = [4096, 4096]", "5:12", "expected a product of at most 262144"},
       {many, "41:1",
        "the scene has 4718592 triangles of generated shapes (again for each step that changes one), "
        "expected at most 4194304"}});
}

TEST_CASE("toml errors: transforms") {
  const std::string box = "[[mesh]]\nmaterial = 'm'\nshape = 'box'\nsize = [1, 1, 1]\ntransform = ";
  check({{box + "1", "5:13", "expected a table"},
         {box + "{ scale = 'big' }", "5:23", "expected a number or an array of 3"},
         {box + "{ scale = [1, 2] }", "5:23", "expected an array of 3"},
         {box + "{ rotate = 30 }", "5:24", "expected an array of 3"},
         {box + "{ translate = [0, 0, 2e15] }", "5:34", "expected a number from -1e15 to 1e15"},
         {box + "{ matrix = [1, 0] }", "5:24", "'matrix' is an array of 2, expected an array of 16 numbers"},
         {box + "{ matrix = [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2] }", "5:55",
          "expected the last row to be 0, 0, 0, 1"},
         {box + "{ scale = 1, matrix = [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1] }", "5:35", "expected it alone"}});
  CHECK(error_of(box + "{ translate = [1e15, 0, 0], scale = 1e15 }" + kCamera + kMaterial)
            .find("scene.toml:1:1: ") == 0);
}
