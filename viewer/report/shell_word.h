// SPDX-License-Identifier: MIT
// Commands that a page or the window offers to be copied.
#pragma once

#include <string>
#include <string_view>

namespace sidelight {

// `text` as one word of a POSIX shell, quoted where it must be.
inline std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+,:@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

// The same for a file's name, which must not pass for a flag: "-a.toml" is "./-a.toml".
inline std::string shell_file(const std::string& path) {
  return shell_word(path.starts_with('-') ? "./" + path : path);
}

}  // namespace sidelight
