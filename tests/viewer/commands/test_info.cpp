// SPDX-License-Identifier: MIT
// What sidelight info says of a scene, and a picture of itself.
#include "common/picture/image_io.h"
#include "common/scene/toml.h"
#include "tests/support/program.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("info names the materials of each object, and none of a mesh without faces") {
  const Workplace here;
  write_bytes(here / "points.obj", "v 0 0 0\n");
  write_bytes(here / "two.obj",
              "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 2 4 3\n");
  write_bytes(here / "two.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
  write_bytes(here / "scene.toml",
              kGoodScene + "[[mesh]]\nfile = 'two.obj'\n[[mesh]]\nfile = 'points.obj'\nmaterial = 'red'\n");
  const Outcome outcome = here.run({"info", "scene.toml"});
  CAPTURE(outcome.out);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("mesh, materials a, b, 2 triangles, open") != std::string::npos);
  CHECK(outcome.out.find("mesh, no material, 0 triangles, open") != std::string::npos);
}

TEST_CASE("info writes the weight of a secondary ray as it is used: never above 1") {
  const Workplace here;
  write_bytes(here / "scene.toml", kGoodScene + "[trace]\nsecondary_attenuation = [0.5, 0.25, 2]\n");
  const Outcome outcome = here.run({"info", "scene.toml"});
  CAPTURE(outcome.out);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("w(r) 1/max(1, 0.5 + 0.25 r + 2 r²), ") != std::string::npos);
}

TEST_CASE("info tells what is in the scene, and of many objects and materials how many more") {
  const Workplace here;
  std::string scene =
      "title = 'All'\nambient = [0.1, 0.2, 0.3]\n" + kGoodScene +
      "[trace]\nreflection = false\n[[light]]\ndirection = [0, -2, 0]\nintensity = [0.5, 0.25, 1]\n" +
      "[[mesh]]\nfile = 'six.obj'\n[[mesh]]\nshape = 'box'\nsize = [1, 1, 1]\nmaterial = 'red'\n";
  for (int i = 0; i < 40; ++i) scene += "[[sphere]]\ncenter = [0, 0, -9]\nradius = 1\nmaterial = 'red'\n";
  std::string mtl, obj = "mtllib six.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) {
    mtl += std::string("newmtl ") + name + "\n";
    obj += std::string("usemtl ") + name + "\nf 1 2 3\n";
  }
  write_bytes(here / "six.obj", obj);
  write_bytes(here / "six.mtl", mtl);
  write_bytes(here / "scene.toml", scene);
  const Outcome outcome = here.run({"info", "scene.toml", "-r", "20x10", "--spp", "9"});
  CAPTURE(outcome.out);
  CHECK(outcome.code == 0);
  for (const char* line :
       {"title      All\n", "picture    20x10, 9 sample(s) per pixel\n",
        "camera     eye (0, 1, 6), looks at (0, 0, 0), view height 0.72794 at distance 1\n",
        "objects    45 (18 triangles, 42 spheres, 1 planes)\n",
        "sphere, material glass, solid of index 1.5\n",
        "mesh, materials a, b, c, d and 2 more, 6 triangles, open\n",
        "mesh, material red, 12 triangles, closed\n", "  ... and 5 more\n",
        "lights     2, ambient (0.1, 0.2, 0.3)\n", "directional (0, -1, 0), intensity (0.5, 0.25, 1)\n",
        "shadows on, reflection off, refraction on\n"})
    CHECK_MESSAGE(outcome.out.find(line) != std::string::npos, line);
}

TEST_CASE("a picture tells how it was made") {
  const Workplace here;
  write_bytes(here / "scene.toml", "title = 'Half'\n[trace]\ncontribution_cut = 0.0625\n" + kGoodScene);
  REQUIRE(here.run({"render", "scene.toml", "-r", "20x10", "--spp", "4", "--depth", "3", "--no-reflection",
                    "-q", "-o", "a.exr"})
              .code == 0);
  auto told = read_image(here / "a.exr").metadata;
  CHECK(told.at("program").starts_with("sidelight "));
  CHECK(told.at("scene_hash") == load_scene(here / "scene.toml").hash);
  for (const char* name : {"program", "scene_hash"}) told.erase(name);
  CHECK(told == std::map<std::string, std::string>{{"renderer", "raytrace"},
                                                   {"scene", "scene.toml"},
                                                   {"title", "Half"},
                                                   {"size", "20x10"},
                                                   {"samples_per_pixel", "4"},
                                                   {"depth", "3"},
                                                   {"contribution_cut", "0.0625"},
                                                   {"shadows", "on"},
                                                   {"reflection", "off"},
                                                   {"refraction", "on"}});
}
