// SPDX-License-Identifier: MIT
// The program: registers the verbs, and turns what goes wrong into one line on stderr and the documented exit code.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <regex>
#include <system_error>

#include "common/error.h"
#include "common/scene/nearest_name.h"
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

// The code, if standard output took all that was said there.
int all_written(int code) {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout) return code;
  return complain(kOutput, "standard output: cannot write");
}

// One empty line between groups of options, not two, so that a verb's help fits a screen.
struct HelpFormatter : CLI::Formatter {
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return std::regex_replace(CLI::Formatter::make_help(app, std::move(name), mode), std::regex("\n{3,}"),
                              "\n\n");
  }
};

// A verb's own, and those of its groups, which have a heading of their own in its help.
std::vector<CLI::Option*> options_of(CLI::App& verb) {
  std::vector<CLI::Option*> out = verb.get_options();
  for (CLI::App* group : verb.get_subcommands({})) {
    const std::vector<CLI::Option*> grouped = group->get_options();
    out.insert(out.end(), grouped.begin(), grouped.end());
  }
  return out;
}

// A shell's unset variable must not pass for an option that was not given. Comes before every other check of an option's
// value, as the transform() that was added last.
void refuse_empty_values(CLI::App& app) {
  const std::function<std::string(std::string)> wants_value = [](std::string value) {
    if (value.empty()) throw CLI::ValidationError("wants a value; got ''");
    return value;
  };
  for (CLI::App* verb : app.get_subcommands({}))
    for (CLI::Option* option : options_of(*verb)) option->transform(wants_value);
}

// CLI11 would only say that a verb is wanted.
void check_verb(const CLI::App& app, const std::string& given) {
  std::vector<std::string_view> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  if (given.starts_with('-') || std::ranges::find(verbs, given) != verbs.end()) return;
  throw UsageError(fmt::format("there is no verb '{}', only {}{}", given, fmt::join(verbs, ", "),
                               did_you_mean(given, verbs)));
}

// What a verb could not make sense of. CLI11 counts the mark "--", after which nothing is a flag, among it.
std::vector<std::string> left_over(const CLI::App& verb) {
  std::vector<std::string> words = verb.remaining();
  std::erase(words, "--");
  return words;
}

// The same in a sentence, beginning with the flag that the verb does not know: "--dept 3".
std::string unexpected(CLI::App& verb) {
  const std::vector<std::string> words = left_over(verb);
  const auto flag =
      std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("--"); });
  if (flag == words.end()) return fmt::format("{}: not expected: {}", verb.get_name(), fmt::join(words, " "));
  const std::string name = flag->substr(0, flag->find('='));
  std::vector<std::string_view> known;
  for (const CLI::Option* option : options_of(verb))
    known.insert(known.end(), option->get_lnames().begin(), option->get_lnames().end());
  return fmt::format("{}: there is no '{}'{}", verb.get_name(), name,
                     did_you_mean(std::string_view(name).substr(2), known, "--"));
}

// CLI11 converts values to numbers only, and does not say so.
std::string in_words(const CLI::ParseError& error) {
  return error.what() + std::string(error.get_name() == "ConversionError" ? ", expected a number" : "");
}

// What a signal made fail failed because of it.
void parse(CLI::App& app, int argc, char** argv) {
  try {
    if (argc > 1) check_verb(app, argv[1]);
    app.parse(argc, argv);
  } catch (...) {
    stop_if_interrupted();
    throw;
  }
}

int run(int argc, char** argv) {
  CLI::App app(
      "sidelight renders one scene by z-buffer and by ray tracing, and accounts for every difference.",
      "sidelight");
  app.formatter(std::make_shared<HelpFormatter>());  // the verbs have it, too
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
    parse(app, argc, argv);
    return all_written(exit_code);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return all_written(app.exit(error));  // --help, --version
    const std::vector<CLI::App*> verb = app.get_subcommands();
    const bool extra = !verb.empty() && !left_over(*verb[0]).empty();
    const std::string what = extra ? unexpected(*verb[0]) : in_words(error);
    return complain(kUsage, fmt::format("{} (sidelight {}--help shows how)", printable(what, 300),
                                        verb.empty() ? "" : verb[0]->get_name() + " "));
  } catch (const UsageError& error) {
    return complain(kUsage, error.what());
  } catch (const InputError& error) {
    // Begins with file:line:column, where editors look for it.
    std::fputs((error.what() + std::string("\n")).c_str(), stderr);
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
    if (!std::ferror(stdout) && !std::ferror(stderr))  // no thread to be had, say
      return complain(kInput, fmt::format("the system refuses what this needs: {}", error.what()));
    return complain(kOutput,
                    fmt::format("standard {}: {}", std::ferror(stdout) ? "output" : "error", error.what()));
  }
}

}  // namespace
}  // namespace sidelight

int main(int argc, char** argv) {
  sidelight::reserve_standard_streams();
  sidelight::install_signal_handlers();
  return sidelight::run(argc, argv);
}
