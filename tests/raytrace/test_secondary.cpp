// SPDX-License-Identifier: MIT
// What secondary rays weigh, by hand: with the way they go, against the cut, and where they are not sent.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/scene/toml.h"
#include "raytrace/secondary.h"
#include "tests/agreement/pictures.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::distance_weight;
using raytrace::is_sent;

TEST_CASE("secondary rays fade on their way from where they start, and where they meet nothing") {
  const Ray ray{{0, 0, 0}, {0, 0, -2}};
  const Hit start{1, 0}, hit{3, 0};  // 4 apart
  CHECK(distance_weight({1, 0.5, 0.25}, ray, start, hit) == 1.0 / 7);
  CHECK(distance_weight({0.25, 0, 0}, ray, start, hit) == 1);
  CHECK(distance_weight({0.25, 0, 0}, ray, start, {}) == 1);
  CHECK(distance_weight({4, 0, 0}, ray, start, {}) == 0.25);
  CHECK(distance_weight({1, 0.5, 0}, ray, start, {}) == 0);
  CHECK(distance_weight({1, 0, 0.25}, ray, start, {}) == 0);
}

TEST_CASE("a ray is sent that weighs as much as the cut, and none that weighs less") {
  Scene scene = empty_scene();
  scene.trace.depth = 2;
  scene.trace.contribution_cut = 0.25;
  CHECK(is_sent(scene, 1, 0.25));
  CHECK_FALSE(is_sent(scene, 1, std::nextafter(0.25, 0)));
  CHECK_FALSE(is_sent(scene, 2, 1));
}

// A mirror that fills the picture, of which no ray is sent.
TEST_CASE("the weight that is cut off is that of a sample, however many there are") {
  Scene scene = scene_of(Plane{{0, 0, -1}, {0, 0, 1}, 0});
  scene.materials[0].reflect = glm::dvec3(0.5);
  scene.trace.depth = 1;
  scene.camera.view_height = 1;
  for (const int n : {1, 2, 3})
    CHECK(traced(scene, make_camera(scene.camera, 3, 2, n)).stats.cut_weight == 0.5);
}

// Glass over a red floor that comes later in the file and lies in the glass's own surface, blue all around. Rays go down
// steeply, so none is reflected internally, and each must end at the floor: at any height, but above all in the plane
// through the origin, where the clearance is 0.
TEST_CASE("a refracted ray meets the wall that lies in the surface it went through") {
  for (const std::string kind : {"mesh", "plane"})
    for (const double height : {0.0, 0.25, -3.0}) {
      CAPTURE(kind);
      CAPTURE(height);
      const std::string y = std::to_string(height), eye = std::to_string(height + 4);
      const std::string block = "shape = 'box'\nsize = [2, 1, 2]\ntransform = { translate = [0, " +
                                std::to_string(height + 0.5) + ", 0] }";
      const std::string pool = "point = [0, " + y + ", 0]\nnormal = [0, 1, 0]";
      const Scene scene = parse_scene(
          "background = [0, 0, 1]\nambient = 1\n"
          "camera = { eye = [0.1, " +
              eye + ", 0.2], look_at = [0, " + y +
              ", 0], view_height = 0.2 }\n"
              "material.glass = { refract = 1, ior = 1.5 }\nmaterial.red = { ambient = [1, 0, 0] }\n"
              "[[" +
              kind + "]]\nmaterial = 'glass'\n" + (kind == "mesh" ? block : pool) +
              "\n"
              "[[mesh]]\nmaterial = 'red'\nfaces = [[0, 1, 2, 3]]\nvertices = [[-9, " +
              y + ", -9], [-9, " + y + ", 9], [9, " + y + ", 9], [9, " + y + ", -9]]\n",
          "floor.toml");
      const Camera camera = make_camera(scene.camera, 16, 12, 1);
      for (const Frame& frame : {traced(scene, camera), raytrace::render_reference(scene, camera, {})})
        CHECK(std::count(frame.color.begin(), frame.color.end(), glm::vec3(1, 0, 0)) == 16 * 12);
    }
}
