// SPDX-License-Identifier: MIT
// What both benchmarks share as programs: parts of their command line, tables, the machine they ran on.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace sidelight::bench {

// Lines of cells as a table of Markdown whose columns are aligned, the first line its head: all columns but the first to
// the right. Every line has as many cells as the head.
std::string table(const std::vector<std::vector<std::string>>& lines);

// Times as fast: "5.3".
std::string times_words(double ratio);
// How a ratio stands to its bar: "-" without one (0), else "yes" or "no", followed by the bar: "no (5)".
std::string verdict_words(double ratio, double least);

// The load average over the last minute, and the name of the processor.
double machine_load();
std::string machine_name();

struct Size {
  int width = 0, height = 0;
  std::string text() const { return std::to_string(width) + "x" + std::to_string(height); }
  bool operator==(const Size&) const = default;
};

// "640x480,1280x720". Throws UsageError.
std::vector<Size> parse_sizes(const std::string& text);

// Runs a program's body and turns what it throws into a line on standard error and the exit code: 2 for wrong usage, 3
// for a bad input file, else 1.
int guarded(const char* program, const std::function<void()>& body);

}  // namespace sidelight::bench
