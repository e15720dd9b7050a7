// SPDX-License-Identifier: MIT
// sidelight view: the teaching window, or one picture of it drawn off screen.
#include <fmt/format.h>

#include <sstream>

#include "common/picture/atomic_file.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/decimal.h"
#include "viewer/commands/interrupt.h"
#include "viewer/commands/renderers.h"
#include "viewer/window/offscreen.h"
#include "viewer/window/window.h"

namespace sidelight {
namespace {

struct ViewFlags {
  JobFlags job;
  std::string mode, inspect, press, screenshot, frame_log, window = "1352x648";
  int step = 0;
};

// A scene file as the command line wants it, without the faults, which the window puts on itself.
OpenedScene open_scene(const JobFlags& flags, const std::string& file, const Settings& set) {
  JobFlags plain = flags;
  plain.scene = file;
  plain.faults = {};
  Job job = load_job(plain, set);
  OpenedScene opened;
  opened.faults = parse_faults(flags.faults, job.scene.camera);
  opened.n = job.camera.n;
  opened.options = job.options;
  opened.times = !flags.no_times;
  // A finished picture has all layers and keeps its samples, and the one before it is shown until then.
  RenderOptions finished = job.options;
  finished.layers = kAllLayers;
  finished.keep_samples = true;
  check_memory(job.scene, opened.n, finished, 2);
  while (opened.most_n > opened.n && !fits_memory(job.scene, opened.most_n, finished, 2)) --opened.most_n;
  opened.scene = std::move(job.scene);
  opened.files = std::move(job.files);
  return opened;
}

WindowState first_state(const ViewFlags& flags, const SceneOpener& open) {
  WindowState state = open_state(flags.job.scene, open);
  const int steps = static_cast<int>(state.opened.scene.steps.size());
  if (flags.step > steps)
    throw UsageError(fmt::format("--step: the scene has {} steps; got {}", steps, flags.step));
  if (flags.step > 0) reveal_step(state, flags.step - 1, open);
  if (!flags.mode.empty()) state.mode = *find_mode(flags.mode);
  if (!flags.inspect.empty())
    state.inspected = parse_pixel(flags.inspect, state.scene->width, state.scene->height, "--inspect");
  if (flags.press.empty()) return state;
  // The session draws as it goes; only what it ends with is wanted.
  Session session(std::move(state), open);
  std::istringstream keys(flags.press);
  for (std::string key; keys >> key;)
    if (!session.press(key, {0, 0, 1, 1})) throw UsageError("--press: no key is called '" + key + "'");
  return session.state();
}

void check_flags(const ViewFlags& flags) {
  check_apart("SCENE", flags.job.scene, "--frame-log", flags.frame_log);
  if (flags.screenshot.empty()) return;
  if (!flags.screenshot.ends_with(".png"))
    throw UsageError("--screenshot wants a file that ends in .png; got '" + flags.screenshot + "'");
  if (!flags.frame_log.empty())
    throw UsageError("--frame-log is for the window; --screenshot draws one frame only");
}

int run_view(const ViewFlags& flags) {
  check_flags(flags);
  if (flags.screenshot.empty()) require_display();  // before any work
  const glm::ivec2 window = parse_size(flags.window, "--size", kLongestOffscreen);
  JobFlags opening = flags.job;
  const SceneOpener open = [&opening](const std::string& file, const Settings& set) {
    OpenedScene opened = open_scene(opening, file, set);
    opening.quiet = true;  // warnings are told once
    return opened;
  };
  WindowState state = first_state(flags, open);
  if (state.faults.any() && !flags.job.quiet)
    fmt::print(stderr, "faults on purpose: {}\n", state.faults.text());
  if (flags.screenshot.empty()) {
    restore_default_signals();
    FrameLog log;
    const int code = run_window(std::move(state), open, flags.frame_log.empty() ? nullptr : &log);
    if (!flags.frame_log.empty()) {
      write_text_file(flags.frame_log, log.csv());
      fmt::print(stderr, "{}", log.summary());
    }
    return code;
  }
  opening.spp = state.n * state.n;
  const Pictures pictures = render_pictures(picture_task(state));
  write_png(flags.screenshot, screenshot(state, pictures, window.x, window.y),
            picture_metadata(opening, *state.scene, state.faults, "raster, raytrace"));
  if (!flags.job.quiet)
    for (const std::string& line : left_out(state, window.x, window.y)) fmt::print(stderr, "{}\n", line);
  // The window shows such a picture, too; but who asked for one without looking must learn of it.
  check_finite(*pictures.rastered, "z-buffer");
  check_finite(*pictures.traced, "ray tracer");
  return 0;
}

}  // namespace

void add_view_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<ViewFlags>();
  CLI::App* verb =
      app.add_subcommand("view", "the window: two pictures side by side, linked; h shows its keys");
  add_job_flags(*verb, flags->job);
  add_fault_flags(*verb, flags->job.faults);
  const std::vector<std::string> modes(kStepModes.begin(), kStepModes.end());
  verb->add_option("--mode", flags->mode,
                   "first: side-by-side, swipe, flip, difference, causes, ledger, renderer, layer")
      ->type_name("NAME")
      ->check(CLI::IsMember(modes).description(""));
  verb->add_option("--step", flags->step, "the lesson's step N is shown first")
      ->type_name("N")
      ->transform(decimal)
      ->check(CLI::Range(1, 100).description(""));
  verb->add_option("--inspect", flags->inspect, "the pixel x,y is inspected first");
  verb->add_option("--press", flags->press, "these keys are pressed first, as in \"t t c\"")
      ->type_name("KEYS");
  verb->add_flag("--no-times", flags->job.no_times, "leave times out");
  verb->add_option("--screenshot", flags->screenshot, "draw the window off screen into FILE.png instead");
  verb->add_option("--frame-log", flags->frame_log, "write every frame's times to FILE.csv at the end");
  verb->add_option("--size", flags->window, "size of that window")->capture_default_str();
  verb->footer(
      "Examples:\n"
      "  sidelight view scenes/13-everything.toml\n"
      "  sidelight view scenes/07-mirrors.toml --mode causes --inspect 20,20 --screenshot mirrors.png");
  verb->callback([flags, &exit_code] { exit_code = run_view(*flags); });
}

}  // namespace sidelight
