// SPDX-License-Identifier: MIT
// The comparison as drawn off screen, pixel by pixel, and the arithmetic of zoom, pan and layout behind it. The
// window itself is tried by hand under Xvfb; it draws by the same function.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/error.h"
#include "viewer/window/offscreen.h"
#include "viewer/window/view.h"
#include "viewer/window/window_panels.h"

using namespace sidelight;

namespace {

// A picture in which every byte is likely to differ from its neighbours.
Image8 noise(int width, int height, std::uint32_t seed) {
  Image8 image{width, height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::uint8_t& byte : image.rgb) {
    seed = seed * 1664525u + 1013904223u;
    byte = static_cast<std::uint8_t>(seed >> 24);
  }
  return image;
}

Image8 cropped(const Image8& image, const Rect& box) {
  Image8 part{box.width(), box.height(), {}};
  for (int y = box.y0; y < box.y1; ++y) {
    const auto row = image.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * image.width + box.x0);
    part.rgb.insert(part.rgb.end(), row, row + 3 * box.width());
  }
  return part;
}

// Pixels in the box that are brighter than the page and frame are: text.
[[maybe_unused]] int ink(const Image8& image, const Rect& box) {
  const Image8 part = cropped(image, box);
  return static_cast<int>(
      std::count_if(part.rgb.begin(), part.rgb.end(), [](int byte) { return byte > 130; }));
}

[[maybe_unused]] Labels labels_with(const std::string& title, bool times) {
  Labels labels;
  labels.title = title;
  if (times) {
    labels.left.times = Times{0.03, 4.27};
    labels.right.times = Times{12.4, 183.9};
  }
  return labels;
}

}  // namespace

TEST_CASE("zoom climbs whole steps, and down to the whole picture") {
  const glm::ivec2 picture(640, 480);
  const Rect small{0, 0, 320, 400}, large{10, 20, 1500, 1300};
  CHECK(fit({}, picture, small).zoom == 0.5);
  CHECK(fit({}, picture, large).zoom == 2);
  CHECK(fit({}, {1, 1}, large).zoom == kMaxZoom);
  CHECK(fit({}, picture, Rect{}).zoom > 0);

  View view = fit({}, picture, small);
  std::vector<double> zooms;
  for (int i = 0; i < 14; ++i) {
    view = zoom_about(view, picture, small, {100, 100}, 1);
    zooms.push_back(view.zoom);
  }
  CHECK(zooms == std::vector<double>{1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 64, 64});
  CHECK_FALSE(view.fitted);
  view = zoom_about(view, picture, small, {100, 100}, -20);
  CHECK(view.zoom == 0.5);
  CHECK(view.fitted);
  CHECK(zoom_about(fit({}, picture, large), picture, large, {99, 99}, -5).zoom == 1);
  view = {.zoom = 0.25, .center = {320, 240}};  // of a smaller panel: out is not in
  CHECK(zoom_about(view, picture, small, {100, 100}, -1).zoom == 0.25);
}

TEST_CASE("the picture point under the cursor stays there") {
  const glm::ivec2 picture(641, 479);
  const Rect panel{24, 90, 24 + 642, 90 + 482};  // not the picture's parity: half a pixel to lose
  const glm::dvec2 cursor(200.5, 400.5);
  View view = fit({}, picture, panel);
  const glm::dvec2 point = (cursor - picture_origin(view, panel)) / view.zoom;
  for (int i = 0; i < 11; ++i) {
    view = zoom_about(view, picture, panel, cursor, 1);
    const glm::dvec2 now = (cursor - picture_origin(view, panel)) / view.zoom;
    CHECK(std::abs(now.x - point.x) * view.zoom <= 0.5001);
    CHECK(std::abs(now.y - point.y) * view.zoom <= 0.5001);
  }
}

TEST_CASE("panning stops at the picture's edges") {
  const glm::ivec2 picture(100, 80);
  const Rect panel{0, 0, 100, 80};
  const View zoomed = zoom_about({.zoom = 1, .center = {50, 40}}, picture, panel, {50, 40}, 1);
  CHECK(picture_origin(pan(zoomed, picture, panel, {1e9, 1e9}), panel) == glm::dvec2(0));
  CHECK(picture_origin(pan(zoomed, picture, panel, {-1e9, -1e9}), panel) == glm::dvec2(-100, -80));
  CHECK(picture_origin(pan(zoomed, picture, panel, {7, -3}), panel) == glm::dvec2(-43, -43));
  CHECK(pan(fit({}, picture, panel), picture, panel, {9, 9}).center == glm::dvec2(50, 40));

  // A larger panel: a fitted view fits again, another keeps its zoom and fills the panel as far as it can.
  const Rect larger{0, 0, 250, 300};
  CHECK(clamp(fit({}, picture, panel), picture, larger).zoom == 2);
  CHECK(clamp(zoomed, picture, larger).zoom == 2);
  CHECK(picture_origin(clamp(zoomed, picture, larger), larger) == glm::dvec2(25, 70));
}

