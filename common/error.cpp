// SPDX-License-Identifier: MIT
#include "common/error.h"

#include <cstdio>

namespace sidelight {
namespace {

std::string located(const SourceLocation& where, const std::string& message) {
  std::string text = printable(where.file, 1000);
  if (where.line > 0) text += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
  return text + ": " + printable(message, 2000);
}

// Length of the well-formed UTF-8 sequence that starts at text[i], 0 if there is none (RFC 3629, section 4).
std::size_t utf8_length(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) -> unsigned {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
  };
  const auto continues = [&](std::size_t k) { return (byte(k) & 0xC0u) == 0x80u; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return continues(1) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool overlong = lead == 0xE0 && byte(1) < 0xA0;
    const bool surrogate = lead == 0xED && byte(1) >= 0xA0;
    return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    const bool overlong = lead == 0xF0 && byte(1) < 0x90;
    const bool beyond = lead == 0xF4 && byte(1) >= 0x90;
    return continues(1) && continues(2) && continues(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
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
