// SPDX-License-Identifier: MIT
#include "viewer/window/state.h"

#include <fmt/format.h>

namespace sidelight {

PictureTask picture_task(const WindowState& state) {
  PictureTask task;
  task.scene = state.drawn;
  task.camera = state.camera;
  task.n = state.n;
  task.options = state.opened.options;
  task.options.faults = state.faults;
  task.layer = layer_of(state.mode);
  if (state.slow) task.objects = static_cast<std::size_t>(state.objects);
  return task;
}

Rect shown_part(const WindowState& state) {
  const Rect& crop = state.opened.options.crop;
  return crop.width() > 0 ? crop : Rect{0, 0, state.scene->width, state.scene->height};
}

std::string window_title(const WindowState& state) {
  const std::string& title = state.scene->title.empty() ? state.file : state.scene->title;
  return state.faults.any() ? fmt::format("FAULTS ON PURPOSE ({}): {}", state.faults.text(), title) : title;
}

bool is_open(const WindowState& state, KeyTarget target) {
  if (target == KeyTarget::controls) return state.controls;
  if (target == KeyTarget::lesson) return state.lesson;
  return target == KeyTarget::pictures || state.inspected;
}

KeyTarget key_target(const WindowState& state) {
  return is_open(state, state.keys) ? state.keys : KeyTarget::pictures;
}

}  // namespace sidelight
