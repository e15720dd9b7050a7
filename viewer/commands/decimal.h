// SPDX-License-Identifier: MIT
// Whole numbers of the command line are decimal.
#pragma once

#include <algorithm>
#include <string>

namespace sidelight {

// Digits without the zeros that they begin with, for an option's transform(): CLI11 takes 010 for 8, as C does.
inline std::string decimal(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) return text;
  return text.substr(std::min(text.find_first_not_of('0'), text.size() - 1));
}

}  // namespace sidelight
