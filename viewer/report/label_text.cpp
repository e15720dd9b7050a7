// SPDX-License-Identifier: MIT
#include "viewer/report/label_text.h"

#include <algorithm>

#include "common/utf8.h"

namespace sidelight {

std::string shortened(const std::string& text) {
  std::size_t count = 0, i = 0;
  for (; i < text.size() && count < kLongestLine; ++count)
    i += std::max<std::size_t>(1, utf8_length(text, i));
  return i < text.size() ? text.substr(0, i) + "…" : text;
}

std::vector<std::string> in_two_lines(const std::string& text) {
  if (utf8_count(text) <= kLongestLine) return {text};
  std::size_t blank = std::string::npos;
  for (std::size_t at = 0; (at = text.find(' ', at)) != std::string::npos; ++at)
    if (utf8_count(text.substr(0, at)) <= kLongestLine) blank = at;
  if (blank == std::string::npos) return {shortened(text)};
  return {text.substr(0, blank), shortened(text.substr(blank + 1))};
}

double text_width(const std::string& line, double letter) {
  return letter * static_cast<double>(utf8_count(line));
}

}  // namespace sidelight
