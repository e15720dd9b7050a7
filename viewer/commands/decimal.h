// SPDX-License-Identifier: MIT
// Whole numbers of the command line are decimal.
#pragma once

#include <CLI/Error.hpp>
#include <algorithm>
#include <string>

namespace sidelight {

// Digits without the zeros that they begin with, for an option's transform(): CLI11 takes 010 for 8, as C does, and
// would take 0x10 for 16 and 1'0 or 1_0 for 10.
inline std::string decimal(const std::string& text) {
  if (text.find_first_not_of("+-.0123456789") != std::string::npos)
    throw CLI::ValidationError("wants a whole number in decimal; got '" + text + "'");
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) return text;
  return text.substr(std::min(text.find_first_not_of('0'), text.size() - 1));
}

}  // namespace sidelight
