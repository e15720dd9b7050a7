// SPDX-License-Identifier: MIT
#include "viewer/window/frames.h"

#include "common/clock.h"
#include "viewer/window/canvas.h"

namespace sidelight {

bool FrameContents::update(const Session& session) {
  latest_ = session.worker().latest();
  finished_ = session.worker().last_finished();
  const bool pictures = show_pictures(session.state());
  return inspect(session.state()) || pictures;
}

bool FrameContents::show_pictures(const WindowState& state) {
  const ShownKey key = shown_key(state, latest_, finished_);
  if (key_ == key) return false;
  key_ = key;
  shown_ = show(state, latest_, finished_);
  return true;
}

bool FrameContents::inspect(const WindowState& state) {
  if (inspection_ && state.inspected == inspection_->pixel && inspection_->asked_ms == latest_.task.asked_ms)
    return false;
  std::optional<Inspection> told = inspect_pixel(state, latest_);
  if (state.inspected && !told) return false;  // of the view that is being drawn: soon
  const bool changed = told || inspection_;
  inspection_ = std::move(told);
  return changed;
}

bool Frames::take_pictures() {
  const double start = wall_ms();
  const bool changed = contents_.update(session_);
  if (changed) uploaded_ = Uploaded::nothing;
  next_.prepare += wall_ms() - start;
  return changed;
}

// Smaller copies of each picture take as long as all the rest: they are made once a picture is shown smaller than it is.
void Frames::upload() {
  const Uploaded wanted =
      session_.state().view.zoom < 1 ? Uploaded::with_smaller_copies : Uploaded::as_they_are;
  if (uploaded_ >= wanted) return;
  const double start = wall_ms();
  canvas_.clear_pictures();
  textures_.clear();
  for (const ShownPanel& each : contents_.shown().panels)
    textures_.push_back(canvas_.add_picture(each.image, wanted == Uploaded::with_smaller_copies));
  uploaded_ = wanted;
  next_.upload += wall_ms() - start;
}

void Frames::press(const std::string& key, const Rect& panel) {
  const bool to_widgets = key_target(session_.state()) != KeyTarget::pictures && canvas_.press_key(key);
  if (!to_widgets) session_.press(key, panel);
}

void Frames::set_pointer(glm::dvec2 position, bool left_down, double wheel) {
  canvas_.set_pointer(position, left_down, wheel);
}

bool Frames::draw(glm::ivec2 size, double content_scale) {
  const WindowState& state = session_.state();
  canvas_.set_scale(content_scale * state.text_scale);
  layout_ = window_layout(state, size, canvas_.scale());
  session_.fit_panel(layout_.panels.left);
  upload();
  const double start = wall_ms();
  std::vector<Command> commands;
  canvas_.draw(size.x, size.y, [&] {
    commands = draw_window(canvas_,
                           {state, contents_.latest(), contents_.finished(), contents_.shown(), textures_,
                            contents_.inspection()},
                           layout_);
  });
  for (const Command& command : commands) command(session_);
  last_ = next_;
  last_.at = start;
  last_.draw = wall_ms() - start;
  next_ = {};
  return !commands.empty() || canvas_.has_keys_waiting();
}

}  // namespace sidelight
