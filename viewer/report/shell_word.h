// SPDX-License-Identifier: MIT
// Commands that a page or the window offers to be copied.
#pragma once

#include <string>

namespace sidelight {

// `text` as one word of a POSIX shell, quoted where it must be.
std::string shell_word(const std::string& text);

}  // namespace sidelight
