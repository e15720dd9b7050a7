// SPDX-License-Identifier: MIT
// What the keys do: the one table, from which the window acts and the help overlay is drawn. A key is named by the
// character it types, or by its name: "Space", "PageDown", "Shift+Left".
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace sidelight {

enum class Action {
  side_by_side,
  swipe,
  flip,
  difference,
  causes,
  ledger,
  next_layer,
  previous_layer,
  next_alone,
  swap,
  swipe_left,
  swipe_right,
  orbit_left,
  orbit_right,
  orbit_up,
  orbit_down,
  slide_left,
  slide_right,
  slide_up,
  slide_down,
  nearer,
  farther,
  zoom_in,
  zoom_out,
  whole_picture,
  inspect,
  next_step,
  previous_step,
  next_scene,
  previous_scene,
  slow_motion,
  more,
  fewer,
  deeper,
  shallower,
  shadows,
  reflection,
  refraction,
  more_samples,
  fewer_samples,
  copy_command,
  save,
  reset,
  controls,
  next_panel,
  lesson,
  text_size,
  help,
  escape,
  close
};

struct KeyBinding {
  std::string_view key;
  Action action;
};
std::span<const KeyBinding> key_bindings();

// Empty for a key that does nothing.
std::optional<Action> action_of(std::string_view key);

// The table as people read it: keys of a kind together, under a title.
struct KeyHelp {
  std::string_view keys, text;
};
struct KeyGroup {
  std::string_view title;
  std::span<const KeyHelp> lines;
};
std::span<const KeyGroup> key_help();

}  // namespace sidelight
