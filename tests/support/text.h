// SPDX-License-Identifier: MIT
// What stands in a text.
#pragma once

#include <cstddef>
#include <string>

namespace sidelight::test {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// How often; places that overlap count once.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

}  // namespace sidelight::test
