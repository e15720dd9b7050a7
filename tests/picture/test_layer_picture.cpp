// SPDX-License-Identifier: MIT
#include "common/picture/layer_picture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "tests/picture/frames.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr Color8 kBlack{};

Color8 pixel(const Image8& image, std::size_t i) {
  return {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]};
}

// One row of pixels that holds one layer.
Frame row(int pixels, Layer layer) { return make_frame(pixels, 1, 1, options_with(layer_bit(layer))); }

double distance(const Color8& a, const Color8& b) { return std::hypot(a.r - b.r, a.g - b.g, a.b - b.b); }

// Of light, by Rec. 709.
double luminance(const Color8& c) {
  return 0.2126 * decode_srgb8(c.r) + 0.7152 * decode_srgb8(c.g) + 0.0722 * decode_srgb8(c.b);
}

}  // namespace

TEST_CASE("layer picture: every layer gives a picture of the frame's size, a crop's too") {
  RenderOptions options = options_with(kAllLayers);
  options.crop = {10, 20, 13, 25};
  Frame frame = make_frame(64, 48, 2, options);
  for (int i = 0; i < kLayers; ++i) {
    const Image8 image = layer_picture(frame, static_cast<Layer>(i));
    CHECK(image.width == 3);
    CHECK(image.height == 5);
    CHECK(image.rgb.size() == 3 * 15);
    // An empty scene: black everywhere, and no cost is the ramp's lower end.
    const bool cost = static_cast<Layer>(i) == Layer::cost;
    for (std::size_t p = 0; p < 15; ++p) CHECK(pixel(image, p) == (cost ? amount_color(0) : kBlack));
  }
}

TEST_CASE("layer picture: a layer of light is its sRGB picture") {
  for (const Layer layer : {Layer::ambient, Layer::diffuse, Layer::specular, Layer::shadow, Layer::reflection,
                            Layer::refraction}) {
    Frame frame = row(3, layer);
    frame.layer(layer) = {{0.25f, 0.5f, 2.0f}, {0, kNan, kInf}, {1, 0.001f, -1}};
    CHECK(layer_picture(frame, layer).rgb == to_image8(frame.layer(layer), 3, 1).rgb);
    CHECK(pixel(layer_picture(frame, layer), 0) == Color8{137, 188, 255});
  }
}

TEST_CASE("layer picture: depth runs in 1/z from white to dark grey, the background is black") {
  Frame frame = row(6, Layer::depth);
  // 1/z = 1, 1/2, 1/4 and 0: from the nearest (white) to the farthest (grey 0.2).
  frame.depth = {1, 2, 4, 0, kInf, kNan};
  const Image8 image = layer_picture(frame, Layer::depth);
  const auto grey = [](std::uint8_t g) { return Color8{g, g, g}; };
  CHECK(pixel(image, 0) == grey(255));
  CHECK(pixel(image, 1) == grey(153));  // 255 (0.2 + 0.8 / 2)
  CHECK(pixel(image, 2) == grey(102));  // 255 (0.2 + 0.8 / 4)
  CHECK(pixel(image, 3) == kBlack);
  CHECK(pixel(image, 4) == grey(51));  // 255 * 0.2
  CHECK(pixel(image, 5) == kBlack);

  frame.depth = {3, 3, 3, 0, 3, 3};  // one depth is the nearest
  CHECK(pixel(layer_picture(frame, Layer::depth), 0) == grey(255));
  CHECK(pixel(layer_picture(frame, Layer::depth), 3) == kBlack);
}

TEST_CASE("layer picture: a horizon leaves contrast to what stands before it") {
  Frame frame = row(3, Layer::depth);
  frame.depth = {5, 10, 1e15f};
  const Image8 image = layer_picture(frame, Layer::depth);
  CHECK(pixel(image, 0).r - pixel(image, 1).r > 90);
}

TEST_CASE("layer picture: ids of objects and primitives have the colour of their number") {
  for (const Layer layer : {Layer::object, Layer::primitive}) {
    Frame frame = row(4, layer);
    (layer == Layer::object ? frame.object_id : frame.primitive_id) = {0, 1, 4294967295u, 1};
    const Image8 image = layer_picture(frame, layer);
    CHECK(pixel(image, 0) == kBlack);
    CHECK(pixel(image, 1) == id_color(1));
    CHECK(pixel(image, 2) == id_color(4294967295u));
    CHECK(pixel(image, 3) == pixel(image, 1));
  }
}

