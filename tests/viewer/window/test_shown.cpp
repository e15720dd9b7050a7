// SPDX-License-Identifier: MIT
// What the window says of its pictures.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <set>

#include "tests/viewer/window/session.h"
#include "viewer/window/frames.h"
#include "viewer/window/offscreen.h"
#include "viewer/window/shown.h"
#include "viewer/window/window_panels.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("window: captions say what the pictures hold, and what they wait for") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  Pictures pictures = render_pictures(picture_task(state));
  CHECK(show(state, pictures, pictures).panels.at(1).caption.name == "ray tracer: shadows, mirrors, glass");
  auto local = std::make_shared<Scene>(*state.scene);
  local->trace.reflection = local->trace.refraction = false;
  state.scene = state.drawn = local;
  pictures = render_pictures(picture_task(state));
  CHECK(show(state, pictures, pictures).panels.at(1).caption.name == "ray tracer: shadows");
  local->trace.reflection = local->trace.refraction = true;
  local->trace.depth = 1;  // eye rays alone
  pictures = render_pictures(picture_task(state));
  CHECK(show(state, pictures, pictures).panels.at(1).caption.name == "ray tracer: shadows");
  local->trace.shadows = false;
  CHECK(show(state, pictures, pictures).panels.at(1).caption.name == "ray tracer: local light only");

  const Pictures finished = pictures;
  pictures.finished = false;
  state.mode = Mode::causes;
  CHECK(show(state, pictures, {}).panels.at(0).caption.name == "ray tracer: refining, then the causes");
  CHECK(show(state, pictures, finished).panels.at(0).caption.name ==
        "what made the difference (of the view before)");
  CHECK(show(state, finished, finished).panels.at(0).caption.name == "what made the difference");
}

TEST_CASE("window: in place the key shows the other picture") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  state.mode = Mode::flip;
  const Pictures pictures = render_pictures(picture_task(state));
  for (const bool flipped : {false, true}) {
    state.view.flipped = flipped;
    const Shown shown = show(state, pictures, pictures);
    REQUIRE(shown.panels.size() == 1);
    CHECK(shown.panels[0].of_left != flipped);
  }
  const ShownKey key = shown_key(state, pictures, pictures);
  state.view.flipped = false;
  CHECK_FALSE(key == shown_key(state, pictures, pictures));  // so it is drawn anew
}

TEST_CASE(
    "window: numbers are those of the pixel, in a part of the picture too, and times only where asked for") {
  const Workplace here;
  // Behind the triangles of a box no object has the number of its primitive.
  write_bytes(here / "box.toml",
              "[[mesh]]\nshape = 'box'\nsize = [1, 1, 1]\nmaterial = 'red'\n" + kGoodScene);
  WindowState state = open_state(here / "box.toml", opener(48, 36));
  state.opened.options.crop = {10, 8, 40, 30};
  CHECK(shown_part(state) == state.opened.options.crop);
  Pictures pictures = render_pictures(picture_task(state));
  std::size_t at = 30 * 22 - 1;  // the last that differs
  while (pictures.rastered->color[at] == pictures.traced->color[at]) --at;
  const glm::ivec2 pixel(10 + static_cast<int>(at % 30), 8 + static_cast<int>(at / 30));
  const auto lines_of = [](const glm::vec3& v) {
    return std::vector{fmt::format("{:.4f}", v.x), fmt::format("{:.4f}", v.y), fmt::format("{:.4f}", v.z)};
  };
  const auto panel = [&](Mode mode, std::size_t i) {
    state.mode = mode;
    return show(state, pictures, pictures).panels.at(i);
  };
  const glm::vec3 left = pictures.rastered->color[at], right = pictures.traced->color[at];
  CHECK(panel(Mode::side_by_side, 0).numbers(pixel) == lines_of(left));
  CHECK(panel(Mode::side_by_side, 1).numbers(pixel) == lines_of(right));
  CHECK(panel(Mode::side_by_side, 1).numbers({30, 30}).empty());
  CHECK(panel(Mode::difference, 0).numbers(pixel) == lines_of(right - left));
  CHECK(panel(Mode::object, 0).numbers(pixel) ==
        std::vector{fmt::format("{}", pictures.traced->object_id[at])});

  pictures.left.per_second = 3.14e6;
  CHECK(panel(Mode::side_by_side, 0).caption.times->rate == "3.1 M samples/s");
  state.opened.times = false;
  CHECK_FALSE(panel(Mode::side_by_side, 0).caption.times.has_value());

  state.slow = true;
  state.rows = 20;  // of the whole picture: 12 of the part
  const Image8 image = panel(Mode::side_by_side, 1).image;
  const std::vector<std::uint8_t> black(image.rgb.size() - 12 * 30 * 3);
  CHECK(std::equal(black.begin(), black.end(), image.rgb.begin() + 12 * 30 * 3));
  CHECK(std::any_of(image.rgb.begin(), image.rgb.begin() + 12 * 30 * 3, [](auto code) { return code != 0; }));

  pictures.block = 2;  // a coarse block's number is no pixel's
  CHECK(panel(Mode::side_by_side, 1).numbers(pixel).empty());
}

