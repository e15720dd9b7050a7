// SPDX-License-Identifier: MIT
// What leaves the window: scene files that load to what was shown, commands that tell what the inspector tells.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/viewer/window/session.h"
#include "viewer/window/inspection.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

const SceneOpener open_plain = opener(64, 48);

const std::string kStep =
    "[picture]\nsize = [64, 48]\n"
    "[[step]]\ntext = 'Larger.'\neye = [0, 2, 7]\nset = { 'sphere.0.radius' = 1.25 }\n";

// The scene shown in every bit, by what is drawn of it.
bool same_picture(const WindowState& state, const Scene& scene) {
  PictureTask other = picture_task(state);
  other.scene = std::make_shared<const Scene>(scene);
  other.camera = scene.camera;
  const auto a = render_pictures(picture_task(state)).traced, b = render_pictures(other).traced;
  return same_bits(a->color, b->color);
}

}  // namespace

TEST_CASE("save: the new file loads to what was shown, and no file is overwritten") {
  const Workplace here;
  write_bytes(here / "scene.toml", "background = 0.25\n" + kGoodScene + kStep);
  write_bytes(here / "scene-2.toml", "mine");
  Session session(open_state(here / "scene.toml", open_plain), open_plain);
  for (const char* key : {"n", "n", "Left", "Shift+Up", ".", "D", "g"}) session.press(key, kPanel);
  session.edit([](Scene& scene) {
    scene.lights[0].intensity = {0.1, 1.0 / 3, 0.7};
    scene.materials[0].shininess = 7.25;
  });
  session.press("s", kPanel);
  CAPTURE(session.state().notice.text);
  CHECK_FALSE(session.state().notice.error);
  CHECK(read_bytes(here / "scene-2.toml") == "mine");
  const Scene saved = load_scene(here / "scene-3.toml");
  CHECK(saved.spheres[0].radius == 1.25);  // the step's
  CHECK(saved.camera.eye == session.state().camera.eye);
  CHECK(same_picture(session.state(), saved));

  session.edit([](Scene& scene) { scene.lights[0].intensity.y = -1; });  // which no file may have
  session.press("s", kPanel);
  CHECK(session.state().notice.error);
  CHECK_FALSE(std::filesystem::exists(here / "scene-4.toml"));
}

TEST_CASE("copy as command: explain then prints the inspector's words") {
  const Workplace here;
  write_bytes(here / "scene.toml", kGoodScene + kStep);
  Session session(open_state(here / "scene.toml", open_plain), open_plain);
  session.press("y", kPanel);
  CHECK(session.take_clipboard() == "");  // nothing inspected
  session.inspect({40, 26});
  for (const char* key : {"Left", "D", "a", "y"}) session.press(key, kPanel);
  const std::string command = session.take_clipboard();
  CHECK(session.take_clipboard() == "");
  REQUIRE(command.rfind("sidelight explain ", 0) == 0);

  const Outcome outcome = here.run_in_shell("eval \"$0 ${1#sidelight }\"", {command});
  CAPTURE(command);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const Inspection inspection = *inspect_pixel(session.state(), rested(session));
  REQUIRE(inspection.samples.size() == 4);
  for (const ExplainedSample& sample : inspection.samples) {
    CHECK(outcome.out.find(raster_words(*inspection.scene, sample.raster, 1)) != std::string::npos);
    CHECK(outcome.out.find(ray_words(*inspection.scene, sample.raytrace, 1)) != std::string::npos);
  }
}

TEST_CASE("inspection: the facets of a tessellation are told of, other faults are not, and so it says") {
  CHECK(told_of_faults({}).empty());
  Faults faults;
  faults.tessellate = 4;
  CHECK(told_of_faults(faults) == "told of the facets");
  faults.snap_bits = 2;
  CHECK(told_of_faults(faults) == "told of the facets, but as without the other faults on purpose");
  CHECK(told_of_faults(faults.without(FaultKind::tessellate)) == "told as without the faults on purpose");

  // And it is so: the facet, a triangle, lies behind the sphere's surface.
  const Workplace here;
  write_bytes(here / "scene.toml", kGoodScene + kStep);
  const auto first_hit = [&](const Faults& on) {
    Session session(open_state(here / "scene.toml", open_plain), open_plain);
    session.set_faults(on);
    session.inspect({30, 22});
    return inspect_pixel(session.state(), rested(session))->samples[0].raytrace.local.hit.t;
  };
  const double exact = first_hit({});
  CHECK(first_hit(faults) > exact);
  CHECK(first_hit(faults.without(FaultKind::tessellate)) == exact);
}

