// SPDX-License-Identifier: MIT
#include "viewer/window/session.h"

#include <algorithm>
#include <cmath>

#include "viewer/window/camera_moves.h"

namespace sidelight {
namespace {

constexpr double kDolly = 0.9;     // a step: a factor
constexpr double kDragTurn = 4.0;  // radians for a drag over the panel's height

double height(const Rect& panel) { return std::max(1, panel.height()); }

}  // namespace

bool Session::press(std::string_view key, const Rect& panel) {
  const auto known = std::ranges::find(keys(), key, &Key::name);
  if (known == keys().end()) return false;
  known->press(*this, panel);
  return true;
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

void Session::choose_alone() { set_mode(state_.mode == Mode::raster ? Mode::raytrace : Mode::raster); }

void Session::swap_or_advance() {
  if (state_.mode == Mode::ledger)
    state_.ledger_term = (state_.ledger_term + 1) % 4;
  else
    state_.view.flipped = !state_.view.flipped;
}

void Session::set_swipe(double part) { state_.swipe = std::clamp(part, 0.0, 1.0); }

void Session::show_whole(const Rect& panel) { state_.view = fit(state_.view, picture_size(state_), panel); }

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

void Session::inspect_cursor() {
  const Rect part = shown_part(state_);
  if (state_.cursor) inspect(glm::ivec2(glm::floor(*state_.cursor)) + glm::ivec2(part.x0, part.y0));
}

void Session::next_text_size() { state_.text_scale = state_.text_scale >= 2 ? 1 : state_.text_scale + 0.25; }

// ---- The camera ----

void Session::move_camera(const CameraSettings& camera) {
  state_.camera = camera;
  redraw();
}

void Session::turn(double around, double over) { move_camera(orbit(state_.camera, around, over)); }

void Session::shift(double right, double up) { move_camera(slide(state_.camera, {right, up})); }

void Session::drag_orbit(glm::dvec2 by, const Rect& panel) {
  const glm::dvec2 angles = kDragTurn * by / height(panel);
  turn(-angles.x, angles.y);
}

void Session::drag_slide(glm::dvec2 by, const Rect& panel) {
  shift(-by.x / height(panel), by.y / height(panel));
}

void Session::dolly_by(int steps) { move_camera(dolly(state_.camera, std::pow(kDolly, steps))); }

// ---- The scene ----

void Session::redraw() { worker_.submit(picture_task(state_)); }

void Session::switch_ray(bool TraceSettings::*flag) {
  edit([&](Scene& scene) { scene.trace.*flag = !(scene.trace.*flag); });
}

void Session::change_depth(int by) {
  edit([&](Scene& scene) { scene.trace.depth = std::clamp(scene.trace.depth + by, 1, 1000); });
}

void Session::set_samples_per_edge(int n) {
  const int wanted = std::clamp(n, 1, std::max(state_.opened.most_n, state_.n));
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

void Session::toggle_slow() {
  state_.slow = !state_.slow;
  redraw();
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
    toggle_slow();
  else
    closed_ = true;
}

}  // namespace sidelight