TEST_CASE("a layout made for a panel size has panels of that size") {
  for (const double scale : {1.0, 1.5, 2.0})
    for (const bool with : {false, true}) {
      const LayoutOptions options{scale, with, with, with};
      const glm::ivec2 panel(431, 77), size = layout_size(panel, options);
      const Layout layout = make_layout(size, options);
      for (const Rect& box : {layout.left, layout.right}) {
        CHECK(box.width() == panel.x);
        CHECK(box.height() == panel.y);
        CHECK(box.x1 < size.x);
        CHECK(box.y1 < size.y);
      }
      CHECK(layout.left.x1 < layout.right.x0);
      CHECK(layout.left.y0 >= layout.left_times.y1);
    }
  // Captions follow a small picture's corner, down as far as it lies, right while they keep their room.
  const Layout wide = make_layout({1900, 1000}, {}), moved = with_captions_at(wide, {50, 200}, 1);
  CHECK(moved.left_caption.x0 == wide.left_caption.x0 + 50);
  CHECK(moved.right_times.y1 == wide.right_times.y1 + 200);
  CHECK(with_captions_at(wide, {900, 0}, 1).right_caption.width() == panel_for({1, 1}, {}).x);
  CHECK(moved.left == wide.left);

  const Layout none = make_layout({3, 3}, {});
  CHECK(none.left.width() == 0);
  CHECK(none.left.height() == 0);
}

TEST_CASE("pictures that differ in size are refused") {
  CHECK_THROWS_AS(side_by_side(noise(4, 4, 1), noise(4, 5, 2), {}), std::invalid_argument);
  CHECK_THROWS_AS(side_by_side({}, {}, {}), std::invalid_argument);
}

#ifdef SIDELIGHT_HAVE_OSMESA

namespace {

// A frame that is shown as these bytes.
std::shared_ptr<const Frame> frame_of(const Image8& image) {
  auto frame = std::make_shared<Frame>(make_frame(image.width, image.height, 1, {}));
  for (std::size_t i = 0; i < frame->color.size(); ++i)
    for (int c = 0; c < 3; ++c)
      frame->color[i][c] = decode_srgb8(image.rgb[3 * i + static_cast<std::size_t>(c)]);
  return frame;
}

// A window's state that shows pictures of this size, and the window with the two in it.
WindowState state_of(glm::ivec2 size) {
  WindowState state;
  Scene scene;
  scene.width = size.x;
  scene.height = size.y;
  state.scene = state.drawn = std::make_shared<const Scene>(scene);
  state.opened.times = false;
  return state;
}
Image8 window_with(const Image8& left, const Image8& right, int width, int height) {
  const WindowState state = state_of({left.width, left.height});
  Pictures pictures;
  pictures.task = picture_task(state);
  pictures.rastered = frame_of(left);
  pictures.traced = frame_of(right);
  pictures.block = 1;
  pictures.finished = true;
  return screenshot(state, pictures, width, height);
}
Rect window_panel(glm::ivec2 picture, glm::ivec2 size, bool right) {
  const Layout layout = window_layout(state_of(picture), size, 1).panels;
  return right ? layout.right : layout.left;
}

// Where side_by_side puts a picture of this size within its panel.
Rect picture_box(const Rect& panel, glm::ivec2 picture) {
  const glm::ivec2 corner(picture_origin(fit(View{}, picture, panel), panel));
  return {corner.x, corner.y, corner.x + picture.x, corner.y + picture.y};
}

}  // namespace

TEST_CASE("the pictures' bytes come through unchanged") {
  for (const glm::ivec2& size : {glm::ivec2(1, 1), {3, 5}, {37, 21}, {641, 479}, {1023, 64}}) {
    const Image8 left = noise(size.x, size.y, 1), right = noise(size.x, size.y, 2);
    const Labels labels = labels_with("Odd sizes", true);
    const Image8 both = side_by_side(left, right, labels);
    const Layout layout = make_layout({both.width, both.height}, layout_options(labels));
    CAPTURE(size.x);
    CHECK(cropped(both, picture_box(layout.left, size)).rgb == left.rgb);
    CHECK(cropped(both, picture_box(layout.right, size)).rgb == right.rgb);
  }
}

TEST_CASE("at a whole zoom every byte is a copy") {
  const Image8 left = noise(64, 48, 1), right = noise(64, 48, 2);
  const Image8 shot = window_with(left, right, 500, 400);
  const Rect panel = window_panel({64, 48}, {500, 400}, true);
  const View view = fit({}, {64, 48}, panel);
  REQUIRE(view.zoom == 3);
  const glm::ivec2 corner(picture_origin(view, panel));
  const Image8 part = cropped(shot, {corner.x, corner.y, corner.x + 3 * 64, corner.y + 3 * 48});
  Image8 expected{part.width, part.height, {}};
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) {
      const Image8 pixel = cropped(right, {x / 3, y / 3, x / 3 + 1, y / 3 + 1});
      expected.rgb.insert(expected.rgb.end(), pixel.rgb.begin(), pixel.rgb.end());
    }
  CHECK(part.rgb == expected.rgb);
}

