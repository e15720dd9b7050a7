// SPDX-License-Identifier: MIT
// sidelight convert: the same scene for POV-Ray, an independent judge of our pictures.
#include <fmt/format.h>

#include "common/picture/atomic_file.h"
#include "common/scene/pov.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/interrupt.h"
#include "viewer/commands/job.h"

namespace sidelight {
namespace {

struct ConvertFlags {
  JobFlags job;
  std::string output;
};

int run_convert(const ConvertFlags& flags) {
  if (!flags.output.ends_with(".pov"))
    throw UsageError("OUT wants a file that ends in .pov; got '" + flags.output + "'");
  if (flags.job.spp != 1 || !flags.job.crop.empty())
    throw UsageError("convert takes no --spp and no --crop: sampling is for POV-Ray's own options to say");
  check_apart("SCENE", flags.job.scene, "OUT", flags.output);
  const Job job = load_job(flags.job);
  if (!flags.job.quiet)
    for (const PovLimit& limit : pov_limits(job.scene))
      fmt::print(stderr, "{}: not the same in POV-Ray: {}\n", printable(flags.job.scene, 1000), limit.text);
  write_text_file(flags.output, [&](const AppendText& append) {
    write_pov(job.scene, [&](std::string_view text) {
      stop_if_interrupted();
      append(text);
    });
  });
  return 0;
}

}  // namespace

void add_convert_command(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<ConvertFlags>();
  CLI::App* verb = app.add_subcommand("convert", "the same scene for POV-Ray 3.7");
  add_job_flags(*verb, flags->job);
  remove_flags(*verb, {"-j", "--isa"});
  for (const char* flag : {"--spp", "--crop"})
    verb->get_option(flag)->group("");  // refused above, with the reason
  verb->add_option("OUT", flags->output, "FILE.pov; its head says how to render it")->required();
  verb->footer(
      "What POV-Ray cannot express is named on standard error and in the file's head.\n"
      "Examples:\n"
      "  sidelight convert scenes/showcase.toml showcase.pov\n"
      "  sidelight convert scenes/07-mirrors.toml mirrors.pov -r 320x240 --depth 3");
  verb->callback([flags, &exit_code] { exit_code = run_convert(*flags); });
}

}  // namespace sidelight
