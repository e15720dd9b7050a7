// SPDX-License-Identifier: MIT
// The part of the session that says what the keys do; help.cpp tells it to the user.
#include <array>

#include "viewer/window/session.h"

namespace sidelight {
namespace {

constexpr double kTurn = 0.06, kSlide = 0.05;  // a key press: radians, picture heights
constexpr double kSwipeStep = 0.05;

void toggle(bool& value) { value = !value; }

}  // namespace

std::span<const Session::Key> Session::keys() {
  static constexpr auto kKeys = std::to_array<Key>({
      {"1", [](Session& s, const Rect&) { s.set_mode(Mode::side_by_side); }},
      {"2", [](Session& s, const Rect&) { s.set_mode(Mode::swipe); }},
      {"3", [](Session& s, const Rect&) { s.set_mode(Mode::flip); }},
      {"4", [](Session& s, const Rect&) { s.set_mode(Mode::difference); }},
      {"5", [](Session& s, const Rect&) { s.set_mode(Mode::causes); }},
      {"6", [](Session& s, const Rect&) { s.set_mode(Mode::ledger); }},
      {"7", [](Session& s, const Rect&) { s.choose_layer(1); }},
      {"&", [](Session& s, const Rect&) { s.choose_layer(-1); }},
      {"8", [](Session& s, const Rect&) { s.choose_layer(-1); }},
      {"9", [](Session& s, const Rect&) { s.choose_alone(); }},
      {"Space", [](Session& s, const Rect&) { s.swap_or_advance(); }},
      {"<", [](Session& s, const Rect&) { s.set_swipe(s.state_.swipe - kSwipeStep); }},
      {">", [](Session& s, const Rect&) { s.set_swipe(s.state_.swipe + kSwipeStep); }},
      {"Left", [](Session& s, const Rect&) { s.turn(-kTurn, 0); }},
      {"Right", [](Session& s, const Rect&) { s.turn(kTurn, 0); }},
      {"Up", [](Session& s, const Rect&) { s.turn(0, kTurn); }},
      {"Down", [](Session& s, const Rect&) { s.turn(0, -kTurn); }},
      {"Shift+Left", [](Session& s, const Rect&) { s.shift(-kSlide, 0); }},
      {"Shift+Right", [](Session& s, const Rect&) { s.shift(kSlide, 0); }},
      {"Shift+Up", [](Session& s, const Rect&) { s.shift(0, kSlide); }},
      {"Shift+Down", [](Session& s, const Rect&) { s.shift(0, -kSlide); }},
      {".", [](Session& s, const Rect&) { s.dolly_by(1); }},
      {",", [](Session& s, const Rect&) { s.dolly_by(-1); }},
      {"+", [](Session& s, const Rect& panel) { s.zoom(1, panel); }},
      {"=", [](Session& s, const Rect& panel) { s.zoom(1, panel); }},
      {"-", [](Session& s, const Rect& panel) { s.zoom(-1, panel); }},
      {"0", [](Session& s, const Rect& panel) { s.show_whole(panel); }},
      {"Home", [](Session& s, const Rect& panel) { s.show_whole(panel); }},
      {"i", [](Session& s, const Rect&) { s.inspect_cursor(); }},
      {"n", [](Session& s, const Rect&) { s.next_step(); }},
      {"PageDown", [](Session& s, const Rect&) { s.next_step(); }},
      {"p", [](Session& s, const Rect&) { s.previous_step(); }},
      {"PageUp", [](Session& s, const Rect&) { s.previous_step(); }},
      {"]", [](Session& s, const Rect&) { s.open_neighbour(1); }},
      {"[", [](Session& s, const Rect&) { s.open_neighbour(-1); }},
      {"o", [](Session& s, const Rect&) { s.toggle_slow(); }},
      {"k", [](Session& s, const Rect&) { s.step_slow(1); }},
      {"j", [](Session& s, const Rect&) { s.step_slow(-1); }},
      {"d", [](Session& s, const Rect&) { s.change_depth(1); }},
      {"D", [](Session& s, const Rect&) { s.change_depth(-1); }},
      {"f", [](Session& s, const Rect&) { s.switch_ray(&TraceSettings::shadows); }},
      {"g", [](Session& s, const Rect&) { s.switch_ray(&TraceSettings::reflection); }},
      {"r", [](Session& s, const Rect&) { s.switch_ray(&TraceSettings::refraction); }},
      {"a", [](Session& s, const Rect&) { s.set_samples_per_edge(s.state_.n + 1); }},
      {"A", [](Session& s, const Rect&) { s.set_samples_per_edge(s.state_.n - 1); }},
      {"y", [](Session& s, const Rect&) { s.copy(); }},
      {"s", [](Session& s, const Rect&) { s.save(); }},
      {"z", [](Session& s, const Rect&) { s.reset(); }},
      {"c", [](Session& s, const Rect&) { toggle(s.state_.controls); }},
      {"Tab", [](Session& s, const Rect&) { s.next_panel(); }},
      {"l", [](Session& s, const Rect&) { toggle(s.state_.lesson); }},
      {"t", [](Session& s, const Rect&) { s.next_text_size(); }},
      {"h", [](Session& s, const Rect&) { toggle(s.state_.help); }},
      {"?", [](Session& s, const Rect&) { toggle(s.state_.help); }},
      {"F1", [](Session& s, const Rect&) { toggle(s.state_.help); }},
      {"Esc", [](Session& s, const Rect&) { s.escape(); }},
      {"q", [](Session& s, const Rect&) { s.closed_ = true; }},
      {"Q", [](Session& s, const Rect&) { s.closed_ = true; }},
  });
  return kKeys;
}

}  // namespace sidelight
