// SPDX-License-Identifier: MIT
// A double as text, for messages and scene files.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace sidelight {

// The shortest text that reads back as x, in TOML too: there a number without point or exponent is a whole one, which
// ends at 2^63.
inline std::string number_text(double x) {
  std::array<char, 32> digits;
  char* const first = digits.data();
  char* const last = first + digits.size();
  const bool whole_is_short = std::abs(x) < 1e15;
  return {first, (whole_is_short ? std::to_chars(first, last, x)
                                 : std::to_chars(first, last, x, std::chars_format::scientific))
                     .ptr};
}

}  // namespace sidelight