TEST_CASE("a picture shown smaller keeps its mean") {
  const Image8 grey = noise(640, 480, 7);
  const Image8 shot = window_with(grey, grey, 500, 400);
  const Rect panel = window_panel({640, 480}, {500, 400}, false);
  const glm::ivec2 middle((panel.x0 + panel.x1) / 2, (panel.y0 + panel.y1) / 2);
  const Image8 part = cropped(shot, {middle.x - 40, middle.y - 40, middle.x + 40, middle.y + 40});
  double sum = 0, largest = 0;
  for (const double byte : part.rgb) sum += byte, largest = std::max(largest, byte);
  CHECK(sum / static_cast<double>(part.rgb.size()) == doctest::Approx(127.5).epsilon(0.03));
  CHECK(largest < 240);  // smoothed, not picked: noise itself reaches 255
}

TEST_CASE("title, captions and times leave ink in their lines, and only what is given") {
  const Image8 picture{400, 100, std::vector<std::uint8_t>(3 * 400 * 100, 0)};
  const Labels labels = labels_with("Mirror and glass \u03B7 \u2264 \u2014", true);
  const LayoutOptions options = layout_options(labels);
  const glm::ivec2 size = layout_size(panel_for({400, 100}, options), options);
  const Layout layout = make_layout(size, options);
  const Image8 both = side_by_side(picture, picture, labels);
  REQUIRE(both.width == size.x);
  REQUIRE(both.height == size.y);
  for (const Rect& line :
       {layout.title, layout.left_caption, layout.right_caption, layout.left_times, layout.right_times})
    CHECK(ink(both, line) > 200);
  CHECK(ink(both, {0, layout.left.y0, size.x, size.y}) == 0);
  CHECK(ink(both, {0, 0, size.x, layout.title.y0}) == 0);

  CHECK(side_by_side(picture, picture, labels_with("", false)).height <
        side_by_side(picture, picture, labels_with("t", false)).height);
  CHECK(side_by_side(picture, picture, labels_with("t", false)).height < both.height);
}

TEST_CASE("a hostile title does no harm") {
  const Image8 left = noise(80, 60, 1), right = noise(80, 60, 2);
  const std::string nul("a\0b", 3);
  for (const std::string& title :
       {std::string("\x1B[2J\r\n\t\x07%s%n%n##id###x"), std::string("\xFF\xFE\xC3\x28"), nul,
        std::string(100000, 'W'), std::string("\u202E\uFFFF\U0001F600")}) {
    Labels labels = labels_with(title, true);
    labels.left.name = title;
    const Image8 both = side_by_side(left, right, labels);
    const Layout layout = make_layout({both.width, both.height}, layout_options(labels));
    CHECK(cropped(both, picture_box(layout.left, {80, 60})).rgb == left.rgb);
    CHECK(cropped(both, picture_box(layout.right, {80, 60})).rgb == right.rgb);
    CHECK(ink(both, {layout.title.x1, 0, both.width, both.height}) == 0);  // nothing runs off the line
    CHECK(ink(both, {layout.left_caption.x1, layout.title.y1, layout.right_caption.x0, layout.left.y0}) == 0);
  }
}

TEST_CASE("two draws give the same bytes, also after another and at the same time") {
  const Image8 left = noise(101, 67, 1), right = noise(101, 67, 2);
  const Labels labels = labels_with("Twice", true);
  const Image8 first = side_by_side(left, right, labels);
  window_with(right, left, 333, 222);
  CHECK(side_by_side(left, right, labels).rgb == first.rgb);
  CHECK(side_by_side(right, left, labels).rgb != first.rgb);

  std::vector<std::uint8_t> other;
  std::thread thread([&] { other = side_by_side(left, right, labels).rgb; });
  CHECK(side_by_side(left, right, labels).rgb == first.rgb);
  thread.join();
  CHECK(other == first.rgb);
}

TEST_CASE("what cannot be drawn is refused by name, and what draw throws passes through") {
  CHECK_THROWS_AS(draw_offscreen(0, 5, [](Canvas&) {}), UsageError);
  CHECK_THROWS_AS(draw_offscreen(20000, 5, [](Canvas&) {}), UsageError);
  CHECK_THROWS_AS(draw_offscreen(5, 5, [](Canvas&) { throw std::out_of_range("x"); }), std::out_of_range);
  CHECK_NOTHROW(window_with(noise(9, 9, 1), noise(9, 9, 2), 1, 1));
}

#else

TEST_CASE("a build without OSMesa says so") {
  CHECK_THROWS_AS(side_by_side(noise(4, 4, 1), noise(4, 4, 2), {}), UsageError);
}

#endif
