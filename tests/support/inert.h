// SPDX-License-Identifier: MIT
// Whether text is harmless on a terminal, decided on its own: it decodes UTF-8 by encoding again what it found, and
// knows the dangerous characters by name, not by the table of the function under test.
#pragma once

#include <cstdint>
#include <string>

namespace sidelight::test {

inline std::string utf8(char32_t code) {
  const auto byte = [](char32_t bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xC0 | code >> 6), byte(0x80 | (code & 63))};
  if (code < 0x10000)
    return {byte(0xE0 | code >> 12), byte(0x80 | (code >> 6 & 63)), byte(0x80 | (code & 63))};
  return {byte(0xF0 | code >> 18), byte(0x80 | (code >> 12 & 63)), byte(0x80 | (code >> 6 & 63)),
          byte(0x80 | (code & 63))};
}

// Of the character; empty if it does no harm. A newline ends a line, and is the caller's to allow.
inline std::string harm_of(char32_t code) {
  const auto within = [&](char32_t first, char32_t last) { return first <= code && code <= last; };
  if (code < 0x20) return "a C0 control";
  if (within(0x7F, 0x9F)) return "DEL or a C1 control";
  if (within(0x202A, 0x202E) || within(0x2066, 0x2069))
    return "a bidirectional override, embedding or isolate";
  if (code == 0x061C || within(0x200E, 0x200F)) return "a bidirectional mark";
  if (within(0x2028, 0x2029)) return "a separator of lines";
  if (within(0x200B, 0x200D) || code == 0x2060 || code == 0xFEFF || code == 0x00AD) return "invisible";
  if (within(0xE0000, 0xE007F)) return "a tag";
  return {};
}

// The first harm in `text` and where it is; empty if there is none but newlines.
inline std::string harm_in(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\n') {
      ++i;
      continue;
    }
    const unsigned lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    char32_t code = length == 1 ? lead : lead & (0xFFu >> (length + 1));
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
    const bool is_scalar = code < 0x110000 && !(0xD800 <= code && code < 0xE000);
    const std::string at = " at byte " + std::to_string(i);
    if (!is_scalar || text.compare(i, length, utf8(code)) != 0) return "not UTF-8" + at;
    if (const std::string harm = harm_of(code); !harm.empty()) return harm + at;
    i += length;
  }
  return {};
}

}  // namespace sidelight::test
