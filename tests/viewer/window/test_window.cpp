// SPDX-License-Identifier: MIT
// The real window, on a display that nobody sees (Xvfb), driven by real key and mouse events: what it shows is the
// picture that --screenshot draws off screen, pixel by pixel, and it follows what is done to it.
#include <doctest/doctest.h>

#include <map>
#include <string>

#include "common/picture/image_io.h"
#include "common/scene/toml.h"
#include "tests/support/program.h"
#include "tests/tier.h"
#include "viewer/window/window_panels.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// An X window dump (XWDFile.h): big-endian words, then colours of no use here, then rows of 32-bit BGRX.
Image8 read_dump(const std::string& path) {
  const std::string bytes = read_bytes(path);
  REQUIRE(bytes.size() > 100);
  const auto word = [&](std::size_t i) {
    std::size_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[4 * i + k]);
    return value;
  };
  const std::size_t header = word(0), width = word(4), height = word(5), row = word(12), colours = word(19);
  REQUIRE(word(11) == 32);
  REQUIRE(word(7) == 0);  // the bytes of a pixel: least significant first
  const std::size_t start = header + 12 * colours;
  REQUIRE(bytes.size() >= start + row * height);
  Image8 image{static_cast<int>(width), static_cast<int>(height), {}};
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      for (const std::size_t channel : {2, 1, 0})
        image.rgb.push_back(static_cast<std::uint8_t>(bytes[start + y * row + 4 * x + channel]));
  return image;
}

// Bytes that differ.
std::size_t difference(const Image8& a, const Image8& b) {
  REQUIRE(a.rgb.size() == b.rgb.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) count += a.rgb[i] != b.rgb[i] ? 1 : 0;
  return count;
}

Image8 read_screenshot(const std::string& path) {
  const ImageFile file = read_image(path);
  return to_image8(colors(file), file.width, file.height);
}

// Where the panels are in a window of this size that shows pictures of 160x120.
Layout panels_of(glm::ivec2 window) {
  WindowState state;
  Scene scene;
  scene.width = 160;
  scene.height = 120;
  state.scene = state.drawn = std::make_shared<const Scene>(scene);
  state.opened.times = false;
  return window_layout(state, window, 1).panels;
}

// The pixel of the left picture under the middle of the window's left half, where the script clicks.
glm::ivec2 clicked_pixel(glm::ivec2 window) {
  const Rect panel = panels_of(window).left;
  const View view = fit(View{}, {160, 120}, panel);
  const glm::dvec2 at(window.x / 4, window.y / 2);
  return glm::ivec2(glm::floor((at - picture_origin(view, panel)) / view.zoom));
}

}  // namespace

TEST_CASE("view: the real window shows what is drawn off screen, and follows keys, mouse and file") {
  if (test::tier() == "sanitized") return test::skip_test("the OpenGL driver leaks");
  const Workplace here;
  const std::string text = "title = 'A window'\n" + kGoodScene;  // else the path would be the title
  write_bytes(here / "scene.toml", text);
  write_bytes(here / "broken.toml", "[camera]\neye = 3\n");
  std::string edited = text;
  edited.replace(edited.find("diffuse = [1, 0, 0]"), 19, "diffuse = [0, 1, 0]");
  write_bytes(here / "edited.toml", edited);
  Process process({"xvfb-run", "-a", SIDELIGHT_SOURCE_DIR "/tests/viewer/window/open_window.sh",
                   SIDELIGHT_BINARY, here / "."},
                  here / ".");
  const Outcome outcome = process.wait();
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);

  std::map<std::string, Image8> shown;
  for (const char* step :
       {"open", "swipe", "causes", "inspect", "orbit", "reset", "error", "recovered", "zoomed"})
    shown[step] = read_dump(here / (std::string(step) + ".xwd"));
  const glm::ivec2 window(shown["open"].width, shown["open"].height);
  const std::string size = std::to_string(window.x) + "x" + std::to_string(window.y);

#ifdef SIDELIGHT_HAVE_OSMESA
  const auto off_screen = [&](const std::string& scene, const Arguments& flags) {
    const Outcome drawn = here.run(Arguments{"view", scene, "-q", "--no-times", "-r", "160x120", "--size",
                                             size, "--screenshot", "off.png"} +
                                   flags);
    CHECK(drawn.code == 0);
    return read_screenshot(here / "off.png");
  };
  write_bytes(here / "scene.toml", text);
  const glm::ivec2 pixel = clicked_pixel(window);
  const std::string at = std::to_string(pixel.x) + "," + std::to_string(pixel.y);
  CHECK(difference(shown["open"], off_screen("scene.toml", {})) == 0);
  CHECK(difference(shown["swipe"], off_screen("scene.toml", {"--mode", "swipe"})) == 0);
  CHECK(difference(shown["causes"], off_screen("scene.toml", {"--mode", "causes"})) == 0);
  CHECK(difference(shown["inspect"], off_screen("scene.toml", {"--inspect", at})) == 0);
#endif

  // Both pictures are there, and differ.
  const Layout layout = panels_of(window);
  const auto part = [&](const Image8& image, const Rect& box) {
    Image8 out{box.width(), box.height(), {}};
    for (int y = box.y0; y < box.y1; ++y) {
      const auto row = image.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * image.width + box.x0);
      out.rgb.insert(out.rgb.end(), row, row + 3 * box.width());
    }
    return out;
  };
  CHECK(difference(part(shown["open"], layout.left), part(shown["open"], layout.right)) > 1000);
  // Orbiting changes both, and reset takes it back.
  for (const Rect& box : {layout.left, layout.right})
    CHECK(difference(part(shown["open"], box), part(shown["orbit"], box)) > 1000);
  CHECK(difference(shown["open"], shown["reset"]) == 0);
  // The error covers a strip; the pictures under it stay. The edited scene is another one.
  const Rect below{layout.left.x0, (layout.left.y0 + layout.left.y1) / 2, layout.left.x1, layout.left.y1};
  CHECK(difference(part(shown["error"], below), part(shown["reset"], below)) == 0);
  CHECK(difference(shown["error"], shown["reset"]) > 1000);
  CHECK(difference(part(shown["recovered"], below), part(shown["reset"], below)) > 1000);
  CHECK(difference(shown["zoomed"], shown["recovered"]) > 1000);
}
