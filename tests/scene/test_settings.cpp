// SPDX-License-Identifier: MIT
// A changed scene as settings, and as a file again: what is read back is the same in every bit.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/error.h"
#include "common/scene/settings.h"
#include "common/scene/toml.h"
#include "tests/picture/folder.h"

using namespace sidelight;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Everything that settings can say, changed to numbers that need all their digits.
Scene changed(Scene scene) {
  const double odd = 1.0 / 3;
  scene.background = {odd, 0.25, 0};
  scene.ambient = {0.1, odd, 0.2};
  scene.width += 3;
  scene.camera.eye += glm::dvec3(odd, -odd / 7, 1e-9);
  scene.camera.up = {0.1, 1, 0};
  scene.trace.depth += 2;
  scene.trace.contribution_cut = odd / 100;
  scene.trace.secondary_attenuation = {1, odd, 0.01};
  scene.trace.shadows = !scene.trace.shadows;
  scene.trace.refraction = !scene.trace.refraction;
  for (Light& light : scene.lights) {
    light.intensity *= 1 + odd;
    if (!light.directional) light.position.y += odd;
  }
  for (Material& material : scene.materials) {
    material.diffuse = {odd, odd * odd, 1e-17};
    material.shininess = 10 * odd;
    material.reflect = glm::dvec3(odd);
    material.ior = 1 + odd;
    material.casts_shadow = !material.casts_shadow;
  }
  return scene;
}

}  // namespace

TEST_CASE("settings: every shipped scene, changed all over, is the same when its new text is read") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SIDELIGHT_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    CAPTURE(entry.path().string());
    ++scenes;
    const std::string path = entry.path().string();
    const Scene before = load_scene(path);
    CHECK(settings_between(before, before).empty());
    const Scene wanted = changed(before);
    const Settings settings = settings_between(before, wanted);
    const Scene by_text = parse_scene(with_settings(text_of(path), settings, path), path);
    CHECK(settings_between(by_text, wanted).empty());
    CHECK(settings_between(load_scene_with(path, settings), wanted).empty());
    // All else is where it was.
    CHECK(by_text.primitive_object == before.primitive_object);
    CHECK(by_text.lesson == before.lesson);
    CHECK(by_text.steps.size() == before.steps.size());
  }
  CHECK(scenes >= 14);
}

TEST_CASE("settings: comments stay, new keys go where their table is, also inline and where there is none") {
  const std::string text =
      "camera = { eye = [0, 0, 5], look_at = [0, 0, 0], view_height = 1 }  # η \u2264 1\n"
      "material = { 'a.b' = {}, c = { diffuse = 0.5 } }   # two\n"
      "[[light]]   # key\n"
      "position = [1, 2, 3]\n"
      "intensity = [1,\n  1,   # green\n  1]\n"
      "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = 'c'\n";
  const Scene before = parse_scene(text, "s.toml");
  const Scene wanted = changed(before);
  const std::string out = with_settings(text, settings_between(before, wanted), "s.toml");
  CAPTURE(out);
  CHECK(settings_between(parse_scene(out, "s.toml"), wanted).empty());
  for (const char* comment : {"# η \u2264 1\n", "# two\n", "[[light]]   # key\n"})
    CHECK(out.find(comment) != std::string::npos);
  CHECK(out.find("[trace]\n") != std::string::npos);
}

TEST_CASE("settings: a byte order mark is no column of the first line") {
  const std::string rest = "\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nview_height = 1\n";
  const std::string mark = "\xEF\xBB\xBF";
  CHECK(with_settings(mark + "background = 0.25" + rest, {{"background", "[1, 0, 1]"}}, "s.toml") ==
        mark + "background = [1, 0, 1]" + rest);
}

TEST_CASE("settings: a material's name may have dots, blanks and quotes of either sort") {
  const std::string camera = "[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nview_height = 1\n";
  for (const char* key : {"plain", "'a.b'", "'a b'", "'a\"b'", "\"a'b\"", "'\".\"'", "'a\\b'", "''"}) {
    CAPTURE(key);
    const std::string text = camera + "[material." + key + "]\ndiffuse = 0.5\n";
    const Scene before = parse_scene(text, "s.toml"), wanted = changed(before);
    const std::string out = with_settings(text, settings_between(before, wanted), "s.toml");
    CHECK(settings_between(parse_scene(out, "s.toml"), wanted).empty());
  }
}

// Two materials of one name: a setting by name would change the scene file's.
TEST_CASE("settings: a change of a mesh file's material is refused") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "m.mtl", "newmtl red\nKd 1 0 0\n");
  test::write_bytes(folder / "m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  const Scene before = parse_scene(
      "camera = { eye = [0, 0, 5], look_at = [0, 0, 0], view_height = 1 }\n"
      "material.red = { diffuse = 0.5 }\n"
      "mesh = [{ file = 'm.obj' }]\n",
      folder / "s.toml");
  REQUIRE(before.materials.size() == 2);
  Scene wanted = before;
  wanted.materials[0].diffuse = {0, 1, 0};
  CHECK(settings_between(before, wanted).size() == 1);
  wanted.materials[1].diffuse = {0, 1, 0};
  const std::string refusal =
      (folder / "s.toml") + ": the material 'red' is a mesh file's, expected changes of the scene file's own";
  CHECK_THROWS_WITH_AS(settings_between(before, wanted), refusal.c_str(), InputError);
}

