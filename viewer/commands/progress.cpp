// SPDX-License-Identifier: MIT
#include "viewer/commands/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "common/clock.h"

namespace sidelight {
namespace {

// That takes the escape sequence that clears a line.
bool stderr_is_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) && (!kind || std::string_view(kind) != "dumb");
}

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// At most as long as a row of the terminal less one, since a line that wraps is not cleared whole.
std::string progress_line(const std::string& label, double done, double left_s, std::size_t columns) {
  constexpr std::size_t kWidest = 30, kNarrowest = 5;
  const std::string number = fmt::format("{:3.0f} %, {:.0f} s left", 100 * done, left_s);
  const std::size_t around = label.size() + number.size() + 5;  // blanks, brackets, the last column
  std::string bar;
  if (columns >= around + kNarrowest) {
    const std::size_t width = std::min(kWidest, columns - around);
    const auto filled = static_cast<std::size_t>(done * static_cast<double>(width));
    bar = fmt::format("[{:#<{}}{:.<{}}] ", "", filled, "", width - filled);
  }
  return fmt::format("{} {}{}", label, bar, number).substr(0, columns - 1);
}

}  // namespace

ProgressBar::ProgressBar(std::string label, bool quiet)
    : label_(std::move(label)), shown_(!quiet && stderr_is_terminal()), started_ms_(wall_ms()) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

std::function<void(double)> ProgressBar::callback() {
  if (!shown_) return {};
  return [this](double done) { show(done); };
}

void ProgressBar::show(double done) {
  const std::lock_guard lock(mutex_);
  const double now = wall_ms();
  if (now - last_shown_ms_ < 100 || now - started_ms_ < 300) return;  // short work needs no bar
  last_shown_ms_ = now;
  drawn_ = true;
  const double left_s = done > 0 ? (now - started_ms_) * (1 - done) / done / 1000 : 0;
  const std::string line = "\r\033[K" + progress_line(label_, done, left_s, terminal_columns());
  // Not fmt::print, which throws where the terminal is gone: a picture must not be lost for its bar.
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace sidelight
