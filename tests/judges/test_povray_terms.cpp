// SPDX-License-Identifier: MIT
// What common/scene/pov.cpp does to make POV-Ray say each of our terms, one small scene each, judged by the same bounds
// as the shipped ones: every trick there is an experiment here.
#include <cmath>
#include <string>

#include "common/scene/toml.h"
#include "tests/judges/judge.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// A camera, two coloured lamps, and a floor and a wall of other colours to be seen in mirrors and through glass.
const std::string kRoom =
    "background = [0.05, 0.1, 0.2]\n"
    "ambient = [0.3, 0.25, 0.2]\n"
    "[picture]\n"
    "size = [96, 72]\n"
    "[camera]\n"
    "eye = [0.7, 2.2, 6]\n"
    "look_at = [0.1, 0.7, 0]\n"
    "up = [0.2, 1, 0.1]\n"
    "vertical_fov = 38\n"
    "[material.floor]\n"
    "ambient = [0.5, 0.2, 0.3]\n"
    "diffuse = [0.3, 0.6, 0.4]\n"
    "[material.wall]\n"
    "ambient = [0.1, 0.5, 0.2]\n"
    "diffuse = [0.5, 0.3, 0.7]\n"
    "[[plane]]\n"
    "point = [0, 0, 0]\n"
    "normal = [0, 1, 0]\n"
    "material = 'floor'\n"
    "[[plane]]\n"
    "point = [0, 0, -5]\n"
    "normal = [0.1, 0, 1]\n"
    "material = 'wall'\n";

const std::string kLamps =
    "[[light]]\n"
    "position = [-3, 5, 4]\n"
    "intensity = [0.6, 0.4, 0.2]\n"
    "[[light]]\n"
    "direction = [-0.6, -1, -0.4]\n"
    "intensity = [0.2, 0.3, 0.4]\n";

const std::string kGlassBall =
    "[material.glass]\n"
    "ambient = [0.1, 0.05, 0]\n"
    "diffuse = [0.02, 0.04, 0.06]\n"
    "specular = 0.5\n"
    "shininess = 60\n"
    "reflect = [0.1, 0.15, 0.05]\n"
    "refract = [0.7, 0.6, 0.8]\n"
    "ior = 1.5\n"
    "[[sphere]]\n"
    "center = [0, 1, 0.5]\n"
    "radius = 0.9\n"
    "material = 'glass'\n";

void check_agreement(const std::string& toml) {
  if (!has_povray()) {
    test::skip_test("no povray on this machine");
    return;
  }
  const Scene scene = parse_scene(toml, "judged.toml");
  CHECK(pov_limits(scene).empty());
  check_verdict(Judge(scene, PovQuality::local).verdict());
  check_verdict(Judge(scene, PovQuality::full).verdict());
}

std::string ball(const std::string& material) {
  return kRoom + kLamps + "[material.ball]\n" + material +
         "[[sphere]]\ncenter = [0, 1, 0.5]\nradius = 0.9\nmaterial = 'ball'\n";
}

}  // namespace

TEST_CASE("POV-Ray: c1 in three channels") {
  check_agreement(
      ball("ambient = 0.4\ndiffuse = 0.5\nspecular = 0.6\nshininess = 20\nlocal = [0.9, 0.5, 0.2]\n"));
}

TEST_CASE("POV-Ray: coloured highlights, also over a black channel") {
  check_agreement(ball("diffuse = [0.1, 0.3, 0.2]\nspecular = [0.3, 0.9, 0.6]\nshininess = 25\n"));
  check_agreement(ball("diffuse = [0.4, 0.3, 0.2]\nspecular = [0.8, 0, 0.6]\nshininess = 25\n"));
}

TEST_CASE("POV-Ray: a highlight of exponent 0 is a hemisphere") {
  check_agreement(ball("diffuse = 0.2\nspecular = 0.5\nshininess = 0\n"));
}

TEST_CASE("POV-Ray: a mirror in three channels") {
  check_agreement(ball("ambient = 0.1\nspecular = 0.5\nshininess = 1000\nreflect = [0.9, 0.6, 0.3]\n"));
}

