// SPDX-License-Identifier: MIT
// The verbs of the program, one file each. add_X_command registers a verb with its flags and help; parsing it runs it
// and sets the exit code (0, or 1 where a comparison found a difference). Everything else is an exception that main
// turns into a code.
#pragma once

#include <CLI/App.hpp>

namespace sidelight {

void add_bench_command(CLI::App& app, int& exit_code);
void add_compare_command(CLI::App& app, int& exit_code);
void add_convert_command(CLI::App& app, int& exit_code);
void add_diff_command(CLI::App& app, int& exit_code);
void add_explain_command(CLI::App& app, int& exit_code);
void add_info_command(CLI::App& app, int& exit_code);
void add_render_command(CLI::App& app, int& exit_code);
void add_view_command(CLI::App& app, int& exit_code);

}  // namespace sidelight
