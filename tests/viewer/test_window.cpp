// SPDX-License-Identifier: MIT
// The real window, on a display that nobody sees (Xvfb), driven by real key and mouse events.
#include <doctest/doctest.h>

#include <array>
#include <string>

#include "tests/tier.h"
#include "tests/viewer/program.h"

using namespace sidelight;
using namespace sidelight::testing;

TEST_CASE("view: the real window opens, takes keys and mouse, shows ink and closes by Escape") {
  if (test::tier() == "sanitized") return test::skip_test("the OpenGL driver leaks");
  const Workplace here;
  const Arguments command{"xvfb-run", "-a", SIDELIGHT_SOURCE_DIR "/tests/viewer/open_window.sh", SIDELIGHT_BINARY,
                          SIDELIGHT_SOURCE_DIR "/scenes/06-shadows.toml", here / "window.xwd"};
  Process process(command, here / ".");
  const Outcome outcome = process.wait();
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  // A window that stayed black holds hardly more than one byte value behind the dump's header.
  const std::string shown = read_bytes(here / "window.xwd");
  REQUIRE(shown.size() > 10000);
  const std::string pixels = shown.substr(shown.size() / 4);
  int colours = 0;
  std::array<bool, 256> seen{};
  for (const char c : pixels) {
    bool& s = seen[static_cast<unsigned char>(c)];
    colours += s ? 0 : 1;
    s = true;
  }
  CHECK(colours > 50);   // shaded surfaces, not just the frame and the text
}
