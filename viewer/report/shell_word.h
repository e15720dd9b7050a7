// SPDX-License-Identifier: MIT
// Commands that a page or the window offers to be copied.
#pragma once

#include <string>

namespace sidelight {

// `text` as one word of a POSIX shell, quoted where it must be.
std::string shell_word(const std::string& text);
// The same for a file's name, which must not pass for a flag: "-a.toml" is "./-a.toml".
std::string shell_file(const std::string& path);

}  // namespace sidelight
