// SPDX-License-Identifier: MIT
#include "common/error.h"

#include <algorithm>

#include "common/utf8.h"

namespace sidelight {
namespace {

std::string located(const SourceLocation& where, const std::string& message) {
  std::string text = printable(where.file, 1000);
  if (where.line > 0) text += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
  return text + ": " + printable(message, 2000);
}

void append_escaped(std::string& out, unsigned char byte) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  out += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
}

}  // namespace

InputError::InputError(const SourceLocation& where, const std::string& message)
    : std::runtime_error(located(where, message)) {}

std::string printable(const std::string& text, std::size_t max_length) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    if (out.size() >= max_length) return out + "...";
    const std::size_t length = utf8_length(text, i);
    if (length > 0 && !is_harmful(code_point(text, i, length))) {
      out.append(text, i, length);
      i += length;
      continue;
    }
    for (const std::size_t end = i + std::max<std::size_t>(length, 1); i < end; ++i)
      append_escaped(out, static_cast<unsigned char>(text[i]));
  }
  return out;
}

}  // namespace sidelight
