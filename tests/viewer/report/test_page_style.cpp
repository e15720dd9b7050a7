// SPDX-License-Identifier: MIT
// The colours of a report and its plots can be told from their ground, light and dark.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/program.h"
#include "tests/support/text.h"
#include "viewer/report/html.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// "#rgb" or "#rrggbb", as relative luminance: Rec. 709 of the linear values.
double luminance_of(const std::string& color) {
  const bool brief = color.size() == 4;
  const auto channel = [&](std::size_t c) {
    const std::string digits = brief ? std::string(2, color.at(1 + c)) : color.substr(1 + 2 * c, 2);
    const double encoded = std::stoi(digits, nullptr, 16) / 255.0;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2);
}

// As the Web Content Accessibility Guidelines define it, from 1 to 21.
double contrast(const std::string& a, const std::string& b) {
  const double x = luminance_of(a), y = luminance_of(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

}  // namespace

TEST_CASE(
    "page style: text has a contrast of 4.5 to its ground, a mark or a curve one of 3, light and dark") {
  CHECK(contrast("#000", "#ffffff") == doctest::Approx(21));
  const std::string style = plot_style();
  const std::size_t dark = style.find("prefers-color-scheme: dark");
  REQUIRE(dark != std::string::npos);
  for (const std::size_t from : {std::size_t{0}, dark}) {
    CAPTURE(from);
    const auto color = [&](const std::string& name) {
      const std::string before = "--" + name + ": ";
      const std::size_t at = style.find(before, from);
      REQUIRE(at != std::string::npos);
      return style.substr(at + before.size(), style.find(';', at) - at - before.size());
    };
    for (const char* name : {"ink", "quiet", "accent", "bad"})
      for (const char* ground : {"paper", "panel"})
        CHECK_MESSAGE(contrast(color(name), color(ground)) >= 4.5, name, " on ", ground);
    CHECK(contrast(color("on-accent"), color("accent")) >= 4.5);
    for (const char* name : {"beaten", "c0", "c1", "c2", "c3", "c4", "c5"})
      CHECK_MESSAGE(contrast(color(name), color("paper")) >= 3, name);
  }
}

TEST_CASE("page style: the plot of the README has the colours of today") {
  CHECK(contains(read_bytes(SIDELIGHT_SOURCE_DIR "/scenes/showcase-bench.svg"), plot_file_style()));
}
