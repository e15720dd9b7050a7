// SPDX-License-Identifier: MIT
// What the scene reader reads: every key, every default, the numbers of objects. Mistakes: test_toml_errors.cpp.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/vec3.hpp>

#include "tests/scene/temp_folder.h"
#include "tests/scene/toml_text.h"

using namespace sidelight;
using glm::dvec3;
using test::kCamera;
using test::kMaterial;
using test::parse;

TEST_CASE("toml: a scene of a camera alone has the documented defaults") {
  const Scene scene =
      parse_scene("camera = { eye = [1, 2, 3], look_at = [0, 0, 0], view_height = 0.5 }", "a.toml");
  CHECK(scene.file == "a.toml");
  CHECK(scene.title.empty());
  CHECK(scene.lesson.empty());
  CHECK(scene.background == dvec3(0));
  CHECK(scene.ambient == dvec3(0));
  CHECK(scene.width == 640);
  CHECK(scene.height == 480);
  CHECK(scene.camera.eye == dvec3(1, 2, 3));
  CHECK(scene.camera.up == dvec3(0, 1, 0));
  CHECK(scene.camera.view_height == 0.5);
  CHECK(scene.trace.depth == 6);
  CHECK(scene.trace.contribution_cut == 0);
  CHECK(scene.trace.secondary_attenuation.q0 == 1);
  CHECK(scene.trace.secondary_attenuation.q1 == 0);
  CHECK(scene.trace.secondary_attenuation.q2 == 0);
  CHECK(scene.trace.shadows);
  CHECK(scene.trace.reflection);
  CHECK(scene.trace.refraction);
  CHECK((scene.lights.empty() && scene.materials.empty() && scene.objects.empty() && scene.steps.empty()));
}

TEST_CASE("toml: every key of the scene's settings is read") {
  const Scene scene = parse_scene(R"(
title = "A <title>"
lesson = """One
two \
  ö three"""
background = [0.25, 0.5, 1]
ambient = 0.5
[picture]
size = [1, 65535]
[camera]
eye = [0, 2, 7]
look_at = [0, 0.8, 0]
up = [0, 0, 2]
vertical_fov = 90
[trace]
depth = 1000
contribution_cut = 1
secondary_attenuation = [0, 0.5, 2]
shadows = false
reflection = false
refraction = false
)",
                                  "a.toml");
  CHECK(scene.title == "A <title>");
  CHECK(scene.lesson == "One\ntwo \u00f6 three");
  CHECK(scene.background == dvec3(0.25, 0.5, 1));
  CHECK(scene.ambient == dvec3(0.5));
  CHECK(scene.width == 1);
  CHECK(scene.height == 65535);
  CHECK(scene.camera.eye == dvec3(0, 2, 7));
  CHECK(scene.camera.look_at == dvec3(0, 0.8, 0));
  CHECK(scene.camera.up == dvec3(0, 0, 2));
  CHECK(scene.camera.view_height == doctest::Approx(2).epsilon(1e-15));
  CHECK(scene.trace.depth == 1000);
  CHECK(scene.trace.contribution_cut == 1);
  CHECK(scene.trace.secondary_attenuation.q0 == 0);
  CHECK(scene.trace.secondary_attenuation.q1 == 0.5);
  CHECK(scene.trace.secondary_attenuation.q2 == 2);
  CHECK_FALSE(scene.trace.shadows);
  CHECK_FALSE(scene.trace.reflection);
  CHECK_FALSE(scene.trace.refraction);
  CHECK(parse("trace.secondary_attenuation = [0, 0, 1e-30]").trace.secondary_attenuation.q2 == 1e-30);
}

TEST_CASE("toml: lights keep the order of the file") {
  const Scene scene = parse(R"(
[[light]]
position = [4, 7, 1e-31]
intensity = [0.9, 0, 1e15]
attenuation = [0, 0.5, 0.25]
[[light]]
direction = [0, -1e300, 0]
intensity = 2
)");
  REQUIRE(scene.lights.size() == 2);
  CHECK_FALSE(scene.lights[0].directional);
  CHECK(scene.lights[0].position == dvec3(4, 7, 0));
  CHECK(scene.lights[0].intensity == dvec3(0.9, 0, 1e15));
  CHECK(scene.lights[0].attenuation.q0 == 0);
  CHECK(scene.lights[0].attenuation.q1 == 0.5);
  CHECK(scene.lights[0].attenuation.q2 == 0.25);
  CHECK(scene.lights[1].directional);
  CHECK(scene.lights[1].direction == dvec3(0, -1, 0));
  CHECK(scene.lights[1].intensity == dvec3(2));
  CHECK(scene.lights[1].attenuation.q0 == 1);
}

