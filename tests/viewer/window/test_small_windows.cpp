// SPDX-License-Identifier: MIT
// Windows in which not everything has room: what is left out, and how one learns of it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "tests/viewer/window/session.h"
#include "viewer/window/offscreen.h"
#include "viewer/window/window_panels.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// What can stand in a window, from top to bottom.
std::vector<Rect> parts_of(const WindowLayout& layout) {
  const Layout& panels = layout.panels;
  std::vector<Rect> out{panels.title, panels.left_caption, panels.left_times, panels.left,  layout.legend,
                        layout.slow,  layout.inspector,    layout.lesson,     panels.footer};
  std::erase_if(out, [](const Rect& box) { return box.width() <= 0 || box.height() <= 0; });
  return out;
}

bool stand_apart(const std::vector<Rect>& parts) {
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (parts[i].y0 < parts[i - 1].y1) return false;
  return true;
}

WindowState lesson_state(const Workplace& here) {
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  state.opened.scene.lesson = "Where do the two pictures differ, and why?";
  return state;
}

}  // namespace

TEST_CASE("small windows: nothing lies over anything else") {
  const Workplace here;
  WindowState state = lesson_state(here);
  for (const glm::ivec2& size :
       {glm::ivec2(30, 20), {100, 60}, {200, 100}, {320, 240}, {400, 300}, {640, 480}})
    for (const Mode mode : {Mode::side_by_side, Mode::difference, Mode::causes, Mode::ledger})
      for (int open = 0; open < 32; ++open) {
        state.mode = mode;
        state.lesson = (open & 1) != 0;
        state.inspected.reset();
        if (open & 2) state.inspected = glm::ivec2(20, 20);
        state.slow = (open & 4) != 0;
        state.opened.times = (open & 8) != 0;
        const double scale = open & 16 ? 1.5 : 1;
        CAPTURE(size.x);
        CAPTURE(open);
        CHECK(stand_apart(parts_of(window_layout(state, size, scale))));
      }
}

TEST_CASE("small windows: the pictures keep a part of them, whatever is open") {
  const Workplace here;
  WindowState state = lesson_state(here);
  state.mode = Mode::causes;
  for (const bool open : {false, true}) {
    state.lesson = open;
    if (open) state.inspected = glm::ivec2(20, 20);
    for (const glm::ivec2& size : {glm::ivec2(320, 240), {400, 300}, {640, 360}, {640, 480}})
      CHECK(window_layout(state, size, 1).panels.left.height() >= size.y / 4);
  }
}

TEST_CASE("small windows: a panel that is shown has room for a row, and the others are named with a size") {
  const Workplace here;
  WindowState state = lesson_state(here);
  state.lesson = true;
  state.inspected = glm::ivec2(20, 20);
  for (int height = 100; height < 700; ++height) {
    const WindowLayout layout = window_layout(state, {400, height}, 1);
    for (const Rect& box : {layout.inspector, layout.lesson})
      CHECK((box.height() == 0 || box.height() >= 40));  // padding and a row
  }
  const std::vector<std::string> small = left_out(state, 400, 280);
  REQUIRE(small.size() == 2);
  CHECK(small[0].starts_with("no room for the inspector at 400x280: shown from 400x"));
  CHECK(small[1].starts_with("no room for the lesson at 400x280: shown from 400x"));
  CHECK(left_out(state, 1352, 648).empty());
}

#ifdef SIDELIGHT_HAVE_OSMESA

namespace {

// Bytes in the box that are brighter than page and panels are: text.
int bright_bytes(const Image8& image, const Rect& box) {
  int count = 0;
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = 3 * box.x0; x < 3 * box.x1; ++x)
      count += image.rgb[3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(x)] > 150;
  return count;
}

}  // namespace

TEST_CASE("small windows: what is too long for its row ends before the window does") {
  const Workplace here;
  WindowState state = lesson_state(here);
  for (const Mode mode : {Mode::causes, Mode::difference}) {
    state.mode = mode;
    const Pictures pictures = render_pictures(picture_task(state));
    const Image8 window = screenshot(state, pictures, 260, 400);
    CHECK(bright_bytes(window, window_layout(state, {260, 400}, 1).legend) > 200);
    CHECK(bright_bytes(window, {260 - 20, 0, 260, 400}) == 0);
  }
}

TEST_CASE("small windows: words that have no room end in an ellipsis, in whole rows") {
  const Workplace here;
  WindowState state = lesson_state(here);
  state.lesson = true;
  const Pictures pictures = render_pictures(picture_task(state));
  constexpr glm::ivec2 kSize{700, 500};
  // DejaVu's ellipsis is as wide as it is high; the panel's padding is 12 pixels beside and 10 above.
  constexpr int kPadding = 12, kRow = 21, kWide = 20;
  const auto right_of = [&](const Image8& window, const Rect& box, int top, int bottom) {
    return bright_bytes(window, {box.x1 - kPadding - kWide, top, box.x1 - kPadding, bottom});
  };
  for (const int words : {3, 200}) {
    state.opened.scene.lesson.clear();
    for (int i = 0; i < words; ++i) state.opened.scene.lesson += fmt::format("word {}, ", i);
    const Rect box = window_layout(state, kSize, 1).lesson;
    const Image8 window = screenshot(state, pictures, kSize.x, kSize.y);
    const int rows = words < 4 ? 1 : (box.height() - 20) / kRow, last = box.y0 + 10 + kRow * (rows - 1);
    CHECK(bright_bytes(window, {box.x0, box.y0, box.x1, box.y0 + 10 + kRow}) > 100);
    CHECK(right_of(window, box, box.y0 + 1, last) == 0);
    CHECK((right_of(window, box, last, last + kRow) > 0) == (words > 4));
    CHECK(bright_bytes(window, {box.x0 + 2, last + kRow + 1, box.x1 - 2, box.y1 - 2}) ==
          0);  // no part of a row
  }
}

TEST_CASE("small windows: view says what a screenshot has no room for, and from which size on it has") {
  const Workplace here;
  const auto shot = [&](int height, const Arguments& more) {
    const Outcome outcome =
        here.run(Arguments{"view", "good.toml", "-r", "48x36", "--inspect", "20,20", "--size",
                           fmt::format("320x{}", height), "--screenshot", "a.png"} +
                 more);
    CHECK(outcome.code == 0);
    return outcome.err;
  };
  const std::string said = shot(240, {}), begin = "no room for the inspector at 320x240: shown from 320x";
  CAPTURE(said);
  CHECK(lines(said).size() == 1);
  REQUIRE(said.starts_with(begin));
  const int from = std::stoi(said.substr(begin.size()));
  CHECK(from > 240);
  CHECK(shot(from, {}).empty());
  CHECK(lines(shot(from - 1, {})).size() == 1);
  CHECK(shot(240, {"-q"}).empty());
}

#endif