TEST_CASE("window: causes are told in percent") {
  Comparison comparison;
  comparison.width = 8;
  comparison.height = 5;
  comparison.reflection = {10, 0.125};
  CHECK(cause_lines(comparison).at(1) == "reflection: 25.0 % of pixels, mean 0.1250");
}

TEST_CASE("window: the records of the inspected pixel are those of the view") {
  const Open open;
  Session session(open_state(open.file, opener(48, 36)), opener(48, 36));
  session.inspect({20, 20});
  FrameContents contents;
  for (const char* key : {"1", "Left"}) {
    session.press(key, kPanel);
    session.worker().wait();
    contents.update(session);
    REQUIRE(contents.inspection());
    CHECK(contents.inspection()->samples[0].raytrace.origin == session.state().camera.eye);
  }
}

TEST_CASE("window: the inspector begins with the sample whose ids and rays are shown, and has them all") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  state.n = 3;
  state.inspected = glm::ivec2(20, 20);
  const std::optional<Inspection> inspection = inspect_pixel(state, render_pictures(picture_task(state)));
  REQUIRE(inspection);
  for (const Side side : {Side::raster, Side::raytrace}) {
    const std::string words = inspected_words(*inspection, side);
    CHECK(words.starts_with("sample 1,1, whose ids and rays are shown\n"));
    std::set<std::string> samples;
    for (const std::string& line : lines(words))
      if (line.starts_with("sample ")) samples.insert(line.substr(0, 10));
    CHECK(samples.size() == 9);
  }
  state.n = 1;
  const auto one = inspect_pixel(state, render_pictures(picture_task(state)));
  CHECK_FALSE(inspected_words(*one, Side::raster).starts_with("sample"));
}

TEST_CASE("window: faults on purpose are said in the smallest window") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  state.lesson = true;
  state.inspected = glm::ivec2(3, 4);
  const auto title = [&] { return window_layout(state, {320, 240}, 1).panels.title.height(); };
  CHECK(title() == 0);
  state.faults.tessellate = 8;
  CHECK(title() > 0);
}

