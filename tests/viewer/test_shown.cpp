// SPDX-License-Identifier: MIT
// What the window says of its pictures.
#include <doctest/doctest.h>

#include "tests/viewer/session.h"
#include "viewer/window/shown.h"
#include "viewer/window/window_panels.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("window: captions say what the pictures hold, and what they wait for") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  Pictures pictures = render_pictures(picture_task(state));
  CHECK(show(state, pictures, pictures).panels.at(1).caption.name == "ray tracer: shadows, mirrors, glass");
  auto local = std::make_shared<Scene>(*state.scene);
  local->trace.reflection = local->trace.refraction = false;
  state.scene = state.drawn = local;
  pictures = render_pictures(picture_task(state));
  CHECK(show(state, pictures, pictures).panels.at(1).caption.name == "ray tracer: shadows");
  local->trace.shadows = false;
  CHECK(show(state, pictures, pictures).panels.at(1).caption.name == "ray tracer: local light only");

  const Pictures finished = pictures;
  pictures.finished = false;
  state.mode = Mode::causes;
  CHECK(show(state, pictures, {}).panels.at(0).caption.name == "ray tracer: refining, then the causes");
  CHECK(show(state, pictures, finished).panels.at(0).caption.name ==
        "what made the difference (of the view before)");
  CHECK(show(state, finished, finished).panels.at(0).caption.name == "what made the difference");
}

TEST_CASE("window: faults on purpose are said in the smallest window") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  state.lesson = true;
  state.inspected = glm::ivec2(3, 4);
  const auto title = [&] { return window_layout(state, {320, 240}, 1).panels.title.height(); };
  CHECK(title() == 0);
  state.faults.tessellate = 8;
  CHECK(title() > 0);
}
