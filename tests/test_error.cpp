// SPDX-License-Identifier: MIT
// printable(): nothing that comes out of it can steer a terminal, whatever goes in; ordinary text stays as it is.
#include "common/error.h"

#include <doctest/doctest.h>

#include "tests/support/inert.h"
#include "tests/support/random.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

std::string escaped(const std::string& bytes) {
  std::string out;
  for (const char byte : bytes) {
    constexpr char kDigits[] = "0123456789ABCDEF";
    const unsigned value = static_cast<unsigned char>(byte);
    out += std::string("\\x") + kDigits[value / 16] + kDigits[value % 16];
  }
  return out;
}

}  // namespace

TEST_CASE("printable: ordinary text of any script stays as it is") {
  for (const char* text : {"", "a plain line, 100 %", "Grüße, naïve façade", "Ωμέγα", "שלום", "سلام",
                           "日本語", "한국어", "x² + y² ≤ 1", "🙂", "back\\slash", "e\xCC\x81"}) {
    CAPTURE(text);
    CHECK(printable(text) == text);
  }
}

TEST_CASE("printable: every code point is either kept or escaped byte by byte, and what harms is escaped") {
  int kept = 0;
  for (char32_t code = 0; code < 0x110000; ++code) {
    if (0xD800 <= code && code < 0xE000) continue;
    const std::string bytes = utf8(code), shown = printable(bytes);
    const bool is_kept = shown == bytes;
    kept += is_kept;
    if (is_kept ? harm_of(code).empty() : shown == escaped(bytes)) continue;
    CAPTURE(static_cast<std::uint32_t>(code));
    CHECK(shown == escaped(bytes));
  }
  // 1,112,064 scalar values; escaped are 65 controls, 4174 ignorable ones (Unicode 15.0, DerivedCoreProperties.txt),
  // two separators of lines, and three annotations (U+FFF9..FFFB).
  CHECK(kept == 1'112'064 - 65 - 4174 - 2 - 3);
}

TEST_CASE("printable: bytes that are not UTF-8 are escaped one by one") {
  for (const char* bytes :
       {"\x80", "\xBF", "\xC0\x80", "\xC1\xBF", "\xC3", "\xE0\x80\x80", "\xE0\x9F\xBF", "\xE2\x82",
        "\xED\xA0\x80", "\xED\xBF\xBF", "\xF0\x80\x80\x80", "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80",
        "\xF5\x80\x80\x80", "\xF8\x88\x80\x80\x80", "\xFE", "\xFF"}) {
    CAPTURE(escaped(bytes));
    CHECK(printable(bytes) == escaped(bytes));
    CHECK(printable(std::string("a") + bytes + "z") == "a" + escaped(bytes) + "z");
  }
}

TEST_CASE("printable: terminal sequences and hidden text come out as text") {
  CHECK(printable("\x1B[2J") == "\\x1B[2J");
  CHECK(printable("\x1B]52;c;aGk=\x07") == "\\x1B]52;c;aGk=\\x07");
  CHECK(printable("\xC2\x9B"
                  "2J") == "\\xC2\\x9B2J");
  CHECK(printable("a\xE2\x80\xAE"
                  "b") == "a\\xE2\\x80\\xAEb");
  CHECK(printable("one\r\ntwo\t") == "one\\x0D\\x0Atwo\\x09");
  CHECK(printable(std::string("a\0b", 3)) == "a\\x00b");
}

TEST_CASE("printable: length is bounded, at a whole character") {
  CHECK(printable("abcdef", 6) == "abcdef");
  CHECK(printable("abcdefg", 6) == "abcdef...");
  CHECK(printable("\u00e9\u00e9\u00e9", 3) == "\u00e9\u00e9...");
  CHECK(printable("abc", 0) == "...");
  std::string tags;
  while (tags.size() < 1'000'000) tags += utf8(0xE0041);
  for (std::size_t limit = 0; limit < 40; ++limit) CHECK(printable(tags, limit).size() <= limit + 18);
}

TEST_CASE("printable: random bytes come out inert, and once more unchanged") {
  test::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes(1 + random.below(60), '\0');
    // Mostly from the bytes that lead and continue sequences.
    for (char& byte : bytes)
      byte = static_cast<char>(random.below(2) ? random.below(256) : 0x80 + random.below(128));
    const std::string shown = printable(bytes, 10'000);
    CHECK(harm_in(shown) == "");
    CHECK(printable(shown, 10'000) == shown);
  }
}
