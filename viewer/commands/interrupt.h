// SPDX-License-Identifier: MIT
// Ctrl-C: raises one flag that renderers look at between tiles, so that a run ends cleanly with exit code 130 and no
// half-written file. A second Ctrl-C ends the process at once.
#pragma once

#include <atomic>

namespace sidelight {

std::atomic<bool>& interrupt_flag();

// From here on Ctrl-C ends the process at once: for the window, which sleeps until the next event.
void restore_default_signals();

// Installs the handler for SIGINT and SIGTERM, and lets writes beyond a file-size limit fail instead of killing the
// process (SIGXFSZ), so that they can be reported.
void install_signal_handlers();

}  // namespace sidelight