TEST_CASE("POV-Ray: attenuation with one of q1 and q2, also without q0") {
  for (const char* q : {"[0.5, 0.2, 0]", "[0, 0.3, 0]", "[0.4, 0, 0.03]", "[0, 0, 0.05]", "[3, 0, 0]"}) {
    CAPTURE(q);
    check_agreement(ball("ambient = 0.1\ndiffuse = 0.7\n") +
                    "[[light]]\nposition = [1, 3, 4]\nintensity = [1, 2, 0.5]\n" + "attenuation = " + q +
                    "\n");
  }
}

TEST_CASE("POV-Ray: glass in three channels, its shadow whole or none") {
  check_agreement(kRoom + kLamps + kGlassBall);
  std::string clear = kRoom + kLamps + kGlassBall;
  clear.insert(clear.find("ior = 1.5"), "casts_shadow = false\n");
  check_agreement(clear);
}

TEST_CASE("POV-Ray: the weight of total reflection is c2 + c3 in each channel") {
  std::string box = kRoom + kLamps + kGlassBall;
  box.replace(box.find("[[sphere]]"), std::string::npos,
              "[[mesh]]\nshape = 'box'\nsize = [1.4, 1.6, 1.2]\ntransform = { translate = [0, 0.9, 0.5], "
              "rotate = [0, 33, "
              "0] }\nmaterial = 'glass'\n");
  check_agreement(box);
}

TEST_CASE("POV-Ray: the eye in a medium, of a sphere and of a mesh") {
  const std::string glass = kRoom + kLamps + kGlassBall;
  const std::string before = glass.substr(0, glass.find("[[sphere]]"));
  check_agreement(before + "[[sphere]]\ncenter = [0.5, 2, 6.2]\nradius = 1.5\nmaterial = 'glass'\n");
  check_agreement(
      before +
      "[[mesh]]\nshape = 'box'\nsize = [1, 1, 2]\ntransform = { translate = [0.7, 2.2, 6], rotate = [10, 20, "
      "30] }\nmaterial = 'glass'\n");
}

TEST_CASE("POV-Ray: a ball of air in a ball of glass") {
  check_agreement(
      kRoom + kLamps + kGlassBall +
      "[material.air]\nrefract = 1\n[[sphere]]\ncenter = [0.1, 1, 0.6]\nradius = 0.6\nmaterial = 'air'\n");
}

TEST_CASE("POV-Ray: depth counts the eye ray") {
  for (const int depth : {1, 2, 3}) {
    CAPTURE(depth);
    check_agreement(kRoom + "[trace]\ndepth = " + std::to_string(depth) + "\n" + kLamps + kGlassBall);
  }
}

TEST_CASE("POV-Ray: switches of the scene") {
  for (const char* key : {"shadows", "reflection", "refraction"}) {
    CAPTURE(key);
    check_agreement(kRoom + "[trace]\n" + key + " = false\n" + kLamps + kGlassBall);
  }
}

TEST_CASE("POV-Ray: smooth and flat faces in one mesh") {
  check_agreement(
      ball("diffuse = 0.3\nspecular = 0.7\nshininess = 80\nreflect = 0.2\n") +
      "[[mesh]]\nshape = 'cylinder'\nradius = 0.5\nheight = 1.5\nsegments = 48\nmaterial = 'ball'\n"
      "transform = { translate = [1.8, 0.1, 0.3], rotate = [20, 0, 15] }\n");
}

TEST_CASE("POV-Ray: a scene a thousand times smaller or larger is the same picture") {
  for (const double scale : {0.001, 1000.0}) {
    CAPTURE(scale);
    Scene scene = parse_scene(kRoom + kLamps + kGlassBall, "judged.toml");
    scene.camera.eye *= scale;
    scene.camera.look_at *= scale;
    for (Light& light : scene.lights) light.position *= scale;
    for (Plane& plane : scene.planes) plane.point *= scale;
    for (Sphere& sphere : scene.spheres) sphere.center *= scale, sphere.radius *= scale;
    if (!has_povray()) return test::skip_test("no povray on this machine");
    check_verdict(Judge(scene, PovQuality::full).verdict());
  }
}