TEST_CASE("inspection: rays start where the eye's ends, and the lobe's value is the model's") {
  const Workplace here;
  write_bytes(here / "scene.toml", kGoodScene + kStep);
  WindowState state = open_state(here / "scene.toml", open_plain);
  const Pictures pictures = render_pictures(picture_task(state));
  CHECK_FALSE(inspect_pixel(state, pictures).has_value());
  int lobes = 0;
  for (int x = 4; x < 64; x += 6) {
    state.inspected = {x, 26};
    const Inspection inspection = *inspect_pixel(state, pictures);
    const RayRecord& root = inspection.samples[0].raytrace;
    for (const RaySegment& segment : ray_segments(inspection)) {
      CHECK(segment.from != segment.to);
      if (segment.kind == SegmentKind::light_seen || segment.kind == SegmentKind::light_blocked)
        CHECK(segment.to == state.scene->lights[0].position);
    }
    if (root.background) CHECK(ray_segments(inspection).empty());
    if (const auto lobe = specular_lobe(inspection)) {
      ++lobes;
      // The float kernel's value against the angle's in double: a few roundings of a number near 1, s = 1 here.
      CHECK(std::max(0.0, std::cos(lobe->view_angle)) == doctest::Approx(lobe->value).epsilon(1e-5));
    }
  }
  CHECK(lobes > 3);
}

TEST_CASE("inspection: of too many rays to explain none is told of, but all of the z-buffer") {
  const Workplace here;
  write_bytes(here / "scene.toml", sheets_of_glass());
  WindowState state = open_state(here / "scene.toml", opener(8, 6));
  state.inspected = {4, 3};
  for (const int depth : {8, 15}) {
    CAPTURE(depth);
    Scene scene = *state.scene;
    scene.trace.depth = depth;
    state.scene = state.drawn = std::make_shared<const Scene>(scene);
    const Inspection inspection = *inspect_pixel(state, render_pictures(picture_task(state)));
    CHECK(inspection.too_many_rays == (depth == 15));
    CHECK(ray_segments(inspection).empty() == inspection.too_many_rays);
    CHECK(specular_lobe(inspection).has_value() != inspection.too_many_rays);
    CHECK(inspection.samples.at(0).raster.fragments.size() == 8);
  }
}

TEST_CASE("inspection: rays to lights, free and blocked, and the lobe of the brighter of two") {
  const Workplace here;
  // In the middle a wall stands between the floor and the first lamp; the second, from a direction, is far brighter.
  write_bytes(
      here / "scene.toml",
      "[picture]\nsize = [9, 9]\n[camera]\neye = [0, 4, 0]\nlook_at = [0, 0, 0]\nvertical_fov = 10\n"
      "[[light]]\nposition = [9, 2, 0]\nintensity = 0.01\n[[light]]\ndirection = [1, -1, 0]\nintensity = 1\n"
      "[material.floor]\ndiffuse = 0.5\nspecular = 1\n"
      "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = 'floor'\n"
      "[[sphere]]\ncenter = [4.5, 1, 0]\nradius = 0.5\nmaterial = 'floor'\n");
  WindowState state = open_state(here / "scene.toml", opener(9, 9));
  state.inspected = {4, 4};
  state.n = 3;
  const Inspection inspection = *inspect_pixel(state, render_pictures(picture_task(state)));
  const std::vector<RaySegment> segments = ray_segments(inspection);
  REQUIRE(segments.size() == 2);
  CHECK(segments[0].from == inspection.samples[4].raytrace.local.surface.point);  // of the middle one
  CHECK(segments[0].kind == SegmentKind::light_blocked);
  CHECK(segments[0].to == state.scene->lights[0].position);
  CHECK(segments[1].kind == SegmentKind::light_seen);
  const glm::dvec3 way = segments[1].to - segments[1].from;
  CHECK(glm::distance(glm::normalize(way), -state.scene->lights[1].direction) < 1e-12);
  const Lobe lobe = *specular_lobe(inspection);
  CHECK(lobe.light == 1);
  CHECK(lobe.light_angle == doctest::Approx(std::numbers::pi / 4));
}

// All angles from N: in the middle of the picture the lamp is 36.9 degrees from it, Rl as much to the other side, and the eye
// on the lamp's side; at the left and right the rays leave the plane of N and L.
TEST_CASE("inspection: the plot of a lobe shows V above the surface") {
  const Workplace here;
  write_bytes(
      here / "scene.toml",
      "[picture]\nsize = [64, 48]\n[camera]\neye = [4, 1.5, 0]\nlook_at = [0, 0, 0]\nvertical_fov = 40\n"
      "[[light]]\nposition = [3, 4, 0]\nintensity = 1\n[material.floor]\ndiffuse = 0.5\nspecular = 1\n"
      "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = 'floor'\n");
  WindowState state = open_state(here / "scene.toml", open_plain);
  const Pictures pictures = render_pictures(picture_task(state));
  for (int x = 2; x < 64; x += 10) {
    CAPTURE(x);
    state.inspected = {x, 26};
    const auto lobe = specular_lobe(*inspect_pixel(state, pictures));
    REQUIRE(lobe.has_value());
    const double shown = lobe->light_angle + (lobe->towards_normal ? -1 : 1) * lobe->view_angle;
    CHECK(std::abs(shown) < std::numbers::pi / 2);
  }
}
