// SPDX-License-Identifier: MIT
#include "common/error.h"

#include <cstdio>

#include "common/utf8.h"

namespace sidelight {
namespace {

std::string located(const SourceLocation& where, const std::string& message) {
  std::string text = printable(where.file, 1000);
  if (where.line > 0) text += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
  return text + ": " + printable(message, 2000);
}

}  // namespace

InputError::InputError(const SourceLocation& where, const std::string& message)
    : std::runtime_error(located(where, message)) {}

std::string printable(const std::string& text, std::size_t max_length) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    if (out.size() >= max_length) return out + "...";
    const std::size_t length = utf8_length(text, i);
    const unsigned lead = static_cast<unsigned char>(text[i]);
    // C0, DEL, and C1 (U+0080..U+009F is C2 80..C2 9F) steer terminals.
    const bool c1 = length == 2 && lead == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (length == 0 || lead < 0x20 || lead == 0x7F || c1) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\x%02X", lead);
      out += escaped;
      i += 1;
      if (c1) {
        std::snprintf(escaped, sizeof escaped, "\\x%02X", static_cast<unsigned char>(text[i]));
        out += escaped;
        i += 1;
      }
    } else {
      out.append(text, i, length);
      i += length;
    }
  }
  return out;
}

}  // namespace sidelight
