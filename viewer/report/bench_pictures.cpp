// SPDX-License-Identifier: MIT
#include "viewer/report/bench_pictures.h"

#include <algorithm>

#include "viewer/report/embedded_picture.h"

namespace sidelight {
namespace {

bool same(const Image8& a, const Image8& b) {
  return a.width == b.width && a.height == b.height && a.rgb == b.rgb;
}

// The first point of the scene whose picture by `member` is that of point i.
std::size_t first_with(const BenchResult& result, std::size_t i, Image8 BenchPoint::*member) {
  for (std::size_t k = 0; k < i; ++k)
    if (result.points[k].scene == result.points[i].scene &&
        same(result.points[k].*member, result.points[i].*member))
      return k;
  return i;
}

std::size_t embedded_size(const Image8& image) { return (encode_png(image).size() + 2) / 3 * 4; }

// All of them reduced by the factor; the size they come to, or more than kMostEmbedded as soon as that is sure.
std::size_t embed(const BenchResult& result, int factor, BenchPictures& out) {
  std::size_t size = 0;
  const auto add = [&](const Image8& image) {
    if (image.rgb.empty() || size > kMostEmbedded) return Image8{};
    Image8 small = reduced(image, factor);
    size += embedded_size(small);
    return small;
  };
  out.reduction = factor;
  out.references.clear();
  for (const BenchScene& scene : result.scenes) out.references.push_back(add(scene.reference.picture));
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    BenchPictures::Entry& entry = out.points[i];
    if (entry.picture_as == i) entry.picture = add(result.points[i].picture);
    if (entry.difference_as == i) entry.difference = add(result.points[i].difference);
  }
  return size;
}

}  // namespace

Image8 reduced(const Image8& image, int factor) {
  if (factor == 1) return image;
  const std::vector<std::uint8_t>& rgb = image.rgb;
  std::vector<glm::vec3> linear;
  for (std::size_t i = 0; i < rgb.size(); i += 3)
    linear.emplace_back(decode_srgb8(rgb[i]), decode_srgb8(rgb[i + 1]), decode_srgb8(rgb[i + 2]));
  return reduced(linear, image.width, image.height, factor);
}

BenchPictures bench_pictures(const BenchResult& result) {
  BenchPictures out;
  out.points.resize(result.points.size());
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    out.points[i].picture_as = first_with(result, i, &BenchPoint::picture);
    out.points[i].difference_as = first_with(result, i, &BenchPoint::difference);
  }
  // A picture of one pixel is as small as it gets.
  int largest = 1;
  for (const BenchScene& scene : result.scenes) largest = std::max({largest, scene.width, scene.height});
  int factor = 1;
  while (embed(result, factor, out) > kMostEmbedded && factor < largest) ++factor;
  return out;
}

}  // namespace sidelight
