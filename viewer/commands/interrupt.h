// SPDX-License-Identifier: MIT
// What the process owes the system that runs it: standard streams that are what they seem, and Ctrl-C, which raises one
// flag that renderers look at between tiles, so that a run ends cleanly with exit code 130 and no half-written file. A
// second Ctrl-C ends the process at once.
#pragma once

#include <atomic>

namespace sidelight {

std::atomic<bool>& interrupt_flag();
// Throws Interrupted once the flag is raised: for verbs whose work is not a renderer's.
void stop_if_interrupted();

// From here on Ctrl-C ends the process at once: for the window, which sleeps until the next event.
void restore_default_signals();

// Those of standard input, output and error that the caller closed are opened, else the next file to be opened would
// take their number and messages would end up in a picture: an empty input, an output that fails, messages unseen.
void reserve_standard_streams();

// Installs the handler for SIGINT and SIGTERM, and lets writes beyond a file-size limit (SIGXFSZ) or to a reader that is
// gone (SIGPIPE) fail instead of killing the process, so that they can be reported.
void install_signal_handlers();

}  // namespace sidelight
