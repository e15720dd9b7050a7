// SPDX-License-Identifier: MIT
// The window without a window: keys and mouse come in, the state changes, the worker is told to draw. All of it runs
// without a display, on one thread but for the worker's, so tests drive it as a user would.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/settings.h"
#include "viewer/window/progressive.h"
#include "viewer/window/state.h"

namespace sidelight {

// Loads a scene file with a lesson's settings and the command line's flags. Throws as the program's verbs do.
using SceneOpener = std::function<OpenedScene(const std::string& file, const Settings& set)>;

// A state that shows the scene as it opens. Throws what `open` throws.
WindowState open_state(const std::string& file, const SceneOpener& open);

// A lesson's step as settings: its values, then its eye.
Settings settings_of(const Step& step);

// What to set in the scene's file to get what is shown, faults and samples apart. Throws InputError if the file is gone.
Settings settings_shown(const WindowState& state);

// The command that tells of the inspected pixel what the inspector tells.
std::string explain_command(const WindowState& state);

// Puts step `number` (from 0) of the scene's lesson on the screen. Throws what `open` throws.
void reveal_step(WindowState& state, int number, const SceneOpener& open);

// By what a saved file is known.
struct FileStamp {
  std::string file;
  std::filesystem::file_time_type time{};
  std::uintmax_t size = 0;
  bool operator==(const FileStamp&) const = default;
};

class Session {
 public:
  // `state` as open_state gives it, `notify` as of Progressive.
  Session(WindowState state, SceneOpener open, std::function<void()> notify = {});

  const WindowState& state() const { return state_; }
  const Progressive& worker() const { return worker_; }
  bool closed() const { return closed_; }

  // What the keys do: a key is named by the character it types, or by its name: "Space", "PageDown", "Shift+Left".
  struct Key {
    std::string_view name;
    void (*press)(Session& session, const Rect& panel);
  };
  static std::span<const Key> keys();
  // `panel` is where the (left) picture lies. False if the key does nothing.
  bool press(std::string_view key, const Rect& panel = {});

  // The mouse, in device pixels: what a drag by `by` does to the camera or the pictures.
  void drag_orbit(glm::dvec2 by, const Rect& panel);
  void drag_slide(glm::dvec2 by, const Rect& panel);
  void drag_pictures(glm::dvec2 by, const Rect& panel);
  void wheel(int steps, glm::dvec2 cursor, const Rect& panel);
  void dolly_by(int steps);
  void point_at(std::optional<glm::dvec2> picture_point) { state_.cursor = picture_point; }
  void inspect(glm::ivec2 pixel);
  void fit_panel(const Rect& panel);
  void set_swipe(double part);
  void set_mode(Mode mode);

  // Changes of the scene by the controls.
  void edit(const std::function<void(Scene&)>& change);
  void set_faults(const Faults& faults);
  void set_samples_per_edge(int n);
  void set_slow(int objects, int rows);
  void choose_material(int number) { state_.material = number; }

  // Looks whether the scene's file or one of its meshes' was saved since; loads it again if so. What keys and mouse
  // changed stays, unless the file changed it, too; lights and materials are the file's. A mistake in it becomes the
  // notice, and what was shown stays. Returns whether something changed.
  bool watch();

  // What the user asked to copy since; for the system's clipboard.
  std::string take_clipboard() { return std::exchange(state_.clipboard, {}); }

 private:
  void tell(Notice notice) { state_.notice = std::move(notice); }
  void redraw();
  void load(const std::string& file);
  void go_to_step(int step, bool revealed);
  void next_step();
  void previous_step();
  void open_neighbour(int by);
  void reset();
  void copy();
  void save();
  void escape();
  void next_panel();
  void next_text_size();
  void choose_layer(int by);
  void choose_alone();
  void swap_or_advance();
  void inspect_cursor();
  void toggle_slow();
  void step_slow(int by);
  void switch_ray(bool TraceSettings::*flag);
  void change_depth(int by);
  void show_whole(const Rect& panel);
  void zoom(int steps, const Rect& panel);
  void turn(double around, double over);
  void shift(double right, double up);
  void move_camera(const CameraSettings& camera);
  bool try_to(const std::function<void()>& change);
  void note_files();

  SceneOpener open_;
  WindowState state_;
  bool closed_ = false;
  std::vector<FileStamp> stamps_;  // of the files that are watched
  Progressive worker_;
};

}  // namespace sidelight
