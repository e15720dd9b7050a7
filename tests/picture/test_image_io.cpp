// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>

#include "common/error.h"
#include "common/picture/image_io.h"
#include "tests/picture/folder.h"
#include "tests/picture/frames.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Equal in every bit, NaN and -0 included.
bool same_bits(std::span<const float> a, std::span<const float> b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) {
           return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
         });
}

std::vector<float> component(std::span<const glm::vec3> values, int axis) {
  std::vector<float> out;
  for (const glm::vec3& value : values) out.push_back(value[axis]);
  return out;
}

void check_rgb(const ImageFile& image, const std::string& prefix, const std::string& axes,
               std::span<const glm::vec3> expected) {
  for (int i = 0; i < 3; ++i) {
    const std::string name = prefix + axes[static_cast<std::size_t>(i)];
    CAPTURE(name);
    REQUIRE(image.channels.contains(name));
    CHECK(same_bits(image.channels.at(name), component(expected, i)));
  }
}

void check_everything(const ImageFile& image, const Frame& frame) {
  CHECK(image.width == frame.width());
  CHECK(image.height == frame.height());
  CHECK(image.x0 == frame.window.x0);
  CHECK(image.y0 == frame.window.y0);
  CHECK(image.full_width == frame.full_width);
  CHECK(image.full_height == frame.full_height);
  CHECK_FALSE(image.png);
  CHECK(image.channels.size() == 3 + 6 * 3 + 1 + 3 + 1);
  CHECK(image.ids.size() == 2);
  check_rgb(image, "", "RGB", frame.color);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) {
    check_rgb(image, std::string(kLayerNames[i]) + ".", "RGB", frame.rgb[i]);
  }
  check_rgb(image, "normal.", "XYZ", frame.normal);
  CHECK(same_bits(image.channels.at("depth.Z"), frame.depth));
  CHECK(same_bits(image.channels.at("cost.tests"), frame.cost));
  CHECK(std::ranges::equal(image.ids.at("object.id"), frame.object_id));
  CHECK(std::ranges::equal(image.ids.at("primitive.id"), frame.primitive_id));
}

Frame noisy_frame(int width, int height, const Rect& crop = {}) {
  RenderOptions options = options_with(kAllLayers);
  options.crop = crop;
  Frame frame = make_frame(width, height, 1, options);
  fill_with_noise(frame, 1);
  // The values that a conversion would lose.
  frame.object_id[0] = std::numeric_limits<std::uint32_t>::max();
  frame.object_id[1] = 7;
  frame.primitive_id[0] = std::numeric_limits<std::uint32_t>::max() - 1;
  frame.primitive_id[1] = 0x80000001u;
  frame.color[0] = {-0.0f, std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max()};
  frame.color[1] = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 1e30f};
  return frame;
}

}  // namespace

TEST_CASE("EXR: every layer comes back in every bit") {
  const TemporaryFolder folder;
  const Frame frame = noisy_frame(37, 150);  // more rows than are packed at once
  write_exr(folder / "a.exr", frame);
  check_everything(read_image(folder / "a.exr"), frame);
  CHECK(folder.count() == 1);
}

TEST_CASE("EXR: a crop keeps its place in the picture") {
  const TemporaryFolder folder;
  for (const Rect& crop : {Rect{100, 50, 117, 131}, Rect{0, 0, 2, 1}, Rect{638, 479, 640, 480}}) {
    const Frame frame = noisy_frame(640, 480, crop);
    write_exr(folder / "crop.exr", frame);
    check_everything(read_image(folder / "crop.exr"), frame);
  }
}

TEST_CASE("EXR: only the layers that the frame holds") {
  const TemporaryFolder folder;
  Frame frame = make_frame(3, 2, 1, options_with(layer_bit(Layer::shadow) | layer_bit(Layer::object)));
  write_exr(folder / "a.exr", frame);
  ImageFile image = read_image(folder / "a.exr");
  CHECK(image.channels.size() == 6);
  CHECK(image.channels.contains("shadow.G"));
  CHECK(image.ids.size() == 1);
  CHECK(image.ids.contains("object.id"));

  write_exr(folder / "b.exr", make_frame(1, 1, 1, {}));
  image = read_image(folder / "b.exr");
  CHECK(image.channels.size() == 3);
  CHECK(image.ids.empty());
}

TEST_CASE("metadata comes back, and the same frame gives the same bytes") {
  const TemporaryFolder folder;
  const Metadata metadata{{"scene", "scenes/mirror \xC3\xA9.toml"},
                          {"settings", "depth = 6\nshadows = true"},
                          {"a_name_that_is_longer_than_thirty_one_characters", "x"},
                          {"empty", ""}};
  std::map<std::string, std::string> expected(metadata.begin(), metadata.end());
  expected.erase("empty");
  const Frame frame = noisy_frame(40, 30);
  const Image8 image8 = to_image8(frame.color, 40, 30);

  write_exr(folder / "a.exr", frame, metadata);
  write_exr(folder / "b.exr", frame, metadata);
  CHECK(read_image(folder / "a.exr").metadata == expected);
  CHECK(read_bytes(folder / "a.exr") == read_bytes(folder / "b.exr"));
  write_png(folder / "a.png", image8, metadata);
  write_png(folder / "b.png", image8, metadata);
  CHECK(read_image(folder / "a.png").metadata == expected);
  CHECK(read_bytes(folder / "a.png") == read_bytes(folder / "b.png"));

  write_exr(folder / "plain.exr", frame);
  CHECK(read_image(folder / "plain.exr").metadata.empty());
}

