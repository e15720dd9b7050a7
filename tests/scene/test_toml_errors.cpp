// SPDX-License-Identifier: MIT
// Mistakes in a scene file (those of its objects: test_toml_object_errors.cpp): where, and what the message says. A row is a
// snippet from line 1 on; the camera and the material "m" follow it (toml_text.h), unless it is about the camera.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "common/scene/camera.h"
#include "raster/raster.h"
#include "raytrace/raytrace.h"
#include "tests/hardcases/result.h"
#include "tests/scene/temp_folder.h"
#include "tests/scene/toml_text.h"

using namespace sidelight;
using test::check;
using test::error_of;
using test::kCamera;
using test::kMaterial;

TEST_CASE("toml errors: not TOML") {
  check({{"a = ", "1:5", "not valid TOML"},
         {"title = \"open", "1:14", "not valid TOML"},
         {"title = 'a'\ntitle = 'b'", "2:9", "cannot redefine existing string 'title'"},
         {"[trace\n", "1:7", "expected ']'"},
         {"[=]", "1:2", "expected bare key"},
         {"title = \"\xff\"", "1:9", "utf-8"},
         {"# \xc3", "1:2", "utf-8"},
         {"gr\u00f6\u00dfe = 1", "1:3", "not valid TOML"},
         {"ambient = 1 \u00b7", "1:13", "not valid TOML"},
         {"title = red", "1:9", "expected a text in quotes, a number, true, false or an array"},
         {"ambient = 1e400", "1:16", "'1e400' could not be interpreted as a value, expected a finite number"},
         {"ambient = 99999999999999999999", "1:31", "not representable in 64 bits"}});
}

