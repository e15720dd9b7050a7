// SPDX-License-Identifier: MIT
// The part of the session that lets a changed scene out again: as a command line, and as a scene file.
#include <fmt/format.h>

#include "common/picture/atomic_file.h"
#include "common/scene/toml.h"
#include "common/scene/toml_source.h"
#include "viewer/report/shell_word.h"
#include "viewer/window/session.h"

namespace sidelight {
namespace {

// The settings of the step that is shown: they may change objects, which no comparison of scenes finds.
Settings step_settings(const WindowState& state) {
  if (!state.revealed || state.step < 0) return {};
  return settings_of(state.opened.scene.steps[static_cast<std::size_t>(state.step)]);
}

// "shadows-2.toml" beside "shadows.toml", the first number that is free.
std::filesystem::path free_name(const std::filesystem::path& file) {
  for (int number = 2;; ++number) {
    std::filesystem::path candidate = file;
    candidate.replace_filename(fmt::format("{}-{}.toml", file.stem().string(), number));
    if (!std::filesystem::exists(candidate)) return candidate;
  }
}

}  // namespace

Settings settings_shown(const WindowState& state) {
  Settings settings = step_settings(state);
  Scene shown = *state.scene;
  shown.camera = state.camera;
  const Settings changes = settings_between(load_scene_with(state.file, settings), shown);
  settings.insert(settings.end(), changes.begin(), changes.end());
  return settings;
}

std::string explain_command(const WindowState& state) {
  const glm::ivec2 pixel = state.inspected.value_or(glm::ivec2(0));
  std::string line =
      fmt::format("sidelight explain {} --pixel {},{}", shell_file(state.file), pixel.x, pixel.y);
  if (state.n > 1) line += fmt::format(" --spp {}", state.n * state.n);
  for (const auto& [key, value] : settings_shown(state)) line += " --set " + shell_word(key + "=" + value);
  return line;
}

void Session::copy() {
  if (!state_.inspected) return tell({"inspect a pixel first: click it", false});
  try_to([&] {
    state_.clipboard = explain_command(state_);
    state_.notice = {
        "copied: " + state_.clipboard + (state_.faults.any() ? " (without the faults on purpose)" : ""),
        false};
  });
}

void Session::save() {
  try_to([&] {
    const std::filesystem::path to = free_name(state_.file);
    const std::string text =
        with_settings(scene_file::read_scene_text(state_.file), settings_shown(state_), to.string());
    parse_scene(text, to.string());  // what would not load is not written
    write_text_file(to.string(), text);
    state_.notice = {fmt::format("saved as {}{}", to.string(),
                                 state_.faults.any() ? " (faults on purpose are no part of a scene)" : ""),
                     false};
  });
}

}  // namespace sidelight