TEST_CASE("PNG of 8 bits: all codes come back as linear values") {
  const TemporaryFolder folder;
  Image8 image{16, 16, {}};
  for (int code = 0; code < 256; ++code) {
    const auto byte = static_cast<std::uint8_t>(code);
    image.rgb.insert(image.rgb.end(), {byte, static_cast<std::uint8_t>(255 - byte), 0});
  }
  write_png(folder / "codes.png", image);
  const std::vector<std::uint8_t> in_memory = encode_png(image);
  CHECK(std::string(in_memory.begin(), in_memory.end()) == read_bytes(folder / "codes.png"));
  const ImageFile file = read_image(folder / "codes.png");
  CHECK(file.png);
  CHECK(file.width == 16);
  CHECK(file.full_width == 16);
  CHECK(file.x0 == 0);
  CHECK(file.ids.empty());
  REQUIRE(file.channels.size() == 3);
  for (std::size_t i = 0; i < 256; ++i) {
    CHECK(file.channels.at("R")[i] == decode_srgb8(static_cast<std::uint8_t>(i)));
    CHECK(file.channels.at("G")[i] == decode_srgb8(static_cast<std::uint8_t>(255 - i)));
    CHECK(file.channels.at("B")[i] == 0);
  }
}

TEST_CASE("PNG of 16 bits is linear, clamped, rounded half up, and read as linear") {
  const TemporaryFolder folder;
  Frame frame = make_frame(3, 1, 1, {});
  const float half_step = 0.5f / 65535;
  frame.color = {{0, 0.5f, 1},
                 {-1, 1e30f, std::numeric_limits<float>::quiet_NaN()},
                 {half_step * 0.999f, half_step * 1.001f, 0.25f}};
  write_png_linear16(folder / "a.png", frame, {{"scene", "x"}});
  const ImageFile file = read_image(folder / "a.png");
  CHECK(file.png);
  const auto step = [](int value) { return static_cast<float>(value / 65535.0); };
  CHECK(file.channels.at("R") == std::vector<float>{0, 0, 0});
  CHECK(file.channels.at("G") == std::vector<float>{step(32768), 1, step(1)});
  CHECK(file.channels.at("B") == std::vector<float>{1, 0, step(16384)});
  CHECK(file.metadata.at("encoding") == "linear");
  CHECK(file.metadata.at("scene") == "x");
}

// Other programs say so by a gAMA chunk of 1 and no words of ours.
TEST_CASE("PNG whose gamma is 1 is linear") {
  const TemporaryFolder folder;
  Frame frame = make_frame(1, 1, 1, {});
  frame.color = {{0.25f, 0.5f, 1}};
  write_png_linear16(folder / "ours.png", frame);
  std::ifstream ours(folder / "ours.png", std::ios::binary);
  std::string png(std::istreambuf_iterator<char>(ours), {});
  const auto byte = [&](std::size_t i) { return std::size_t{static_cast<std::uint8_t>(png[i])}; };
  bool has_gamma = false;
  for (std::size_t at = 8; at < png.size();) {  // after the signature: length, name, data, checksum
    const std::size_t size = 12 + (byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3));
    const std::string name = png.substr(at + 4, 4);
    has_gamma |= name == "gAMA";
    if (name == "tEXt" || name == "iTXt" || name == "zTXt")
      png.erase(at, size);
    else
      at += size;
  }
  REQUIRE(has_gamma);
  std::ofstream(folder / "theirs.png", std::ios::binary) << png;
  const ImageFile file = read_image(folder / "theirs.png");
  CHECK(file.metadata.empty());
  CHECK(file.channels.at("R")[0] == static_cast<float>(16384 / 65535.0));
  CHECK(file.channels.at("G")[0] == static_cast<float>(32768 / 65535.0));
}

TEST_CASE("PNG of a crop holds the crop") {
  const TemporaryFolder folder;
  const Frame frame = noisy_frame(640, 480, {100, 50, 110, 53});
  write_png_linear16(folder / "a.png", frame);
  const ImageFile file = read_image(folder / "a.png");
  CHECK(file.width == 10);
  CHECK(file.height == 3);
  CHECK(file.x0 == 0);
  CHECK(file.full_width == 10);
}

TEST_CASE("the name decides nothing when reading: content does") {
  const TemporaryFolder folder;
  const Frame frame = noisy_frame(5, 4);
  write_exr(folder / "exr.png", frame);
  check_everything(read_image(folder / "exr.png"), frame);
  write_png(folder / "picture", to_image8(frame.color, 5, 4));
  CHECK(read_image(folder / "picture").png);
}

TEST_CASE("a picture that cannot be written leaves nothing behind and names its path") {
  const TemporaryFolder folder;
  const Frame frame = noisy_frame(5, 4);
  const Image8 image8 = to_image8(frame.color, 5, 4);
  write_text_file(folder / "plain", "a file, not a folder");
  make_folder(folder / "there.exr");
  for (const std::string& path : {folder / "no/such/folder.exr", folder / "plain/a.exr", folder / "there.exr",
                                  std::string("/dev/full")}) {
    CAPTURE(path);
    const auto names_path = [&](auto write) {
      try {
        write();
      } catch (const OutputError& error) {
        return std::string(error.what()).starts_with(path + ": ");
      }
      return false;
    };
    CHECK(names_path([&] { write_exr(path, frame); }));
    CHECK(names_path([&] { write_png(path, image8); }));
    CHECK(names_path([&] { write_png_linear16(path, frame); }));
  }
  CHECK(folder.count() == 2);
}
