// SPDX-License-Identifier: MIT
// sidelight view: the window with both pictures.
#include <fmt/format.h>

#include "viewer/commands/commands.h"
#include "viewer/commands/interrupt.h"
#include "viewer/commands/progress.h"
#include "viewer/commands/renderers.h"
#include "viewer/window/offscreen.h"
#include "viewer/window/window.h"

namespace sidelight {
namespace {

struct ViewFlags {
  JobFlags job;
  std::string screenshot, window = "1352x648";
};

TimedFrame render_one(const Job& job, const Renderer& renderer) {
  RenderOptions options = job.options;
  ProgressBar bar(std::string(renderer.label), job.flags.quiet);
  options.progress = bar.callback();
  return renderer.render(job, job.camera, options);
}

PicturePair render_pair(const Job& job) {
  const TimedFrame left = render_one(job, *find_renderer("raster"));
  const TimedFrame right = render_one(job, *find_renderer("raytrace"));
  PicturePair pair;
  pair.left = to_image8(left.frame.color, left.frame.width(), left.frame.height());
  pair.right = to_image8(right.frame.color, right.frame.width(), right.frame.height());
  pair.labels.title = job.scene.title.empty() ? job.flags.scene : job.scene.title;
  if (!job.flags.no_times) {
    pair.labels.left.times = Times{left.build_ms, left.frame_ms};
    pair.labels.right.times = Times{right.build_ms, right.frame_ms};
  }
  return pair;
}

int run_view(const ViewFlags& flags) {
  if (flags.screenshot.empty()) require_display();   // before any work
  const glm::ivec2 window = parse_size(flags.window, "--size");
  const Job job = load_job(flags.job);
  check_memory(job);
  const PicturePair pair = render_pair(job);
  if (!flags.screenshot.empty()) {
    write_png(flags.screenshot, screenshot(pair.left, pair.right, pair.labels, window.x, window.y),
              job_metadata(job, "raster, raytrace"));
    return 0;
  }
  restore_default_signals();
  return run_window(pair);
}

}  // namespace

void add_view_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<ViewFlags>();
  CLI::App* verb = app.add_subcommand("view", "the window: two pictures side by side, linked");
  add_job_flags(*verb, flags->job);
  add_fault_flags(*verb, flags->job.faults);
  verb->add_flag("--no-times", flags->job.no_times, "leave times out");
  verb->add_option("--screenshot", flags->screenshot, "draw the window off screen into FILE.png instead");
  verb->add_option("--size", flags->window, "size of that window")->capture_default_str();
  verb->footer(
      "Keys: wheel zooms, drag moves, 0 shows all, space swaps the two in place, Esc closes.\n"
      "Examples:\n"
      "  sidelight view scenes/showcase.toml\n"
      "  sidelight view scenes/07-mirrors.toml --depth 3 --screenshot mirrors.png");
  verb->callback([flags, &exit_code] { exit_code = run_view(*flags); });
}

}  // namespace sidelight