TEST_CASE("settings: a path that leads nowhere is an error") {
  CHECK_THROWS_AS(with_settings("", {{"light.3.intensity", "1"}}, "s.toml"), InputError);
  CHECK_THROWS_AS(with_settings("", {{"a..b", "1"}}, "s.toml"), InputError);
  CHECK(with_settings("trace.depth = 3\n", {{"trace.depth", "4"}}, "s.toml") == "trace.depth = 4\n");
}

TEST_CASE("settings: where a table is made of dotted keys, so is the new one") {
  const auto with = [](const std::string& text, const Settings& settings) {
    return with_settings(text, settings, "s.toml");
  };
  const Settings off{{"trace.shadows", "false"}};
  CHECK(with("trace.depth = 3\n", off) == "trace.shadows = false\ntrace.depth = 3\n");
  CHECK(with("\xEF\xBB\xBFtrace.depth = 3\n", off) == "\xEF\xBB\xBFtrace.shadows = false\ntrace.depth = 3\n");
  CHECK(with("[material]\nglass.ior = 2\n", {{"material.glass.diffuse", "1"}}) ==
        "[material]\nglass.diffuse = 1\nglass.ior = 2\n");
  CHECK(with("[material]\n'a b'.ior = 2\n", {{"material.\"a b\".diffuse", "1"}}) ==
        "[material]\n\"a b\".diffuse = 1\n'a b'.ior = 2\n");
  CHECK(with("material = { glass.ior = 2 }\n", {{"material.glass.diffuse", "1"}}) ==
        "material = { glass.diffuse = 1, glass.ior = 2 }\n");
}

// What settings_between forgets, it cannot miss in a scene that was read again.
TEST_CASE("settings: each change of what a scene file says is the setting of its name") {
  const Scene before = parse_scene(
      "camera = { eye = [0, 0, 5], look_at = [0, 0, 0], view_height = 1 }\n"
      "material.m = { diffuse = 0.5 }\n"
      "light = [{ position = [1, 2, 3], intensity = 1 }, { direction = [0, -1, 0], intensity = 1 }]\n",
      "s.toml");
  const auto changes = [&](const std::string& path, void (*change)(Scene&)) {
    CAPTURE(path);
    Scene after = before;
    change(after);
    const Settings settings = settings_between(before, after);
    REQUIRE(settings.size() == 1);
    CHECK(settings[0].first == path);
  };
  changes("background", [](Scene& s) { s.background.z = 2; });
  changes("ambient", [](Scene& s) { s.ambient.z = 2; });
  changes("picture.size", [](Scene& s) { ++s.width; });
  changes("picture.size", [](Scene& s) { ++s.height; });
  changes("camera.eye", [](Scene& s) { s.camera.eye.z = 2; });
  changes("camera.look_at", [](Scene& s) { s.camera.look_at.z = 2; });
  changes("camera.up", [](Scene& s) { s.camera.up.z = 2; });
  changes("camera.view_height", [](Scene& s) { s.camera.view_height = 2; });
  changes("trace.depth", [](Scene& s) { s.trace.depth = 2; });
  changes("trace.contribution_cut", [](Scene& s) { s.trace.contribution_cut = 0.5; });
  changes("trace.secondary_attenuation", [](Scene& s) { s.trace.secondary_attenuation.q0 = 2; });
  changes("trace.secondary_attenuation", [](Scene& s) { s.trace.secondary_attenuation.q2 = 2; });
  changes("trace.shadows", [](Scene& s) { s.trace.shadows = false; });
  changes("trace.reflection", [](Scene& s) { s.trace.reflection = false; });
  changes("trace.refraction", [](Scene& s) { s.trace.refraction = false; });
  changes("light.0.intensity", [](Scene& s) { s.lights[0].intensity.z = 2; });
  changes("light.0.position", [](Scene& s) { s.lights[0].position.z = 2; });
  changes("light.0.attenuation", [](Scene& s) { s.lights[0].attenuation.q1 = 2; });
  changes("light.1.direction", [](Scene& s) { s.lights[1].direction = {0, 0, 1}; });
  changes("material.m.ambient", [](Scene& s) { s.materials[0].ambient.z = 2; });
  changes("material.m.diffuse", [](Scene& s) { s.materials[0].diffuse.z = 2; });
  changes("material.m.specular", [](Scene& s) { s.materials[0].specular.z = 2; });
  changes("material.m.shininess", [](Scene& s) { s.materials[0].shininess = 2; });
  changes("material.m.local", [](Scene& s) { s.materials[0].local.z = 2; });
  changes("material.m.reflect", [](Scene& s) { s.materials[0].reflect.z = 2; });
  changes("material.m.refract", [](Scene& s) { s.materials[0].refract.z = 2; });
  changes("material.m.ior", [](Scene& s) { s.materials[0].ior = 2; });
  changes("material.m.casts_shadow", [](Scene& s) { s.materials[0].casts_shadow = false; });
}
