// SPDX-License-Identifier: MIT
// How a plot's labels are cut and broken into lines, in a type whose letters have no known width.
#pragma once

#include <string>
#include <vector>

namespace sidelight {

inline constexpr std::size_t kLongestLine = 34;  // of a label, in letters

// Its first kLongestLine letters, with an ellipsis where there are more.
std::string shortened(const std::string& text);

// Broken at a blank into two lines where it is longer than one, so that a number at its end can be read; each shortened.
std::vector<std::string> in_two_lines(const std::string& text);

// At most, nearly always, where no letter is wider than `letter`.
double text_width(const std::string& line, double letter);

}  // namespace sidelight
