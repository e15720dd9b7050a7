// SPDX-License-Identifier: MIT
#include "viewer/window/session.h"

#include <algorithm>
#include <cmath>

#include "viewer/window/camera_moves.h"

namespace sidelight {
namespace {

constexpr double kTurn = 0.06, kSlide = 0.05,
                 kDolly = 0.9;     // a key press: radians, picture heights, a factor
constexpr double kDragTurn = 4.0;  // radians for a drag over the panel's height
constexpr double kSwipeStep = 0.05;
constexpr int kMostSamples = 8;  // per pixel edge, by keys and controls; a command line may begin with more

glm::dvec2 middle(const Rect& panel) { return {(panel.x0 + panel.x1) / 2.0, (panel.y0 + panel.y1) / 2.0}; }
double height(const Rect& panel) { return std::max(1, panel.height()); }

}  // namespace

bool Session::press(std::string_view key, const Rect& panel) {
  const std::optional<Action> action = action_of(key);
  if (action) act(*action, panel);
  return action.has_value();
}

void Session::act(Action action, const Rect& panel) {
  const auto toggle = [](bool& value) { value = !value; };
  const auto turn = [&](double around, double over) { move_camera(orbit(state_.camera, around, over)); };
  const auto shift = [&](double x, double y) { move_camera(slide(state_.camera, {x, y})); };
  const auto switch_ray = [&](bool TraceSettings::*flag) {
    edit([&](Scene& scene) { scene.trace.*flag = !(scene.trace.*flag); });
  };
  const auto change_depth = [&](int by) {
    edit([&](Scene& scene) { scene.trace.depth = std::clamp(scene.trace.depth + by, 1, 1000); });
  };
  switch (action) {
    case Action::side_by_side:
      return set_mode(Mode::side_by_side);
    case Action::swipe:
      return set_mode(Mode::swipe);
    case Action::flip:
      return set_mode(Mode::flip);
    case Action::difference:
      return set_mode(Mode::difference);
    case Action::causes:
      return set_mode(Mode::causes);
    case Action::ledger:
      return set_mode(Mode::ledger);
    case Action::next_layer:
      return choose_layer(1);
    case Action::previous_layer:
      return choose_layer(-1);
    case Action::next_alone:
      return set_mode(state_.mode == Mode::raster ? Mode::raytrace : Mode::raster);
    case Action::swap:
      return swap_or_advance();
    case Action::swipe_left:
      return set_swipe(state_.swipe - kSwipeStep);
    case Action::swipe_right:
      return set_swipe(state_.swipe + kSwipeStep);
    case Action::orbit_left:
      return turn(-kTurn, 0);
    case Action::orbit_right:
      return turn(kTurn, 0);
    case Action::orbit_up:
      return turn(0, kTurn);
    case Action::orbit_down:
      return turn(0, -kTurn);
    case Action::slide_left:
      return shift(-kSlide, 0);
    case Action::slide_right:
      return shift(kSlide, 0);
    case Action::slide_up:
      return shift(0, kSlide);
    case Action::slide_down:
      return shift(0, -kSlide);
    case Action::nearer:
      return dolly_by(1);
    case Action::farther:
      return dolly_by(-1);
    case Action::zoom_in:
      return zoom(1, panel);
    case Action::zoom_out:
      return zoom(-1, panel);
    case Action::whole_picture:
      state_.view = fit(state_.view, picture_size(state_), panel);
      return;
    case Action::inspect:
      if (state_.cursor)
        inspect(glm::ivec2(glm::floor(*state_.cursor)) +
                glm::ivec2(shown_part(state_).x0, shown_part(state_).y0));
      return;
    case Action::next_step:
      return next_step();
    case Action::previous_step:
      return previous_step();
    case Action::next_scene:
      return open_neighbour(1);
    case Action::previous_scene:
      return open_neighbour(-1);
    case Action::slow_motion:
      toggle(state_.slow);
      return redraw();
    case Action::more:
      return step_slow(1);
    case Action::fewer:
      return step_slow(-1);
    case Action::deeper:
      return change_depth(1);
    case Action::shallower:
      return change_depth(-1);
    case Action::shadows:
      return switch_ray(&TraceSettings::shadows);
    case Action::reflection:
      return switch_ray(&TraceSettings::reflection);
    case Action::refraction:
      return switch_ray(&TraceSettings::refraction);
    case Action::more_samples:
      return set_samples_per_edge(state_.n + 1);
    case Action::fewer_samples:
      return set_samples_per_edge(state_.n - 1);
    case Action::copy_command:
      return copy();
    case Action::save:
      return save();
    case Action::reset:
      return reset();
    case Action::controls:
      return toggle(state_.controls);
    case Action::next_panel:
      return next_panel();
    case Action::lesson:
      return toggle(state_.lesson);
    case Action::text_size:
      state_.text_scale = state_.text_scale >= 2 ? 1 : state_.text_scale + 0.25;
      return;
    case Action::help:
      return toggle(state_.help);
    case Action::escape:
      return escape();
    case Action::close:
      closed_ = true;
      return;
  }
}

// ---- Looking ----

void Session::set_mode(Mode mode) {
  if (mode == Mode::ledger && state_.mode != mode) state_.ledger_term = 0;
  const bool other_layer = layer_of(mode) != layer_of(state_.mode);
  state_.mode = mode;
  // Finished pictures have every layer but the costly one.
  if (other_layer && (mode == Mode::cost || !worker_.idle())) redraw();
}

// Tab goes round the open panels, and past the last one back to the pictures.
void Session::next_panel() {
  constexpr int kTargets = 5;
  const int now = static_cast<int>(key_target(state_));
  for (int i = 1; i <= kTargets; ++i) {
    state_.keys = static_cast<KeyTarget>((now + i) % kTargets);
    if (is_open(state_, state_.keys)) return;
  }
}

void Session::choose_layer(int by) {
  const std::optional<Layer> now = layer_of(state_.mode);
  const int first = by > 0 ? 0 : kLayers - 1;
  const int layer = now ? (static_cast<int>(*now) + by + kLayers) % kLayers : first;
  set_mode(mode_of(static_cast<Layer>(layer)));
}

void Session::swap_or_advance() {
  if (state_.mode == Mode::ledger)
    state_.ledger_term = (state_.ledger_term + 1) % 4;
  else
    state_.view.flipped = !state_.view.flipped;
}

void Session::set_swipe(double part) { state_.swipe = std::clamp(part, 0.0, 1.0); }

void Session::fit_panel(const Rect& panel) { state_.view = clamp(state_.view, picture_size(state_), panel); }

void Session::wheel(int steps, glm::dvec2 cursor, const Rect& panel) {
  state_.view = zoom_about(state_.view, picture_size(state_), panel, cursor, steps);
}

void Session::zoom(int steps, const Rect& panel) {
  const bool over = state_.cursor.has_value();
  wheel(steps, over ? picture_origin(state_.view, panel) + *state_.cursor * state_.view.zoom : middle(panel),
        panel);
}

void Session::drag_pictures(glm::dvec2 by, const Rect& panel) {
  state_.view = pan(state_.view, picture_size(state_), panel, by);
}

void Session::inspect(glm::ivec2 pixel) {
  if (pixel.x >= 0 && pixel.y >= 0 && pixel.x < state_.scene->width && pixel.y < state_.scene->height)
    state_.inspected = pixel;
}

// ---- The camera ----

void Session::move_camera(const CameraSettings& camera) {
  state_.camera = camera;
  redraw();
}

void Session::drag_orbit(glm::dvec2 by, const Rect& panel) {
  const glm::dvec2 turn = kDragTurn * by / height(panel);
  move_camera(orbit(state_.camera, -turn.x, turn.y));
}

void Session::drag_slide(glm::dvec2 by, const Rect& panel) {
  move_camera(slide(state_.camera, glm::dvec2(-by.x, by.y) / height(panel)));
}

void Session::dolly_by(int steps) { move_camera(dolly(state_.camera, std::pow(kDolly, steps))); }

// ---- The scene ----

void Session::redraw() { worker_.submit(picture_task(state_)); }

void Session::set_samples_per_edge(int n) {
  const int wanted = std::clamp(n, 1, std::max(kMostSamples, state_.n));
  if (wanted == state_.n) return;
  state_.n = wanted;
  redraw();
}

void Session::set_slow(int objects, int rows) {
  const int before = state_.objects;
  state_.objects = std::clamp(objects, 0, static_cast<int>(state_.drawn->objects.size()));
  state_.rows = std::clamp(rows, 0, state_.scene->height);
  if (state_.slow && state_.objects != before) redraw();
}

// One object more or less, and as large a part of the rows.
void Session::step_slow(int by) {
  state_.slow = true;
  const int objects = std::max(1, static_cast<int>(state_.drawn->objects.size()));
  const int wanted = std::clamp(state_.objects + by, 0, objects);
  set_slow(wanted,
           static_cast<int>(std::lround(static_cast<double>(wanted) / objects * state_.scene->height)));
  redraw();
}

void Session::escape() {
  if (state_.help)
    state_.help = false;
  else if (key_target(state_) != KeyTarget::pictures)
    state_.keys = KeyTarget::pictures;
  else if (!state_.notice.text.empty())
    state_.notice = {};
  else if (state_.inspected)
    state_.inspected.reset();
  else if (state_.controls)
    state_.controls = false;
  else if (state_.lesson)
    state_.lesson = false;
  else if (state_.slow)
    act(Action::slow_motion, {});
  else
    closed_ = true;
}

}  // namespace sidelight
