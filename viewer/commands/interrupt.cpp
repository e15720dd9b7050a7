// SPDX-License-Identifier: MIT
#include "viewer/commands/interrupt.h"

#include <csignal>

namespace sidelight {
namespace {

std::atomic<bool> raised{false};
static_assert(std::atomic<bool>::is_always_lock_free);   // may be touched by a signal handler

void on_signal(int signal) {
  raised = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

std::atomic<bool>& interrupt_flag() { return raised; }

void restore_default_signals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void install_signal_handlers() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace sidelight