TEST_CASE("window: the signed difference has its histogram, where there is room for it") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  const Pictures pictures = render_pictures(picture_task(state));
  state.mode = Mode::causes;
  CHECK_FALSE(show(state, pictures, pictures).histogram);
  state.mode = Mode::difference;
  CHECK_FALSE(show(state, pictures, {}).histogram);
  const Shown shown = show(state, pictures, pictures);
  REQUIRE(shown.histogram);
  CHECK(shown.histogram->darker() + shown.histogram->equal + shown.histogram->brighter() == 48 * 36);
  CHECK(shown.histogram->equal < 48 * 36);

  const auto legend_at = [&](glm::ivec2 size) { return window_layout(state, size, 1).legend.height(); };
  const int wide = legend_at({1300, 800}), narrow = legend_at({500, 800}), low = legend_at({1300, 260});
  CHECK(legend_height(state, 1300 - 48, 1) == wide);
  CHECK(wide > legend_height(state, 1300 - 48, 1, true));
  CHECK(narrow == legend_height(state, 500 - 48, 1, true));
  CHECK(low == legend_height(state, 1300 - 48, 1, true));
}

#ifdef SIDELIGHT_HAVE_OSMESA

TEST_CASE("window: under the causes the mismatches stand before what is unexplained") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  state.mode = Mode::causes;
  Pictures pictures = render_pictures(picture_task(state));
  const Comparison agreed = *pictures.comparison;
  // The leftmost column that changes with one of the counts.
  const auto column = [&](std::uint64_t Comparison::*number) {
    std::array<Image8, 2> shots;
    for (std::size_t k = 0; k < 2; ++k) {
      pictures.comparison = agreed;
      (*pictures.comparison).*number = k;
      shots[k] = screenshot(state, pictures, 1000, 700);
    }
    std::size_t least = 3000;
    for (std::size_t i = 0; i < shots[0].rgb.size(); ++i)
      if (shots[0].rgb[i] != shots[1].rgb[i]) least = std::min(least, i % 3000);
    return least;
  };
  CHECK(column(&Comparison::visibility_mismatches) < column(&Comparison::unexplained));
}

TEST_CASE("window: all colours of the difference's scale stand in one row, in their order") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  state.mode = Mode::difference;
  const Image8 window = screenshot(state, render_pictures(picture_task(state)), 1300, 800);
  int rows = 0;
  for (int y = 0; y < window.height; ++y) {
    std::size_t bin = 0;
    for (int x = 0; x < window.width && bin < DifferenceHistogram::kBins; ++x) {
      const std::uint8_t* const rgb = &window.rgb[3 * static_cast<std::size_t>(y * window.width + x)];
      const glm::vec3 color = signed_difference_color(DifferenceHistogram::middle(bin));
      bin += rgb[0] == encode_srgb8(color.x) && rgb[1] == encode_srgb8(color.y) &&
             rgb[2] == encode_srgb8(color.z);
    }
    rows += bin == DifferenceHistogram::kBins;
  }
  CHECK(rows >= 8);  // of its ten, whose first and last are its frame
}

TEST_CASE(
    "window: under the difference and the causes, too, the colours of the inspected pixel's rays are named") {
  const Workplace here;
  WindowState state = open_state(here / "good.toml", opener(48, 36));
  const Pictures pictures = render_pictures(picture_task(state));
  const auto rays_named = [&] {
    const Rect legend = window_layout(state, {1300, 800}, 1).legend;
    const Image8 window = screenshot(state, pictures, 1300, 800);
    int pixels = 0;
    for (int y = legend.y0; y < legend.y1; ++y)
      for (int x = legend.x0; x < legend.x1; ++x) {
        const std::uint8_t* const rgb = &window.rgb[3 * static_cast<std::size_t>(y * window.width + x)];
        for (const SegmentKind kind : {SegmentKind::light_seen, SegmentKind::light_blocked}) {
          const std::uint32_t color = segment_color(kind);  // red in the lowest byte
          pixels += rgb[0] == (color & 255) && rgb[1] == (color >> 8 & 255) && rgb[2] == (color >> 16 & 255);
        }
      }
    return pixels;
  };
  for (const Mode mode : {Mode::difference, Mode::causes}) {
    state.mode = mode;
    state.inspected.reset();
    CHECK(rays_named() == 0);
    state.inspected = glm::ivec2(24, 18);
    CHECK(rays_named() > 100);  // a square of some 17
  }
}

#endif
