// SPDX-License-Identifier: MIT
// sidelight view: the window with both pictures.
#include <fmt/format.h>

#include "viewer/commands/commands.h"
#include "viewer/commands/interrupt.h"
#include "viewer/commands/progress.h"
#include "viewer/commands/renderers.h"
#include "viewer/window/window.h"

namespace sidelight {
namespace {

TimedFrame render_one(const Job& job, const Renderer& renderer) {
  RenderOptions options = job.options;
  ProgressBar bar(std::string(renderer.label), job.flags.quiet);
  options.progress = bar.callback();
  return renderer.render(job, job.camera, options);
}

int run_view(const JobFlags& flags) {
  require_display();   // before any work
  const Job job = load_job(flags);
  check_memory(job);
  const TimedFrame left = render_one(job, *find_renderer("raster"));
  const TimedFrame right = render_one(job, *find_renderer("raytrace"));

  PicturePair pair;
  pair.left = to_image8(left.frame.color, left.frame.width(), left.frame.height());
  pair.right = to_image8(right.frame.color, right.frame.width(), right.frame.height());
  pair.labels.title = job.scene.title.empty() ? flags.scene : job.scene.title;
  if (!flags.no_times) {
    pair.labels.left.times = Times{left.build_ms, left.frame_ms};
    pair.labels.right.times = Times{right.build_ms, right.frame_ms};
  }
  restore_default_signals();
  return run_window(pair);
}

}  // namespace

void add_view_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<JobFlags>();
  CLI::App* verb = app.add_subcommand("view", "the window: two pictures side by side, linked");
  add_job_flags(*verb, *flags);
  verb->add_flag("--no-times", flags->no_times, "leave times out");
  verb->footer(
      "Keys: wheel zooms, drag moves, 0 shows all, space swaps the two in place, Esc closes.\n"
      "Examples:\n"
      "  sidelight view scenes/showcase.toml\n"
      "  sidelight view scenes/07-mirrors.toml -r 800x600 --depth 3");
  verb->callback([flags, &exit_code] { exit_code = run_view(*flags); });
}

}  // namespace sidelight
