// SPDX-License-Identifier: MIT
#include "viewer/commands/interrupt.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

#include "common/error.h"

namespace sidelight {
namespace {

std::atomic<bool> raised{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // may be touched by a signal handler

void on_signal(int signal) {
  raised = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

std::atomic<bool>& interrupt_flag() { return raised; }

void stop_if_interrupted() {
  if (raised) throw Interrupted();
}

void restore_default_signals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void reserve_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    const int file = open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    static_cast<void>(file);  // the lowest free number, so `stream`; where it fails, nothing more can be done
  }
}

void install_signal_handlers() {
  // Without the SA_RESTART that std::signal() sets: what waits for a file, a FIFO that nobody writes to, waits no longer.
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace sidelight
