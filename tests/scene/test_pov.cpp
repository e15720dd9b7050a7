// SPDX-License-Identifier: MIT
// The text written for POV-Ray: numbers in full, names where they can do no harm, and what cannot be said named. That
// the text means the same picture is for tests/judges to say.
#include "common/scene/pov.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/scene/build.h"
#include "common/scene/toml.h"
#include "tests/support/scenes.h"

using namespace sidelight;

namespace {

std::string written(const Scene& scene) {
  std::string text;
  write_pov(scene, [&](std::string_view piece) { text += piece; });
  return text;
}

// Without its comments.
std::string code(const Scene& scene) {
  std::string out;
  std::istringstream lines(written(scene));
  for (std::string line; std::getline(lines, line);) out += line.substr(0, line.find("//")) + "\n";
  return out;
}

const std::string kStart = "[camera]\neye = [0, 1, 6]\nlook_at = [0, 0, 0]\nvertical_fov = 40\n";

Scene with(const std::string& toml) { return parse_scene(kStart + toml, "scene.toml"); }

std::vector<std::string> limits(const Scene& scene) {
  std::vector<std::string> out;
  for (const PovLimit& limit : pov_limits(scene)) out.push_back(limit.text);
  return out;
}
bool names(const std::vector<std::string>& all, const std::string& part) {
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& each) { return each.find(part) != std::string::npos; });
}

std::string ball(const std::string& material, const std::string& center, double radius) {
  return "[[sphere]]\nmaterial = '" + material + "'\ncenter = " + center +
         "\nradius = " + std::to_string(radius) + "\n";
}
const std::string kGlass = "[material.glass]\nrefract = 0.9\nior = 1.5\n";
const std::string kAir = "[material.air]\nrefract = 0.8\n";

}  // namespace

TEST_CASE("names stay in comments of one line, whatever they contain") {
  Scene scene = test::scene_of(Sphere{});
  const std::string evil = "x\n#include \"/etc/passwd\"\r*/ sphere {";
  scene.title = scene.file = scene.materials[0].name = evil;
  CHECK(written(scene).find("#include") != std::string::npos);
  CHECK(code(scene).find("include") == std::string::npos);
  CHECK(code(scene).find("*/") == std::string::npos);
  CHECK(written(scene).find('\r') == std::string::npos);
}

TEST_CASE("numbers are written in full, and lengths by a power of two") {
  Scene scene = test::scene_of(Sphere{glm::dvec3(0.1, -1.0 / 3, 0), 0.7, 0});
  scene.camera.eye = glm::dvec3(0, 0, 100);
  std::istringstream text(code(scene).substr(code(scene).find("sphere {") + 10));
  char comma = 0;
  double x = 0, y = 0, z = 0, radius = 0;
  text >> x >> comma >> y >> comma >> z >> comma >> comma >> radius;
  const double scale = x / 0.1;
  CHECK(std::exp2(std::round(std::log2(scale))) == scale);
  CHECK(scale * 100 <= 1024);
  CHECK(scale * 100 > 512);
  CHECK(y / scale == -1.0 / 3);
  CHECK(radius / scale == 0.7);
}

TEST_CASE("the head says how to render it") {
  Scene scene = test::scene_of(Sphere{});
  scene.width = 321;
  scene.height = 123;
  const std::vector<std::string> options = pov_options(scene);
  for (const char* option : {"+W321", "+H123", "+FP16", "-A", "File_Gamma=1.0", "Dither=off"})
    CHECK(std::find(options.begin(), options.end(), option) != options.end());
  for (const std::string& option : options) CHECK(written(scene).find(" " + option) != std::string::npos);
}

TEST_CASE("a mesh comes in many pieces, none of them long") {
  const Scene scene = test::scene_of(test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                   {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}, {0, 0, 1}}));
  std::size_t longest = 0;
  write_pov(scene, [&](std::string_view piece) { longest = std::max(longest, piece.size()); });
  CHECK(longest < 500);
  // The triangle without area is left out.
  CHECK(code(scene).find("face_indices { 4\n") != std::string::npos);
  // With all its triangles like that, so is the mesh.
  CHECK(code(test::scene_of_triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0})).find("object") == std::string::npos);
}

TEST_CASE("vertex normals of 0 are none") {
  Scene scene = test::scene_of_triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  scene.normals = {glm::dvec3(0), glm::dvec3(1, 0, 0)};
  scene.triangles[0].normal = {0, 0, 0};
  CHECK(code(scene).find("normal_vectors") == std::string::npos);
  CHECK(limits(scene).empty());
  scene.triangles[0].normal = {0, 0, 1};
  CHECK(code(scene).find("normal_vectors { 2\n,<1,0,0>\n,<0,0,1>\n}") != std::string::npos);
  CHECK(code(scene).find("normal_indices { 1\n,<1,0,1>\n}") != std::string::npos);
  CHECK(names(limits(scene), "object 1 "));
}

TEST_CASE("a light that hardly falls has a finite distance") {
  const Scene scene = with("[[light]]\nposition = [0, 9, 0]\nintensity = 1\nattenuation = [1, 1e-320, 0]\n");
  CHECK(code(scene).find("fade_distance inf") == std::string::npos);
  CHECK(code(scene).find("fade_distance ") != std::string::npos);
}

