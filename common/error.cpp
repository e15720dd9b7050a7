// SPDX-License-Identifier: MIT
#include "common/error.h"

#include <algorithm>
#include <array>

#include "common/utf8.h"

namespace sidelight {
namespace {

std::string located(const SourceLocation& where, const std::string& message) {
  std::string text = printable(where.file, 1000);
  if (where.line > 0) text += ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
  return text + ": " + printable(message, 2000);
}

// Of the well-formed sequence of `length` bytes at text[i].
char32_t code_point(const std::string& text, std::size_t i, std::size_t length) {
  constexpr std::array<unsigned, 5> kLeadBits{0, 0x7F, 0x1F, 0x0F, 0x07};
  char32_t code = static_cast<unsigned char>(text[i]) & kLeadBits[length];
  for (std::size_t k = 1; k < length; ++k) code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
  return code;
}

struct CodeRange {
  char32_t first, last;
};

// Controls, separators of lines, and Default_Ignorable_Code_Point of Unicode 15.0 (DerivedCoreProperties.txt) with the
// interlinear annotations that stand next to it; sorted.
constexpr std::array<CodeRange, 19> kHarmful{{{0x0000, 0x001F}, {0x007F, 0x009F}, {0x00AD, 0x00AD},
                                              {0x034F, 0x034F}, {0x061C, 0x061C}, {0x115F, 0x1160},
                                              {0x17B4, 0x17B5}, {0x180B, 0x180F}, {0x200B, 0x200F},
                                              {0x2028, 0x202E}, {0x2060, 0x206F}, {0x3164, 0x3164},
                                              {0xFE00, 0xFE0F}, {0xFEFF, 0xFEFF}, {0xFFA0, 0xFFA0},
                                              {0xFFF0, 0xFFFB}, {0x1BCA0, 0x1BCA3}, {0x1D173, 0x1D17A},
                                              {0xE0000, 0xE0FFF}}};

bool is_harmful(char32_t code) {
  const auto range = std::lower_bound(kHarmful.begin(), kHarmful.end(), code,
                                      [](const CodeRange& r, char32_t c) { return r.last < c; });
  return range != kHarmful.end() && range->first <= code;
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
