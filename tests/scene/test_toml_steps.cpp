// SPDX-License-Identifier: MIT
// A lesson's steps, what they set, and load_scene_with.
#include <doctest/doctest.h>

#include <glm/vec3.hpp>

#include "common/scene/step_modes.h"
#include "tests/scene/temp_folder.h"
#include "tests/scene/toml_text.h"

using namespace sidelight;
using glm::dvec3;
using test::error_of;
using test::kCamera;
using test::kMaterial;
using test::parse;
using Settings = std::vector<std::pair<std::string, std::string>>;

namespace {

const std::string kLesson = R"([material."dark.red"]
diffuse = 1
[[light]]
position = [0, 9, 0]
intensity = 1
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "m"
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "m"
)";

std::string step_error(const std::string& set) {
  return error_of("[[step]]\ntext = ''\nset = " + set + "\n" + kLesson + kCamera + kMaterial);
}

Scene with(const Settings& set) {
  const TempFolder folder;
  return load_scene_with(folder.write("scene.toml", kLesson + kCamera + kMaterial), set);
}

std::string error_with(const Settings& set) {
  try {
    with(set);
    return "no error";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("toml: steps are read in order") {
  const Scene scene = parse(R"([[step]]
text = "Predict"
mode = "causes"
eye = [0, 2, 7]
set = { "trace.depth" = 1, ambient = [0.1, 1, 2.0], "camera.vertical_fov" = 30 }
[[step]]
text = "And now?"
[[step]]
text = "Nested"
set = { trace = { shadows = false }, title = "a\nb", material.m.diffuse = 0.1, mesh = {} }
)");
  REQUIRE(scene.steps.size() == 3);
  CHECK(scene.steps[0].text == "Predict");
  CHECK(scene.steps[0].mode == "causes");
  CHECK(scene.steps[0].eye == dvec3(0, 2, 7));
  CHECK(scene.steps[0].set ==
        Settings{{"trace.depth", "1"}, {"ambient", "[0.1, 1, 2]"}, {"camera.vertical_fov", "30"}});
  CHECK(scene.steps[1].mode.empty());
  CHECK_FALSE(scene.steps[1].eye.has_value());
  CHECK(scene.steps[1].set.empty());
  CHECK(scene.steps[2].set ==
        Settings{{"trace.shadows", "false"}, {"title", "\"a\\nb\""}, {"material.m.diffuse", "0.1"}});
  CHECK(scene.trace.depth == 6);  // steps are applied by who shows them
}

TEST_CASE("toml: every mode of the list is valid") {
  for (const std::string_view mode : kStepModes)
    CHECK(parse("[[step]]\ntext = ''\nmode = '" + std::string(mode) + "'").steps[0].mode == mode);
}

TEST_CASE("toml: a setting reaches every part of the format") {
  const Scene scene = with({{"trace.depth", "1"},  // a table that the file leaves out
                            {"picture.size", "[10, 20]"},
                            {"background", "0.5"},
                            {"camera.eye.1", "3"},
                            {"light.0.intensity", "[1, 2, 3]"},
                            {"material.m.reflect", "0.5"},
                            {"material.\"dark.red\".diffuse", "0.25"},
                            {"sphere.0.radius", "2"},
                            {"plane.0.material", "'dark.red'"}});
  CHECK(scene.trace.depth == 1);
  CHECK(scene.width == 10);
  CHECK(scene.height == 20);
  CHECK(scene.background == dvec3(0.5));
  CHECK(scene.camera.eye == dvec3(0, 3, 5));
  CHECK(scene.lights[0].intensity == dvec3(1, 2, 3));
  CHECK(scene.materials[1].reflect == dvec3(0.5));
  CHECK(scene.materials[0].diffuse == dvec3(0.25));
  CHECK(scene.spheres[0].radius == 2);
  CHECK(scene.planes[0].material == 0);
  CHECK(scene.objects[0].kind == ObjectKind::sphere);  // numbers stay
}

TEST_CASE("toml: what a step sets can be given to load_scene_with") {
  const Scene scene =
      parse(kLesson + "[[step]]\ntext = ''\nset = { \"material.'dark.red'.diffuse\" = [0.1, 1e-7, 3] }");
  CHECK(with(scene.steps[0].set).materials[0].diffuse == dvec3(0.1, 1e-7, 3));
}

TEST_CASE("toml: a step's large number stays a number") {
  const Scene scene = parse(
      kLesson + "[[step]]\ntext = ''\nset = { ambient = [1.2345678901234567e19, 1e15, 987654321098765.0] }");
  CHECK(with(scene.steps[0].set).ambient == dvec3(1.2345678901234567e19, 1e15, 987654321098765.0));
}

TEST_CASE("toml: load_scene_with keeps the file's hash and steps") {
  const TempFolder folder;
  const std::string path =
      folder.write("scene.toml", kLesson + "[[step]]\ntext = ''\nset = { 'camera.vertical_fov' = 30 }" +
                                     kCamera + kMaterial);
  const Scene scene = load_scene_with(path, {{"camera.vertical_fov", "45"}});
  CHECK(scene.hash == load_scene(path).hash);
  REQUIRE(scene.steps.size() == 1);
  CHECK(scene.steps[0].set.size() == 1);
}

TEST_CASE("toml: load_scene_with reports settings that lead nowhere or are no value") {
  CHECK(error_with({{"trace.depth", "0"}}).find("scene.toml: 'depth' is 0, expected") != std::string::npos);
  CHECK(error_with({{"trace.depht", "1"}}).find("scene.toml: unknown key 'depht'") != std::string::npos);
  CHECK(error_with({{"trace.depth", "1\nx = 2"}}).find("expected one value") != std::string::npos);
  CHECK(error_with({{"trace.depth", "?"}}).find("(set trace.depth):1:1: ") != std::string::npos);
  CHECK(error_with({{"camera.eye", "[\n0 ?]"}}).find("(set camera.eye):2:3: ") != std::string::npos);
  CHECK(error_with({{"light.1.intensity", "1"}}).find("no element '1', expected 0, the only one") !=
        std::string::npos);
}

TEST_CASE("toml: a step's setting is checked where it stands") {
  struct Case {
    std::string set, column, message;
  };
  for (const Case& c : std::vector<Case>{
           {"{ 'trace.depth' = 0 }", "25", "'depth' is 0, expected a whole number from 1"},
           {"{ 'trace.depht' = 1 }", "9", "did you mean 'depth'?"},
           {"{ 'trce.depth' = 1 }", "9", "unknown key 'trce' in the scene"},
           {"{ trace.depth = 1.5 }", "23", "expected a whole number"},
           {"{ ambient = [1, nan, 1] }", "23", "'ambient' is nan"},
           {"{ 'material.n.diffuse' = 1 }", "9",
            "there is no 'n', expected one of dark.red, m; did you mean 'm'?"},
           {"{ 'material.m.difuse' = 1 }", "9", "did you mean 'diffuse'?"},
           {"{ 'material.n' = 1 }", "24", "'n' is 1, expected a table"},
           {"{ 'light.1.intensity' = 1 }", "9", "no element '1'"},
           {"{ 'light.x.intensity' = 1 }", "9", "no element 'x'"},
           {"{ 'light.0.intensity.3' = 1 }", "9", "nothing inside a plain value"},
           {"{ light = [] }", "9", "expected the path of one value"},
           {"{ 'sphere.0' = 1 }", "9", "expected the path of one value"},
           {"{ mesh = [{ shape = 'box' }] }", "9", "expected the path of one value"},
           {"{ 'mesh.0.scale' = 1 }", "1", "'mesh' is a table, expected tables"},
           {"{ 'sphere.0.material' = 'M' }", "31", "did you mean"},
           {"{ 'camera.view_height' = 1 }", "9", "[camera] has 'vertical_fov' and 'view_height'"},
           {"{ 'camera.eye' = [0, 0, 0] }", "1", "expected a point other than the eye"},
           {"{ 'step.0.text' = '' }", "9", "settings belong to steps"},
           {"{ 'trace..depth' = 1 }", "9", "is not a key path"},
           {"{ \"trace.'depth\" = 1 }", "9", "is not a key path"},
           {"{ '' = 1 }", "9", "is not a key path"},
           {"{ 'a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a' = 1 }", "9", "is not a key path"},
           {"{ trace = 1 }", "17", "'trace' is 1, expected a table"},
           {"1", "7", "'set' is 1, expected a table"},
       }) {
    CAPTURE(c.set);
    const std::string error = step_error(c.set);
    CHECK(error.find(c.message) != std::string::npos);
    const std::string line = c.column == "1" ? "1" : "3";  // no single value is to blame: the step
    CHECK(error.substr(0, error.find(' ')) == "scene.toml:" + line + ":" + c.column + ":");
  }
}

TEST_CASE("toml: a step's eye must not be where the camera looks") {
  const std::string error = error_of("[[step]]\ntext = ''\neye = [0, 0, 0]" + kCamera);
  CHECK(error.find("scene.toml:1:1: 'look_at' is an array of 3, expected a point other than the eye") == 0);
  CHECK(parse("[[step]]\ntext = ''\neye = [0, 0, 0]\nset = { 'camera.look_at' = [0, 0, 1] }").steps.size() ==
        1);
  // With other settings a step is not checked: it starts from the file without them.
  const TempFolder folder;
  const std::string path = folder.write("scene.toml", "[[step]]\ntext = ''\neye = [0, 0, 1]" + kCamera);
  CHECK(load_scene_with(path, {{"camera.look_at", "[0, 0, 1]"}}).steps.size() == 1);
}

TEST_CASE("toml: a lesson has at most 100 steps") {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "[[step]]\ntext = ''\n";
  CHECK(parse(text).steps.size() == 100);
  CHECK(error_of(text + "[[step]]\ntext = ''" + kCamera).find("expected at most 100 steps") !=
        std::string::npos);
}