TEST_CASE("toml errors: nesting bombs") {
  std::string keys = "a";
  for (int i = 0; i < 100'000; ++i) keys += ".a";
  const std::string arrays(100'000, '[');
  check({{keys + " = 1", "1:32", "a dotted key goes on here, expected one of at most 16 parts"},
         {"[" + keys + "]", "1:33", "at most 16 parts"},
         {"x = '\"' # \"\n" + keys + " = 1", "2:32", "at most 16 parts"},
         {"x = \"\"\"\n\\\"\"\"\"\n" + keys + " = 1", "3:32", "at most 16 parts"},
         {"x = { y = \"\"\"a\"\"\"\", " + keys + " = 1 }", "1:52", "at most 16 parts"},
         {"x = { y = '''a''''', " + keys + " = 1 }", "1:53", "at most 16 parts"},
         {"\xEF\xBB\xBF" + keys + " = 1", "1:32", "at most 16 parts"},
         {"x = " + arrays, "1:37", "exceeded maximum nested value depth"}});
  const std::string dots(1000, '.');
  CHECK(error_of("lesson = '''" + dots + "'''\n# " + keys + "\ntitle = \"" + dots + "\\\"" + dots + "\"" +
                 kCamera) == "no error");
}

TEST_CASE("toml errors: unknown keys at every level") {
  check({{"titel = ''", "1:1", "unknown key 'titel' in the scene, expected one of"},
         {"titel = ''", "1:1", "did you mean 'title'?"},
         {"[[spere]]", "1:3", "did you mean 'sphere'?"},
         {"[picture]\n  siez = 1", "2:3", "unknown key 'siez' in [picture], expected one of size"},
         {"[trace]\ndepht = 1", "2:1", "did you mean 'depth'?"},
         {"[[light]]\nintensity = 1\ncolour = 1", "3:1", "in [[light]]"},
         {"[material.glass]\nindex = 1.5", "2:1", "unknown key 'index' in [material.glass]"},
         {"[[sphere]]\ncentre = 1", "2:1", "did you mean 'center'?"},
         {"[[plane]]\nnormals = 1", "2:1", "did you mean 'normal'?"},
         {"[[mesh]]\nfiel = ''", "2:1", "did you mean 'file'?"},
         {"[[mesh]]\nshape = 'box'\nmaterial = 'm'\nradius = 1\nsize = [1, 1, 1]", "4:1",
          "unknown key 'radius' in [[mesh]] of shape 'box'"},
         {"[[mesh]]\nshape = 'box'\nsize = [1, 1, 1]\nmaterial = 'm'\ntransform = { move = 1 }", "5:15",
          "in transform, expected one of translate, rotate, scale, matrix"},
         {"[[step]]\ntext = ''\nmod = ''", "3:1", "did you mean 'mode'?"},
         {"'\\u001b[31m' = 1", "1:1", "unknown key '\\u001b[31m'"},
         {"\"\\u001b[31m\" = 1", "1:1", "unknown key '\\x1B[31m'"}});
  check({{"yes = 1", "3:1", "in [camera]"}}, "[camera]\neye = [0, 0, 1]\n", "");
}

TEST_CASE("toml errors: wrong types") {
  check({{"title = 1", "1:9", "'title' is 1, expected a text in quotes"},
         {"lesson = []", "1:10", "'lesson' is an array of 0, expected a text"},
         {"background = 'red'", "1:14", "'background' is the text 'red', expected a colour"},
         {"ambient = true", "1:11", "'ambient' is true, expected a colour"},
         {"ambient = [1, '1', 1]", "1:15", "'ambient' is the text '1', expected a number"},
         {"ambient = 1979-05-27", "1:11", "is a date or time"},
         {"picture = 1", "1:11", "expected a table"},
         {"[[trace]]", "1:1", "'trace' is an array of 1, expected a table"},
         {"trace.shadows = 1", "1:17", "'shadows' is 1, expected true or false"},
         {"trace.depth = 6.0", "1:15", "'depth' is 6.0, expected a whole number from 1 to 1000"},
         {"[light]", "1:1", "'light' is a table, expected tables, each begun by [[light]]"},
         {"sphere = [1]", "1:11", "'sphere' is 1, expected tables, each begun by [[sphere]]"},
         {"material.glass = 1", "1:18", "'glass' is 1, expected a table"},
         {"[material.x]\ncasts_shadow = 'no'", "2:16", "expected true or false"},
         {"[[step]]\ntext = 1", "2:8", "expected a text"},
         {"[[step]]\ntext = ''\nmode = 'cause'", "3:8", "did you mean 'causes'?"},
         {"step = {}", "1:8", "each begun by [[step]]"}});
  check({{"material = []", "1:12", "'material' is an array of 0, expected a table"}}, "", kCamera);
}

TEST_CASE("toml errors: wrong lengths") {
  check({{"background = [1, 1]", "1:14", "'background' is an array of 2, expected an array of 3"},
         {"picture.size = [640]", "1:16", "'size' is an array of 1, expected [width, height]"},
         {"trace.secondary_attenuation = [1, 0, 0, 0]", "1:31", "an array of 4, expected an array of 3"},
         {"[[step]]\ntext = ''\neye = [1]", "3:7", "expected an array of 3"}});
}

TEST_CASE("toml errors: missing keys, at the table that lacks them") {
  check(
      {{"[[light]]\nposition = [0, 0, 0]", "1:1", "[[light]] lacks 'intensity', which is required"},
       {"\n [[light]]\nintensity = 1", "2:2",
        "[[light]] has none of them, expected exactly one of position, direction"},
       {"[[sphere]]\nradius = 1\nmaterial = 'm'", "1:1", "lacks 'center'"},
       {"[[sphere]]\ncenter = [0, 0, 0]\nmaterial = 'm'", "1:1", "lacks 'radius'"},
       {"sphere = [{ center = [0, 0, 0], radius = 1 }]", "1:11", "lacks 'material'"},
       {"[[plane]]\nnormal = [0, 1, 0]\nmaterial = 'm'", "1:1", "lacks 'point'"},
       {"[[plane]]\npoint = [0, 1, 0]\nmaterial = 'm'", "1:1", "lacks 'normal'"},
       {"[[mesh]]\nmaterial = 'm'", "1:1", "has none of them, expected exactly one of file, shape, vertices"},
       {"[[step]]\nmode = 'raster'", "1:1", "lacks 'text'"}});
  check(
      {{"title = ''", "1:1", "the scene lacks 'camera'"},
       {"", "1:1", "the scene lacks 'camera'"},
       {"\n[camera]\nlook_at = [0, 0, 0]\nvertical_fov = 1", "2:1", "[camera] lacks 'eye'"},
       {"camera.eye = [0, 0, 1]\ncamera.vertical_fov = 1", "1:1", "[camera] lacks 'look_at'"},
       {"[camera]\neye = [0, 0, 1]\nlook_at = [0, 0, 0]", "1:1", "exactly one of vertical_fov, view_height"}},
      "", "");
}

// INP-1: and those at the edge of nothing, which are 0 or as good as it, are read or refused where they stand, but make
// no picture with a hole in it.
TEST_CASE("toml errors: numbers that are not finite, in every field") {
  std::uint64_t fields = 0, not_refused = 0, misplaced = 0, faulty = 0, pixels = 0;
  const auto draw = [&](const std::string& text) {
    const Scene scene = parse_scene(text, "scene.toml");
    const Camera camera = make_camera(scene.camera, 8, 6, 1);
    for (const Frame& frame : {raster::render(*raster::prepare(scene), camera, {}),
                               raytrace::render(*raytrace::prepare(scene), camera, {})}) {
      pixels += frame.pixels();
      faulty += !first_non_finite(frame).empty();
    }
  };
  struct Field {
    std::string before, after;
  };
  const std::string sphere = "[[sphere]]\nmaterial = 'm'\n", mesh = "[[mesh]]\nmaterial = 'm'\n";
  const std::string box = mesh + "shape = 'box'\nsize = [1, 1, 1]\n", light = "[[light]]\n";
  for (const Field& field :
       std::vector<Field>{{"background = ", ""},
                          {"ambient = [0, 0, ", "]"},
                          {"picture.size = [", ", 1]"},
                          {"trace.depth = ", ""},
                          {"trace.contribution_cut = ", ""},
                          {"trace.secondary_attenuation = [1, ", ", 1]"},
                          {light + "intensity = 1\nposition = [", ", 0, 0]"},
                          {light + "intensity = 1\ndirection = [", ", 0, 0]"},
                          {light + "position = [0, 0, 0]\nintensity = ", ""},
                          {light + "position = [0, 0, 0]\nintensity = 1\nattenuation = [", ", 0, 0]"},
                          {"material.x.ambient = ", ""},
                          {"material.x.diffuse = ", ""},
                          {"material.x.specular = ", ""},
                          {"material.x.shininess = ", ""},
                          {"material.x.local = ", ""},
                          {"material.x.reflect = ", ""},
                          {"material.x.refract = ", ""},
                          {"material.x.ior = ", ""},
                          {sphere + "radius = 1\ncenter = [0, ", ", 0]"},
                          {sphere + "center = [0, 0, 0]\nradius = ", ""},
                          {"[[plane]]\nmaterial = 'm'\nnormal = [0, 1, 0]\npoint = [0, 0, ", "]"},
                          {"[[plane]]\nmaterial = 'm'\npoint = [0, 1, 0]\nnormal = [0, 0, ", "]"},
                          {mesh + "faces = []\nvertices = [[0, 0, ", "]]"},
                          {mesh + "vertices = [[0, 0, 0], [0, 0, 1], [0, 1, 0]]\nfaces = [[0, 1, ", "]]"},
                          {mesh + "shape = 'box'\nsize = [1, 1, ", "]"},
                          {mesh + "shape = 'cone'\nheight = 1\nradius = ", ""},
                          {mesh + "shape = 'cone'\nradius = 1\nheight = ", ""},
                          {mesh + "shape = 'cone'\nradius = 1\nheight = 1\nsegments = ", ""},
                          {mesh + "shape = 'torus'\nradii = [1, ", "]"},
                          {mesh + "shape = 'torus'\nradii = [2, 1]\nsegments = [3, ", "]"},
                          {box + "transform.translate = [0, 0, ", "]"},
                          {box + "transform.rotate = [0, 0, ", "]"},
                          {box + "transform.scale = ", ""},
                          {box + "transform.scale = [1, 1, ", "]"},
                          {box + "transform.matrix = [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0, ", "]"},
                          {"[[step]]\ntext = ''\neye = [0, 0, ", "]"}}) {
    CAPTURE(field.before);
    for (const std::string value : {"nan", "inf", "-inf", "1e400"}) {
      const std::string error = error_of(field.before + value + field.after + kCamera + kMaterial);
      CAPTURE(error);
      CHECK(error.find(value == "1e400" ? "'1e400' could not" : "is " + value + ", expected") !=
            std::string::npos);
      // At the value; toml++ itself reports 1e400, behind it.
      const std::string line_text = field.before.substr(field.before.rfind('\n') + 1);
      const auto line = std::count(field.before.begin(), field.before.end(), '\n') + 1;
      const auto column = line_text.size() + (value == "1e400" ? 6 : 1);
      CHECK(error.find("scene.toml:" + std::to_string(line) + ":" + std::to_string(column) + ": ") == 0);
      ++fields;
      not_refused += error == "no error";
    }
    for (const std::string value : {"-0.0", "1e-45", "-1e-45", "5e-324", "3.5e38"}) {
      const std::string text = field.before + value + field.after + kCamera + kMaterial;
      const std::string error = error_of(text);
      const auto line = std::count(field.before.begin(), field.before.end(), '\n') + 1;
      ++fields;
      if (error != "no error") {
        misplaced += error.find("scene.toml:" + std::to_string(line) + ":") != 0 &&
                     error.find("scene.toml:1:1:") != 0;  // an object as a whole
        continue;
      }
      draw(text);
    }
  }
  for (const std::string value :
       {"nan", "inf", "-inf", "1e400", "-0.0", "1e-45", "-1e-45", "5e-324", "3.5e38"})
    for (const std::string& camera :
         {"eye = [0, 0, " + value + "]\nlook_at = [0, 0, 0]\nview_height = 1",
          "eye = [0, 0, 1]\nlook_at = [0, " + value + ", 0]\nview_height = 1",
          "eye = [0, 0, 1]\nlook_at = [0, 0, 0]\nview_height = " + value,
          "eye = [0, 0, 1]\nlook_at = [0, 0, 0]\nvertical_fov = " + value,
          "eye = [0, 0, 1]\nlook_at = [0, 0, 0]\nview_height = 1\nup = [" + value + ", 1, 0]"}) {
      const std::string ball = "\n[[light]]\nposition = [3, 4, 5]\nintensity = 1\n" + kMaterial +
                               "\n[[sphere]]\ncenter = [0, 0, -2]\nradius = 1\nmaterial = 'm'\n";
      const std::string error = error_of("[camera]\n" + camera + ball);
      ++fields;
      if (value.find_first_of("ni") != std::string::npos || value == "1e400")
        not_refused += error == "no error";
      else if (error == "no error")
        draw("[camera]\n" + camera + ball);
      else
        misplaced += error.find("scene.toml:") != 0 || error.find("scene.toml:1:") == 0;
    }
  const test::HardCase hard("INP-1");
  hard.none("numbers that are not finite and yet accepted", not_refused, fields);
  hard.none("numbers next to nothing or beyond float that are refused elsewhere", misplaced, fields);
  hard.none("pictures with a value that is not finite, of those accepted", faulty, pixels);
}

TEST_CASE("toml errors: the camera") {
  const std::string eye = "[camera]\neye = [0, 0, 1]\n", camera = eye + "look_at = [0, 0, 0]\n";
  check(
      {{camera + "vertical_fov = 0", "4:16",
        "'vertical_fov' is 0, expected an angle in degrees above 0 and below 180"},
       {camera + "vertical_fov = 180", "4:16", "below 180"},
       {camera + "vertical_fov = nan", "4:16", "is nan"},
       {camera + "view_height = 0", "4:15", "'view_height' is 0, expected a length above 0"},
       {camera + "view_height = -1", "4:15", "expected a length"},
       {camera + "view_height = inf", "4:15", "is inf"},
       {camera + "view_height = 1\nvertical_fov = 1", "4:1", "[camera] has 'vertical_fov' and 'view_height'"},
       {camera + "view_height = 1\nup = [0, 0, 0]", "5:6", "expected a direction: 3 numbers, not all 0"},
       {camera + "view_height = 1\nup = [0, inf, 0]", "5:10", "is inf"},
       {eye + "look_at = [0, 0, 1.0]\nview_height = 1", "3:11", "expected a point other than the eye"},
       {eye + "look_at = [0, 0, 2e15]\nview_height = 1", "3:18",
        "'look_at' is 2e+15, expected a number from -1e15"},
       {"[camera]\nlook_at = [1e-31, 0, 0]\neye = [0, 0, 0]\nview_height = 1", "2:11", "other than the eye"}},
      "", "");
}

TEST_CASE("toml errors: ranges") {
  check({{"background = -1", "1:14", "'background' is -1, expected a number from 0 to 1e30"},
         {"ambient = [0, -0.5, 0]", "1:15", "'ambient' is -0.5"},
         {"picture.size = [0, 1]", "1:17", "'size' is 0, expected a whole number from 1 to 65535"},
         {"picture.size = [1, 65536]", "1:20", "'size' is 65536"},
         {"picture.size = [1.5, 1]", "1:17", "'size' is 1.5"},
         {"trace.depth = 0", "1:15", "'depth' is 0"},
         {"trace.depth = 1001", "1:15", "'depth' is 1001"},
         {"trace.contribution_cut = 1.5", "1:26", "expected a number from 0 to 1"},
         {"trace.contribution_cut = -0.1", "1:26", "expected a number from 0 to 1"},
         {"trace.secondary_attenuation = [0, 0, 0]", "1:31", "expected 3 coefficients with a sum above 0"},
         {"trace.secondary_attenuation = [9e-31, 0, 0]", "1:31", "(from 1e-30)"},
         {"trace.secondary_attenuation = [1, -1, 0]", "1:35", "is -1"},
         {"material.x.diffuse = -0.1", "1:22", "is -0.1"},
         {"material.x.shininess = -1", "1:24", "expected a number from 0 to 1e6"},
         {"material.x.shininess = 1000001", "1:24", "expected a number from 0 to 1e6"},
         {"material.x.ior = 0.2", "1:18", "expected a number from 0.25 to 4"},
         {"material.x.ior = 4.5", "1:18", "expected a number from 0.25 to 4"}});
}

TEST_CASE("toml errors: lights") {
  const std::string point = "[[light]]\nposition = [0, 0, 0]\n";
  check({{point + "intensity = -1", "3:13", "'intensity' is -1"},
         {point + "intensity = 1\ndirection = [0, 1, 0]", "4:1",
          "has 'position' and 'direction', expected exactly one"},
         {point + "intensity = 1\nattenuation = [0, 0, 0]", "4:15", "a sum above 0"},
         {point + "intensity = 1\nattenuation = [0, 0, -1]", "4:22", "'attenuation' is -1"},
         {"[[light]]\nposition = [0, 0, 1.1e15]\nintensity = 1", "2:19",
          "expected a number from -1e15 to 1e15"},
         {"[[light]]\ndirection = [0, 0, 0]\nintensity = 1", "2:13", "expected a direction"},
         {"[[light]]\ndirection = [0, 1, 0]\nintensity = 1\nattenuation = [1, 0, 0]", "4:15",
          "expected none: light from a direction"}});
}

TEST_CASE("toml errors: scene files that cannot be read name the file as a whole") {
  const TempFolder folder;
  const auto error = [](const std::string& path) -> std::string {
    try {
      load_scene(path);
      return "no error";
    } catch (const InputError& e) {
      return e.what();
    }
  };
  const std::string gone = (folder.path / "gone.toml").string(),
                    huge = folder.write("huge.toml", std::string(17 << 20, '\n'));
  CHECK(error(gone) == gone + ": no such file");
  CHECK(error(folder.path.string()) == folder.path.string() + ": is a folder, expected a file");
  CHECK(error(huge).find(huge + ": is larger than 16 MiB") == 0);
  CHECK(error(folder.write("empty.toml", "")) != "no error");
}