TEST_CASE("layer picture: neighbouring ids differ clearly, and the first of them all from each other") {
  // Distances in the cube of codes, whose edge is 255: what a redesign should keep.
  double next = 1e9, next_but_one = 1e9, darkest = 1e9;
  for (std::uint32_t id = 1; id <= 100'000; ++id) {
    next = std::min(next, distance(id_color(id), id_color(id + 1)));
    next_but_one = std::min(next_but_one, distance(id_color(id), id_color(id + 2)));
    darkest = std::min(darkest, distance(id_color(id), kBlack));
  }
  CHECK(next > 150);
  CHECK(next_but_one > 80);
  CHECK(darkest > 150);

  double closest = 1e9;
  std::set<std::array<std::uint8_t, 3>> distinct;
  for (std::uint32_t a = 1; a <= 1000; ++a) {
    distinct.insert({id_color(a).r, id_color(a).g, id_color(a).b});
    for (std::uint32_t b = 1; b < a && a <= 64; ++b)
      closest = std::min(closest, distance(id_color(a), id_color(b)));
  }
  CHECK(closest > 15);
  CHECK(distinct.size() > 990);
}

TEST_CASE("layer picture: the colour of an id never changes") {
  CHECK(id_color(0) == kBlack);
  // Hue 3.708 sixths of the circle, 1.708 from green and 0.292 from blue; saturation 0.5, value 0.8: red
  // keeps half of 204, green 1 - 0.5 * 0.708, blue all of it.
  CHECK(id_color(1) == Color8{102, 132, 204});
}

TEST_CASE("layer picture: normals have the usual colours of a normal map") {
  Frame frame = row(5, Layer::normal);
  const float third = std::sqrt(1.0f / 3);
  frame.normal = {{0, 0, 1}, {-1, 0, 0}, {0, 0, 0}, {third, third, -third}, {0, kNan, 1}};
  const Image8 image = layer_picture(frame, Layer::normal);
  CHECK(pixel(image, 0) == Color8{128, 128, 255});
  CHECK(pixel(image, 1) == Color8{0, 128, 128});
  CHECK(pixel(image, 2) == kBlack);
  CHECK(pixel(image, 3) == Color8{201, 201, 54});  // 127.5 (1 + 0.57735) and 127.5 (1 - 0.57735)
  CHECK(pixel(image, 4) == Color8{128, 0, 255});
}

TEST_CASE("layer picture: cost runs from 0 to the frame's greatest") {
  Frame frame = row(3, Layer::cost);
  frame.cost = {0, 10, 40};
  const Image8 image = layer_picture(frame, Layer::cost);
  CHECK(pixel(image, 0) == amount_color(0));
  CHECK(pixel(image, 1) == amount_color(0.25));
  CHECK(pixel(image, 2) == amount_color(1));
}

TEST_CASE("layer picture: amounts grow lighter, step by step, from blue to yellow") {
  for (int i = 1; i <= 64; ++i)
    CHECK(luminance(amount_color(i / 64.0)) > luminance(amount_color((i - 1) / 64.0)));
  // To the eye lightness goes about with the cube root of luminance. (About: 15 %, of which 3 % are the
  // rounding of the darkest steps to codes; Oklab's own lightness, which is exactly even, is made of three
  // cube roots.)
  const auto lightness = [](double amount) { return std::cbrt(luminance(amount_color(amount))); };
  const double mean = (lightness(1) - lightness(0)) / 16;
  for (int i = 1; i <= 16; ++i)
    CHECK(std::abs(lightness(i / 16.0) - lightness((i - 1) / 16.0) - mean) < 0.15 * mean);
  CHECK(amount_color(0) == Color8{8, 28, 81});
  CHECK(amount_color(1) == Color8{247, 233, 84});
  CHECK(amount_color(-3) == amount_color(0));
  CHECK(amount_color(7) == amount_color(1));
  CHECK(amount_color(std::numeric_limits<double>::quiet_NaN()) == amount_color(0));
}
