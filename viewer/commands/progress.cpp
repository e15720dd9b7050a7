// SPDX-License-Identifier: MIT
#include "viewer/commands/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "common/clock.h"

namespace sidelight {

ProgressBar::ProgressBar(std::string label, bool quiet)
    : label_(std::move(label)), shown_(!quiet && isatty(STDERR_FILENO)), started_ms_(wall_ms()) {}

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
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(done * kWidth);
  const double left_s = done > 0 ? (now - started_ms_) * (1 - done) / done / 1000 : 0;
  const std::string line = fmt::format("\r\033[K{} [{:#<{}}{:.<{}}] {:3.0f} %, {:.0f} s left", label_, "",
                                       filled, "", kWidth - filled, 100 * done, left_s);
  // Not fmt::print, which throws where the terminal is gone: a picture must not be lost for its bar.
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace sidelight