TEST_CASE("toml: materials have any name, the order of the file and their defaults") {
  const Scene scene = parse_scene(R"([material.zinc]
[material."dark.red glass"]
ambient = 0.125
diffuse = [0.1, 0.2, 0.3]
specular = 0.8
shininess = 1e6
local = [1, 0.5, 0.25]
reflect = 0.1
refract = [0.85, 0.8, 0.75]
ior = 4
casts_shadow = false
)" + kCamera,
                                  "a.toml");
  REQUIRE(scene.materials.size() == 2);
  const Material& plain = scene.materials[0];
  CHECK(plain.name == "zinc");
  CHECK(plain.ambient == dvec3(0));
  CHECK(plain.diffuse == dvec3(0));
  CHECK(plain.specular == dvec3(0));
  CHECK(plain.shininess == 1);
  CHECK(plain.local == dvec3(1));
  CHECK(plain.reflect == dvec3(0));
  CHECK(plain.refract == dvec3(0));
  CHECK(plain.ior == 1);
  CHECK(plain.casts_shadow);
  const Material& glass = scene.materials[1];
  CHECK(glass.name == "dark.red glass");
  CHECK(glass.ambient == dvec3(0.125));
  CHECK(glass.diffuse == dvec3(0.1, 0.2, 0.3));
  CHECK(glass.specular == dvec3(0.8));
  CHECK(glass.shininess == 1e6);
  CHECK(glass.local == dvec3(1, 0.5, 0.25));
  CHECK(glass.reflect == dvec3(0.1));
  CHECK(glass.refract == dvec3(0.85, 0.8, 0.75));
  CHECK(glass.ior == 4);
  CHECK_FALSE(glass.casts_shadow);
}

TEST_CASE("toml: spheres and planes") {
  const Scene scene = parse(R"([[sphere]]
center = [0, 1e15, -1e-31]
radius = 1e-30
material = "m"
  [[plane]]
point = [0, -1, 0]
normal = [0, 1e-200, 0]
material = "m"
)");
  REQUIRE(scene.spheres.size() == 1);
  CHECK(scene.spheres[0].center == dvec3(0, 1e15, 0));
  CHECK(scene.spheres[0].radius == 1e-30);
  REQUIRE(scene.planes.size() == 1);
  CHECK(scene.planes[0].point == dvec3(0, -1, 0));
  CHECK(scene.planes[0].normal == dvec3(0, 1, 0));
  REQUIRE(scene.objects.size() == 2);
  CHECK(scene.objects[1].where.file == "scene.toml");
  CHECK(scene.objects[1].where.line == 5);
  CHECK(scene.objects[1].where.column == 3);
}

TEST_CASE("toml: objects are numbered by line, whatever their kind") {
  const Scene scene = parse(R"(
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "m"
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "m"
[[mesh]]
shape = "box"
size = [1, 1, 1]
material = "m"
[[sphere]]
center = [1, 0, 0]
radius = 1
material = "m"
)");
  REQUIRE(scene.objects.size() == 4);
  CHECK(scene.objects[0].kind == ObjectKind::sphere);
  CHECK(scene.objects[1].kind == ObjectKind::plane);
  CHECK(scene.objects[2].kind == ObjectKind::mesh);
  CHECK(scene.objects[3].kind == ObjectKind::sphere);
  CHECK(scene.objects[3].first_primitive == 14);
  CHECK(scene.primitive_object.size() == 15);
}

TEST_CASE("toml: objects that begin on one line are numbered by column") {
  const Scene scene = parse(
      "sphere = [{ center = [0, 0, 0], radius = 1, material = 'm' }, { material = 'm', radius = 2, center = "
      "[0, 0, 0] }]"
      "\nplane = [{ point = [0, 0, 0], normal = [0, 1, 0], material = 'm' }]");
  REQUIRE(scene.objects.size() == 3);
  CHECK(scene.spheres[scene.objects[0].first].radius == 1);
  CHECK(scene.spheres[scene.objects[1].first].radius == 2);
  CHECK(scene.objects[0].where.column == 11);
  CHECK(scene.objects[1].where.column == 63);
  CHECK(scene.objects[2].kind == ObjectKind::plane);
}

TEST_CASE("toml: the hash covers the scene file and the mesh files it reads") {
  const TempFolder folder;
  const std::string text = "[[mesh]]\nfile = \"a.obj\"\nmaterial = \"m\"\n" + kCamera + kMaterial;
  const std::string path = folder.write("scene.toml", text);
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string before = load_scene(path).hash;
  CHECK(before.size() == 16);
  CHECK(before.find_first_not_of("0123456789abcdef") == std::string::npos);
  CHECK(load_scene(path).hash == before);
  CHECK(parse_scene(text, path).hash == before);
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  CHECK(load_scene(path).hash != before);
}

TEST_CASE("toml: the hash is FNV-1a of the bytes") {
  const std::string text = "camera = { eye = [1, 2, 3], look_at = [0, 0, 0], view_height = 1 }";
  std::uint64_t state = 14695981039346656037u;
  for (const char c : text) {
    state ^= static_cast<unsigned char>(c);
    state *= 1099511628211u;
  }
  CHECK(std::stoull(parse_scene(text, "").hash, nullptr, 16) == state);
}
