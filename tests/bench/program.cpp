// SPDX-License-Identifier: MIT
#include "tests/bench/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "common/error.h"

namespace sidelight::bench {

std::string table(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> widths(lines.at(0).size(), 3);
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths.at(i) = std::max(widths[i], line[i].size());
  std::string out;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    for (std::size_t i = 0; i < lines[l].size(); ++i)
      out += i == 0 ? fmt::format("| {:<{}} |", lines[l][i], widths[i])
                    : fmt::format(" {:>{}} |", lines[l][i], widths[i]);
    out += '\n';
    if (l > 0) continue;
    for (std::size_t i = 0; i < widths.size(); ++i)
      out +=
          i == 0 ? fmt::format("| {:-<{}} |", "", widths[i]) : fmt::format(" {:->{}}: |", "", widths[i] - 1);
    out += '\n';
  }
  return out;
}

std::string times_words(double ratio) { return fmt::format("{:.2f}", ratio); }

std::string verdict_words(double ratio, double least) {
  return least == 0 ? "-" : fmt::format("{} ({:.3g})", ratio >= least ? "yes" : "no", least);
}

double machine_load() {
  double load = 0;
  return ::getloadavg(&load, 1) == 1 ? load : 0;
}

std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return printable(line.substr(line.find(':') + 2));
  return "unknown";
}

std::vector<Size> parse_sizes(const std::string& text) {
  std::vector<Size> sizes;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    Size size;
    const char* const end = word.data() + word.size();
    const auto [cross, wrong_width] = std::from_chars(word.data(), end, size.width);
    const bool has_cross = wrong_width == std::errc() && cross != end && *cross == 'x';
    const auto [rest, wrong_height] = std::from_chars(has_cross ? cross + 1 : end, end, size.height);
    if (wrong_height != std::errc() || rest != end || std::min(size.width, size.height) < 1 ||
        std::max(size.width, size.height) > 8192)
      throw UsageError("--sizes wants WxH,WxH,... with sides from 1 to 8192; got '" + text + "'");
    sizes.push_back(size);
  }
  return sizes;
}

int guarded(const char* program, const std::function<void()>& body) {
  const auto complain = [&](int code, const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return code;
  };
  try {
    body();
    if (std::fflush(stdout) != 0) throw OutputError("standard output: cannot write");
    return 0;
  } catch (const UsageError& error) {
    return complain(2, error);
  } catch (const InputError& error) {
    return complain(3, error);
  } catch (const std::exception& error) {
    return complain(1, error);
  }
}

}  // namespace sidelight::bench