TEST_CASE("what POV-Ray cannot express is named, and nothing else") {
  CHECK(limits(with(kGlass + ball("glass", "[0, 0, 0]", 1))).empty());
  CHECK(names(limits(with("[trace]\nsecondary_attenuation = [1, 0.1, 0]\n")), "trace.secondary_attenuation"));
  CHECK(names(limits(with("[trace]\ncontribution_cut = 0.01\n")), "trace.contribution_cut"));
  CHECK(names(limits(with("[trace]\ndepth = 300\n")), "trace.depth 300"));
  const std::string light = "[[light]]\nposition = [0, 5, 0]\nintensity = 1\nattenuation = ";
  CHECK(names(limits(with(light + "[1, 0.1, 0.1]\n")), "light 1"));
  CHECK(limits(with(light + "[1, 0, 0.1]\n")).empty());
  // Without secondary rays, neither w(r) nor the cut matters.
  CHECK(
      limits(with("[trace]\nsecondary_attenuation = [1, 0.1, 0]\ncontribution_cut = 0.1\nreflection = false\n"
                  "refraction = false\n"))
          .empty());
}

TEST_CASE("solids: apart or nested they agree, touching or overlapping they do not") {
  const auto pair = [](const std::string& first, const std::string& second) {
    return limits(with(kGlass + kAir + first + second));
  };
  CHECK(pair(ball("glass", "[0, 0, 0]", 1), ball("glass", "[3, 0, 0]", 1)).empty());
  CHECK(names(pair(ball("glass", "[0, 0, 0]", 1), ball("glass", "[2, 0, 0]", 1)), "touch or overlap"));
  CHECK(pair(ball("glass", "[0, 0, 0]", 1), ball("glass", "[0.2, 0, 0]", 0.5)).empty());
  // The other way round in the file, the outer one is the medium in both.
  CHECK(names(pair(ball("glass", "[0.2, 0, 0]", 0.5), ball("glass", "[0, 0, 0]", 1)), "touch or overlap"));
  // Total reflection at the outside of a bubble, whose weights do not make 1.
  const std::vector<std::string> bubble = pair(ball("glass", "[0, 0, 0]", 1), ball("air", "[0, 0, 0]", 0.5));
  REQUIRE(bubble.size() == 1);
  CHECK(names(bubble, "object 2"));
  CHECK(names(bubble, "total reflection"));

  const std::string water = "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = 'glass'\n";
  CHECK(pair(water, ball("glass", "[0, 2, 0]", 1)).empty());
  CHECK(pair(water, ball("glass", "[0, -2, 0]", 1)).empty());
  CHECK(names(pair(water, ball("glass", "[0, 0.5, 0]", 1)), "touch or overlap"));
  CHECK(pair(ball("glass", "[0, 2, 0]", 1), water).empty());
  CHECK(names(pair(ball("glass", "[0, -2, 0]", 1), water), "touch or overlap"));
  const std::string above = "[[plane]]\npoint = [0, 5, 0]\nnormal = [0, -1, 0]\nmaterial = 'glass'\n";
  CHECK(pair(water, above).empty());
  CHECK(names(pair(water, water), "touch or overlap"));
}

TEST_CASE("many overlapping solids do not make a wall of text") {
  std::string toml = kGlass;
  for (int i = 0; i < 60; ++i) toml += ball("glass", "[0, 0, 0]", 1);
  const std::vector<std::string> all = limits(with(toml));
  CHECK(all.size() == 21);
  CHECK(all.front().starts_with("object 1 "));
  CHECK(names({all.front()}, "and object 2 "));
  CHECK(names({all[19]}, "and object 7 "));  // of 7 there are 21 pairs
  CHECK(names({all[19]}, "object 5 "));
  CHECK(all.back() == "and 1750 more pairs of solids");
}

TEST_CASE("of overlapping solids that make millions of pairs, not every pair is looked at") {
  Scene scene = with(kGlass + ball("glass", "[0, 0, 0]", 1));
  const Sphere same = scene.spheres[0];
  for (int i = 1; i < 2000; ++i) add_sphere(scene, same, {"scene.toml", 8, 1});
  const std::vector<std::string> all = limits(scene);
  CHECK(all.size() == 21);
  CHECK(all.back() == "and 1048556 more pairs of solids, or many more: too many are near for a look at each");
}

TEST_CASE("a sheet that refracts, and a solid of two materials, are named") {
  const std::string sheet =
      "[[mesh]]\nvertices = [[0,0,0],[1,0,0],[0,1,0]]\nfaces = [[0,1,2]]\nmaterial = 'glass'\n";
  CHECK(names(limits(with(kGlass + sheet)), "object 1 (line 8, material glass): POV-Ray takes it"));

  Scene scene = with(kGlass + kAir + "[[mesh]]\nshape = 'box'\nsize = [1, 1, 1]\nmaterial = 'glass'\n");
  CHECK(limits(scene).empty());
  scene.triangles[3].material = 1 - scene.triangles[3].material;
  CHECK(names(limits(scene), "different materials"));
}
