// SPDX-License-Identifier: MIT
// Telling well-formed UTF-8 from other bytes, and harmless characters from others: what everything that shows untrusted
// text begins with.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace sidelight {

// Length of the well-formed UTF-8 sequence that starts at text[i], 0 if there is none (RFC 3629, section 4).
inline std::size_t utf8_length(std::string_view text, std::size_t i) {
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

// How many characters it shows: its code points, and every byte that is part of none.
inline std::size_t utf8_count(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++count) i += std::max<std::size_t>(1, utf8_length(text, i));
  return count;
}

// Of the well-formed sequence of `length` bytes at text[i].
inline char32_t code_point(std::string_view text, std::size_t i, std::size_t length) {
  constexpr std::array<unsigned, 5> kLeadBits{0, 0x7F, 0x1F, 0x0F, 0x07};
  char32_t code = static_cast<unsigned char>(text[i]) & kLeadBits[length];
  for (std::size_t k = 1; k < length; ++k)
    code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
  return code;
}

// What could steer a terminal, reorder a line or hide in it (error.h, printable).
struct CodeRange {
  char32_t first, last;
};

// Controls, separators of lines, and Default_Ignorable_Code_Point of Unicode 15.0 (DerivedCoreProperties.txt) with the
// interlinear annotations that stand next to it; sorted.
inline constexpr std::array<CodeRange, 19> kHarmfulRanges{{{0x0000, 0x001F},
                                                           {0x007F, 0x009F},
                                                           {0x00AD, 0x00AD},
                                                           {0x034F, 0x034F},
                                                           {0x061C, 0x061C},
                                                           {0x115F, 0x1160},
                                                           {0x17B4, 0x17B5},
                                                           {0x180B, 0x180F},
                                                           {0x200B, 0x200F},
                                                           {0x2028, 0x202E},
                                                           {0x2060, 0x206F},
                                                           {0x3164, 0x3164},
                                                           {0xFE00, 0xFE0F},
                                                           {0xFEFF, 0xFEFF},
                                                           {0xFFA0, 0xFFA0},
                                                           {0xFFF0, 0xFFFB},
                                                           {0x1BCA0, 0x1BCA3},
                                                           {0x1D173, 0x1D17A},
                                                           {0xE0000, 0xE0FFF}}};

inline bool is_harmful(char32_t code) {
  const auto range = std::lower_bound(kHarmfulRanges.begin(), kHarmfulRanges.end(), code,
                                      [](const CodeRange& r, char32_t c) { return r.last < c; });
  return range != kHarmfulRanges.end() && range->first <= code;
}

}  // namespace sidelight
