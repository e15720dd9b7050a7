// SPDX-License-Identifier: MIT
// The part of the session that opens scenes: lessons, neighbours, changes, the file that is watched.
#include <fmt/format.h>

#include <algorithm>

#include "common/scene/tessellate.h"
#include "viewer/window/session.h"

namespace sidelight {
namespace {

void use_changed(WindowState& state, std::shared_ptr<const Scene> scene) {
  state.drawn = state.faults.tessellate
                    ? std::make_shared<const Scene>(tessellated(*scene, *state.faults.tessellate))
                    : scene;
  state.scene = std::move(scene);
}

void use_untouched(WindowState& state, const Scene& scene) {
  state.untouched = std::make_shared<const Scene>(scene);
  use_changed(state, state.untouched);
  state.camera = scene.camera;
}

// What was opened, untouched.
void start_over(WindowState& state) {
  state.faults = state.opened.faults;
  state.n = state.opened.n;
  use_untouched(state, state.opened.scene);
  state.objects = static_cast<int>(state.drawn->objects.size());
  state.rows = state.scene->height;
}

std::vector<FileStamp> stamps_of(const std::vector<std::string>& files) {
  std::vector<FileStamp> out;
  for (const std::string& file : files) {
    std::error_code gone;
    const auto time = std::filesystem::last_write_time(file, gone);
    const std::uintmax_t size = gone ? 0 : std::filesystem::file_size(file, gone);
    out.push_back({file, gone ? FileStamp().time : time, size});
  }
  return out;
}

// What the user changed by keys and mouse stays, unless the file has changed it since; all else is the file's.
template <typename T>
void keep_change(T& now, const T& shown, const T& then) {
  if (shown != then && now == then) now = shown;
}

// After the file was read again. Of the camera the user moves these two; of the scene, keys change the tracer's switches.
void keep_changes(WindowState& state, const WindowState& before) {
  const CameraSettings& then = before.untouched->camera;
  if (state.camera.eye == then.eye && state.camera.look_at == then.look_at) {
    state.camera.eye = before.camera.eye;
    state.camera.look_at = before.camera.look_at;
  }
  keep_change(state.n, before.n, before.opened.n);
  keep_change(state.faults, before.faults, before.opened.faults);
  auto scene = std::make_shared<Scene>(*state.untouched);
  const auto keep = [&](auto TraceSettings::*field) {
    keep_change(scene->trace.*field, before.scene->trace.*field, before.untouched->trace.*field);
  };
  keep(&TraceSettings::depth);
  keep(&TraceSettings::shadows);
  keep(&TraceSettings::reflection);
  keep(&TraceSettings::refraction);
  use_changed(state, std::move(scene));
}

// A picture may have become smaller.
void keep_inspected_inside(WindowState& state) {
  const auto& pixel = state.inspected;
  if (pixel && (pixel->x >= state.scene->width || pixel->y >= state.scene->height)) state.inspected.reset();
}

}  // namespace

Settings settings_of(const Step& step) {
  Settings settings = step.set;
  if (step.eye)
    settings.emplace_back("camera.eye", fmt::format("[{}, {}, {}]", step.eye->x, step.eye->y, step.eye->z));
  return settings;
}

WindowState open_state(const std::string& file, const SceneOpener& open) {
  WindowState state;
  state.file = file;
  state.opened = open(file, {});
  start_over(state);
  return state;
}

void reveal_step(WindowState& state, int number, const SceneOpener& open) {
  const Step step = state.opened.scene.steps.at(static_cast<std::size_t>(number));
  const OpenedScene opened = open(state.file, settings_of(step));
  use_untouched(state, opened.scene);
  state.step = number;
  state.revealed = true;
  state.lesson = true;
  if (const auto mode = find_mode(step.mode)) state.mode = *mode;
  state.ledger_term = 0;
  keep_inspected_inside(state);
}

Session::Session(WindowState state, SceneOpener open, std::function<void()> notify)
    : open_(std::move(open)), state_(std::move(state)), worker_(std::move(notify)) {
  note_files();
  redraw();
}

// A user's mistake becomes the notice, and everything stays as it was.
bool Session::try_to(const std::function<void()>& change) {
  const WindowState before = state_;
  try {
    change();
    return true;
  } catch (const std::runtime_error& mistake) {
    state_ = before;
    state_.notice = {mistake.what(), true};
    return false;
  }
}

void Session::edit(const std::function<void(Scene&)>& change) {
  const bool done = try_to([&] {
    auto scene = std::make_shared<Scene>(*state_.scene);
    change(*scene);
    use_changed(state_, std::move(scene));
  });
  if (done) redraw();
}

void Session::set_faults(const Faults& faults) {
  if (faults == state_.faults) return;
  const bool done = try_to([&] {
    state_.faults = faults;
    use_changed(state_, state_.scene);
  });
  if (done) redraw();
}

void Session::reset() {
  start_over(state_);
  state_.step = -1;
  state_.revealed = false;
  keep_inspected_inside(state_);
  state_.notice = {};
  redraw();
}

// ---- Lessons ----

// Predict, then reveal: the first press asks the step's question, the second shows what it is about.
void Session::next_step() {
  const int steps = static_cast<int>(state_.opened.scene.steps.size());
  if (steps == 0) return tell({"this scene has no steps", false});
  if (state_.step >= 0 && !state_.revealed) return go_to_step(state_.step, true);
  if (state_.step + 1 < steps) go_to_step(state_.step + 1, false);
}

void Session::previous_step() {
  if (state_.step >= 0) go_to_step(state_.step - 1, true);
}

void Session::go_to_step(int step, bool revealed) {
  state_.lesson = true;
  if (step < 0) {
    reset();
  } else if (!revealed) {
    state_.step = step;
    state_.revealed = false;
  } else if (try_to([&] { reveal_step(state_, step, open_); })) {
    redraw();
  }
}

// ---- Files ----

void Session::note_files() { stamps_ = stamps_of(state_.opened.files); }

bool Session::watch() {
  const std::vector<std::string> watched = state_.opened.files;
  const std::vector<FileStamp> now = stamps_of(watched);
  const auto gone = [](const FileStamp& stamp) { return stamp.time == FileStamp().time; };
  if (now == stamps_ || gone(now.front())) return false;
  // Gone: an editor is about to replace it, unless the scene was saved anew and may do without.
  if (now.front() == stamps_.front() && std::any_of(now.begin(), now.end(), gone)) return false;
  stamps_ = now;
  // The view, the mode and the step stay, and what keys and mouse changed.
  const bool loaded = try_to([&] {
    const WindowState before = state_;
    state_.opened = open_(state_.file, {});
    start_over(state_);
    const int steps = static_cast<int>(state_.opened.scene.steps.size());
    if (state_.revealed && state_.step < steps) reveal_step(state_, state_.step, open_);
    if (state_.step >= steps) state_.step = -1, state_.revealed = false;
    state_.mode = before.mode;
    state_.ledger_term = before.ledger_term;
    keep_changes(state_, before);
    keep_inspected_inside(state_);
    state_.notice = {};
  });
  if (!loaded) return true;
  if (state_.opened.files != watched) note_files();  // else a save since `now` would be missed
  redraw();
  return true;
}

void Session::load(const std::string& file) {
  const bool done = try_to([&] {
    WindowState fresh = open_state(file, open_);
    fresh.mode = state_.mode;
    fresh.view.flipped = state_.view.flipped;
    fresh.swipe = state_.swipe;
    fresh.lesson = state_.lesson;
    fresh.controls = state_.controls;
    fresh.text_scale = state_.text_scale;
    state_ = std::move(fresh);
  });
  if (!done) return;
  note_files();
  redraw();
}

// The scene files of the same folder, in the order of their names.
void Session::open_neighbour(int by) {
  const std::filesystem::path here(state_.file);
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const auto& entry :
       std::filesystem::directory_iterator(here.has_parent_path() ? here.parent_path() : ".", unreadable))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  const auto at = std::find(names.begin(), names.end(), here.filename().string());
  const auto index = at - names.begin() + by;
  if (at == names.end() || index < 0 || index >= static_cast<std::ptrdiff_t>(names.size()))
    return tell(
        {by > 0 ? "this is the last scene of its folder" : "this is the first scene of its folder", false});
  load((here.parent_path() / names[static_cast<std::size_t>(index)]).string());
}

}  // namespace sidelight
