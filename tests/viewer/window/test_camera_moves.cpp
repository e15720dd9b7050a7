// SPDX-License-Identifier: MIT
// How mouse and keys move the camera, and where points of the scene lie in the picture.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "tests/viewer/window/session.h"
#include "viewer/window/camera_moves.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("camera moves: distances stay, poles are not passed, points project onto their own rays") {
  CameraSettings camera;
  camera.eye = {1, 2, 7};
  camera.look_at = {0, 0.5, -1};
  const double distance = glm::distance(camera.eye, camera.look_at);
  CameraSettings moved = camera;
  for (int i = 0; i < 500; ++i) moved = orbit(moved, 0.05, 0.03);
  CHECK(glm::distance(moved.eye, moved.look_at) == doctest::Approx(distance));
  CHECK(moved.eye.y - moved.look_at.y < distance);
  CHECK(moved.eye.y - moved.look_at.y > 0.99 * distance);
  const double aside = std::hypot(moved.eye.x - moved.look_at.x, moved.eye.z - moved.look_at.z);
  // Nearer to the pole, the picture would roll at a touch.
  CHECK(aside == doctest::Approx(std::sin(0.02) * distance));
  const CameraSettings back = orbit(orbit(camera, 0.3, 0), -0.3, 0);
  CHECK(glm::distance(back.eye, camera.eye) < 1e-12 * distance);
  CHECK(orbit(camera, 0.1, 0).eye.x > camera.eye.x);  // to the right
  CHECK(orbit(camera, 0, 0.1).eye.y > camera.eye.y);
  CHECK(slide(camera, {0, 0.5}).look_at.y > camera.look_at.y);

  CameraSettings near = camera;
  for (int i = 0; i < 2000; ++i) near = dolly(near, 0.9);
  CHECK(near.eye != near.look_at);
  for (int i = 0; i < 2000; ++i) near = dolly(near, 1.5);
  CHECK(glm::length(near.eye) < 1e15);

  const Camera made = make_camera(camera, 64, 48, 1);
  for (const glm::ivec2& pixel : {glm::ivec2(0, 0), {63, 47}, {20, 31}}) {
    const glm::dvec2 at = project(made, made.eye + 0.01 * made.direction(pixel.x, pixel.y));
    CHECK(at.x == doctest::Approx(pixel.x + 0.5));
    CHECK(at.y == doctest::Approx(pixel.y + 0.5));
  }
}

TEST_CASE("camera moves: keys and drags go where they point") {
  const Open open;  // the eye at (0, 1, 6) looks at the origin
  Session session(open_state(open.file, open_small), open_small);
  const CameraSettings start = session.state().camera;
  const double distance = glm::distance(start.eye, start.look_at);
  const auto after = [&](const auto& move) {
    session.press("z", kPanel);
    move();
    return session.state().camera;
  };
  const auto pressed = [&](const char* key) { return after([&] { session.press(key, kPanel); }); };
  CHECK(pressed("Right").eye.x > 0);
  CHECK(pressed("Left").eye.x < 0);
  CHECK(pressed("Up").eye.y > start.eye.y);
  CHECK(pressed("Down").eye.y < start.eye.y);
  CHECK(pressed("Shift+Right").look_at.x == doctest::Approx(0.05 * distance * start.view_height));
  CHECK(pressed("Shift+Left").look_at.x < 0);
  CHECK(pressed("Shift+Up").look_at.y > 0);
  CHECK(pressed("Shift+Down").look_at.y < 0);
  CHECK(glm::length(pressed(".").eye) < 0.95 * distance);
  CHECK(glm::length(pressed(",").eye) > 1.05 * distance);
  // What is dragged goes with the mouse, so the eye the other way.
  CHECK(after([&] { session.drag_orbit({10, 0}, kPanel); }).eye.x < 0);
  CHECK(after([&] { session.drag_orbit({0, 10}, kPanel); }).eye.y > start.eye.y);
  CHECK(after([&] { session.drag_slide({10, 0}, kPanel); }).look_at.x < 0);
  CHECK(after([&] { session.drag_slide({0, 10}, kPanel); }).look_at.y > 0);
}
