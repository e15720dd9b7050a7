// SPDX-License-Identifier: MIT
// A lecture scene whose pixels a test knows by hand. First the test says on which numbers of the scene its derivation
// stands, so that after a change of the scene it names what moved; then it looks through the eye at a point, or at a
// pixel of a small picture, and compares all four renderers with what paper says.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "common/scene/toml.h"
#include "tests/agreement/pictures.h"
#include "tests/support/approx.h"

namespace sidelight::test {

inline glm::dvec3 grey(double value) { return glm::dvec3(value); }

class Lesson {
 public:
  explicit Lesson(const std::string& name)
      : name_(name), scene_(load_scene(SIDELIGHT_SOURCE_DIR "/scenes/" + name + ".toml")) {}

  // ---- The numbers used on paper ----

  void has_eye(const glm::dvec3& eye) const { has("camera.eye", scene_.camera.eye, eye); }
  void has_view_height(double height) const {
    has("camera.view_height", grey(scene_.camera.view_height), grey(height));
  }
  void has_ambient(const glm::dvec3& light) const { has("ambient", scene_.ambient, light); }
  void has_background(const glm::dvec3& color) const { has("background", scene_.background, color); }
  void has_lamp(std::size_t i, const glm::dvec3& position, const glm::dvec3& intensity) const {
    REQUIRE(i < scene_.lights.size());
    has("position of light " + std::to_string(i + 1), scene_.lights[i].position, position);
    has("intensity of light " + std::to_string(i + 1), scene_.lights[i].intensity, intensity);
  }
  // A directional light, by the vector to it.
  void has_sun(std::size_t i, const glm::dvec3& to_light, const glm::dvec3& intensity) const {
    REQUIRE(i < scene_.lights.size());
    has("direction of light " + std::to_string(i + 1), -scene_.lights[i].direction, to_light);
    has("intensity of light " + std::to_string(i + 1), scene_.lights[i].intensity, intensity);
  }
  void has_sphere(std::size_t i, const glm::dvec3& center, double radius) const {
    REQUIRE(i < scene_.spheres.size());
    has("center of sphere " + std::to_string(i + 1), scene_.spheres[i].center, center);
    has("radius of sphere " + std::to_string(i + 1), grey(scene_.spheres[i].radius), grey(radius));
  }
  void has_secondary_attenuation(const glm::dvec3& q) const {
    const Attenuation& a = scene_.trace.secondary_attenuation;
    has("trace.secondary_attenuation", {a.q0, a.q1, a.q2}, q);
  }
  // All of a material's numbers: what `expected` does not name has its default.
  void has_material(const Material& expected) const {
    const auto& all = scene_.materials;
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const Material& m) { return m.name == expected.name; });
    REQUIRE_MESSAGE(at != all.end(), name_, " has no material ", expected.name);
    const std::string prefix = "material." + expected.name + ".";
    has(prefix + "ambient", at->ambient, expected.ambient);
    has(prefix + "diffuse", at->diffuse, expected.diffuse);
    has(prefix + "specular", at->specular, expected.specular);
    has(prefix + "shininess", grey(at->shininess), grey(expected.shininess));
    has(prefix + "local", at->local, expected.local);
    has(prefix + "reflect", at->reflect, expected.reflect);
    has(prefix + "refract", at->refract, expected.refract);
    has(prefix + "ior", grey(at->ior), grey(expected.ior));
  }
  void has(const std::string& what, const glm::dvec3& actual, const glm::dvec3& on_paper) const {
    CHECK_MESSAGE(actual == test::near(on_paper, 1e-12), name_, ": ", what, " moved from ",
                  doctest::toString(on_paper), " to ", doctest::toString(actual));
  }

  // As `--depth N`.
  void set_depth(int depth) { scene_.trace.depth = depth; }

  // ---- What the eye sees ----

  // In the direction of a point.
  void sees(const glm::dvec3& point, const glm::dvec3& both) const { sees(point, both, both); }
  void sees(const glm::dvec3& point, const glm::dvec3& rastered, const glm::dvec3& traced) const {
    CameraSettings settings = scene_.camera;
    settings.look_at = point;
    check("towards " + std::string(doctest::toString(point).c_str()), make_camera(settings, 1, 1, 1), 0, 0,
          rastered, traced);
  }
  // In pixel (x, y) of a picture of that size.
  void shows(const PictureSize& size, int x, int y, const glm::dvec3& both) const {
    check("in pixel " + std::to_string(x) + "," + std::to_string(y) + " of " + size.text(),
          make_camera(scene_.camera, size.width, size.height, 1), x, y, both, both);
  }

 private:
  // Values are at most about 1. A reference is a double rounded to float once. The float renderers round some thirty
  // times on the way, each by at most 2^-24 of the value; a highlight's exponent, at most 80 here, costs as much again.
  static constexpr double kReference = 0x1p-24, kFast = 64 * 0x1p-24;

  void check(const std::string& where, const Camera& camera, int x, int y, const glm::dvec3& flat,
             const glm::dvec3& deep) const {
    RenderOptions options;
    options.crop = {x, y, x + 1, y + 1};
    CAPTURE(name_);
    CAPTURE(where);
    CHECK(raster::render_reference(scene_, camera, options).color[0] == test::near(flat, kReference));
    CHECK(raytrace::render_reference(scene_, camera, options).color[0] == test::near(deep, kReference));
    CHECK(rastered(scene_, camera, options).color[0] == test::near(flat, kFast));
    CHECK(traced(scene_, camera, options).color[0] == test::near(deep, kFast));
  }

  std::string name_;
  Scene scene_;
};

}  // namespace sidelight::test
