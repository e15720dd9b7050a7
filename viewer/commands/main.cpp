// SPDX-License-Identifier: MIT
// The program: registers the verbs, and turns what goes wrong into one line on stderr and the documented exit code.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <regex>
#include <system_error>

#include "common/error.h"
#include "viewer/commands/commands.h"
#include "viewer/commands/interrupt.h"
#include "viewer/window/window.h"

namespace sidelight {
namespace {

enum ExitCode {
  kFine = 0,
  kUsage = 2,
  kInput = 3,
  kNoMatch = 4,
  kNumerical = 5,
  kNoDisplay = 6,
  kOutput = 7,
  kInterrupted = 130
};

int complain(int code, const std::string& message) {
  // Not fmt::print, which throws where standard error is full: the code must get out even so.
  std::fputs(("sidelight: " + printable(message, 2000) + "\n").c_str(), stderr);
  return code;
}

// One empty line between groups of options, not two, so that a verb's help fits a screen.
struct HelpFormatter : CLI::Formatter {
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return std::regex_replace(CLI::Formatter::make_help(app, std::move(name), mode), std::regex("\n{3,}"), "\n\n");
  }
};

// A shell's unset variable must not pass for an option that was not given.
void refuse_empty_values(CLI::App& app) {
  const auto wants_value = [](const std::string& value) {
    return value.empty() ? std::string("wants a value; got ''") : std::string();
  };
  for (CLI::App* verb : app.get_subcommands({}))
    for (CLI::Option* option : verb->get_options()) option->check(wants_value);
}

int run(int argc, char** argv) {
  CLI::App app("sidelight renders one scene by z-buffer and by ray tracing, and accounts for every difference.",
               "sidelight");
  app.formatter(std::make_shared<HelpFormatter>());   // the verbs have it, too
  app.set_version_flag("--version", "sidelight " SIDELIGHT_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 fine, 1 the pictures differ beyond what is explained (compare) or allowed (diff),\n"
      "2 wrong usage, 3 bad input, 4 size or channels differ, 5 numerical fault, 6 no display,\n"
      "7 output could not be written, 130 interrupted.\n"
      "sidelight VERB --help shows a verb's flags and examples.");
  int exit_code = kFine;
  add_view_command(app, exit_code);
  add_compare_command(app, exit_code);
  add_render_command(app, exit_code);
  add_diff_command(app, exit_code);
  add_explain_command(app, exit_code);
  add_bench_command(app, exit_code);
  add_convert_command(app, exit_code);
  add_info_command(app, exit_code);
  refuse_empty_values(app);

  try {
    app.parse(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw OutputError("standard output: cannot write");
    return exit_code;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);   // --help, --version
    return complain(kUsage, fmt::format("{} (sidelight --help shows how)", printable(error.what(), 300)));
  } catch (const UsageError& error) {
    return complain(kUsage, error.what());
  } catch (const InputError& error) {
    std::fputs((error.what() + std::string("\n")).c_str(), stderr);   // begins with file:line:column, where editors look for it
    return kInput;
  } catch (const std::bad_alloc&) {
    return complain(kInput, "not enough memory for this scene and size");
  } catch (const PicturesDoNotMatch& error) {
    return complain(kNoMatch, error.what());
  } catch (const NumericalFault& error) {
    return complain(kNumerical, fmt::format("not a number in the picture: {}", error.what()));
  } catch (const NoDisplay& error) {
    return complain(kNoDisplay, error.what());
  } catch (const OutputError& error) {
    return complain(kOutput, error.what());
  } catch (const Interrupted& error) {
    return complain(kInterrupted, error.what());
  } catch (const std::system_error& error) {
    if (!std::ferror(stdout) && !std::ferror(stderr)) throw;
    return complain(kOutput, fmt::format("standard {}: {}", std::ferror(stdout) ? "output" : "error", error.what()));
  }
}

}  // namespace
}  // namespace sidelight

int main(int argc, char** argv) {
  sidelight::reserve_standard_streams();
  sidelight::install_signal_handlers();
  return sidelight::run(argc, argv);
}
