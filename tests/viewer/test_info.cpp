// SPDX-License-Identifier: MIT
// What sidelight info says of a scene.
#include "tests/viewer/program.h"

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
