// SPDX-License-Identifier: MIT
// A progress bar on stderr: only on a terminal, only when not quiet, gone when done.
#pragma once

#include <functional>
#include <mutex>
#include <string>

namespace sidelight {

class ProgressBar {
 public:
  ProgressBar(std::string label, bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // For RenderOptions::progress; empty when nothing is to be shown. Must not outlive the bar.
  std::function<void(double)> callback();

 private:
  void show(double done);

  std::string label_;
  bool shown_;
  std::mutex mutex_;
  double started_ms_;
  double last_shown_ms_ = 0;
  bool drawn_ = false;
};

}  // namespace sidelight
