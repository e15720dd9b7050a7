// SPDX-License-Identifier: MIT
#include "viewer/commands/picture_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "common/error.h"
#include "common/picture/image_io.h"
#include "common/picture/srgb.h"

namespace sidelight {
namespace {

template <class Map>
typename Map::mapped_type take(Map& channels, const char* name) {
  const auto at = channels.find(name);
  return at == channels.end() ? typename Map::mapped_type() : std::move(at->second);
}

std::string size_text(const Picture& picture) {
  const Rect& part = picture.window;
  const std::string whole = fmt::format("{}x{}", picture.full_width, picture.full_height);
  const bool is_whole = part == Rect{0, 0, picture.full_width, picture.full_height};
  return is_whole ? whole
                  : fmt::format("{}x{} at {},{} of {}", part.width(), part.height(), part.x0, part.y0, whole);
}

void check_match(const Picture& a, const Picture& b) {
  const bool same_size = a.window.width() == b.window.width() && a.window.height() == b.window.height();
  const bool same_place =
      a.window == b.window && a.full_width == b.full_width && a.full_height == b.full_height;
  if (!same_size || !(same_place || a.png || b.png))
    throw PicturesDoNotMatch(
        fmt::format("sizes differ: {} is {}, {} is {}", a.name, size_text(a), b.name, size_text(b)));
  if (a.alpha.empty() != b.alpha.empty())
    throw PicturesDoNotMatch(fmt::format("channels differ: {} has alpha, {} has not",
                                         (a.alpha.empty() ? b : a).name, (a.alpha.empty() ? a : b).name));
}

// Through 8 bits and back by `decode`, save what is not finite: 8 bits would hide it.
glm::vec3 through_8_bits(const glm::vec3& linear, float (*decode)(std::uint8_t)) {
  const auto each = [&](float v) { return std::isfinite(v) ? decode(encode_srgb8(v)) : v; };
  return {each(linear.x), each(linear.y), each(linear.z)};
}

template <class T>
std::optional<std::uint64_t> count_different(const std::vector<T>& a, const std::vector<T>& b) {
  if (a.empty() || b.empty()) return {};
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) ++count;
  return count;
}

std::optional<double> percent_covered_over(const PicturePair& pair, const Tolerance& tolerance) {
  const std::vector<std::uint32_t>&in_a = pair.a.object_id, &in_b = pair.b.object_id;
  if (in_a.empty() && in_b.empty()) return {};
  std::vector<double> covered;
  for (std::size_t i = 0; i < pair.differences.size(); ++i)
    if ((!in_a.empty() && in_a[i] != 0) || (!in_b.empty() && in_b[i] != 0))
      covered.push_back(pair.differences[i]);
  return count_excess(covered, tolerance).percent_over();
}

// The name of the first channel of pixel i that is not finite; empty if all are.
std::string bad_channel(const Picture& picture, std::size_t i) {
  constexpr std::array<const char*, 3> kNames{"R", "G", "B"};
  for (int c = 0; c < 3; ++c)
    if (!std::isfinite(picture.color[i][c])) return kNames[static_cast<std::size_t>(c)];
  return !picture.alpha.empty() && !std::isfinite(picture.alpha[i]) ? "A" : "";
}

}  // namespace

Picture read_picture(const std::string& path) {
  ImageFile file = read_image(path);
  Picture picture;
  picture.name = printable(path, 1000);
  picture.png = file.png;
  picture.full_width = file.full_width;
  picture.full_height = file.full_height;
  picture.window = {file.x0, file.y0, file.x0 + file.width, file.y0 + file.height};
  picture.color = colors(file);
  picture.alpha = take(file.channels, "A");
  picture.depth = take(file.channels, "depth.Z");
  picture.object_id = take(file.ids, "object.id");
  picture.primitive_id = take(file.ids, "primitive.id");
  return picture;
}

Picture picture_of(const Frame& frame, const std::string& name) {
  const auto copied = [](const auto& array) { return std::vector(array.begin(), array.end()); };
  return {name,
          false,
          frame.full_width,
          frame.full_height,
          frame.window,
          copied(frame.color),
          {},
          copied(frame.depth),
          copied(frame.object_id),
          copied(frame.primitive_id)};
}

PicturePair::PicturePair(Picture first, Picture second) : a(std::move(first)), b(std::move(second)) {
  check_match(a, b);
  coded = a.png != b.png;
  window = a.png ? b.window : a.window;
  if (coded)
    for (glm::vec3& color : (a.png ? b : a).color) color = through_8_bits(color, decode_srgb8);
  differences = pixel_differences(values(a.color), values(b.color));
  if (!a.alpha.empty()) include_channel(differences, a.alpha, b.alpha);
}

glm::vec3 PicturePair::value(const glm::vec3& linear) const {
  return coded ? through_8_bits(linear, [](std::uint8_t code) { return static_cast<float>(code) / 255; })
               : linear;
}

std::vector<glm::vec3> PicturePair::values(std::span<const glm::vec3> linear) const {
  std::vector<glm::vec3> out(linear.size());
  std::transform(linear.begin(), linear.end(), out.begin(),
                 [&](const glm::vec3& color) { return value(color); });
  return out;
}

Findings examine(const PicturePair& pair, const Tolerance& tolerance) {
  Findings found;
  const int width = pair.window.width(), height = pair.window.height();
  found.metrics = measure(pair.values(pair.a.color), pair.values(pair.b.color), width, height);
  if (pair.coded) found.metrics.psnr = measure(pair.a.color, pair.b.color, width, height).psnr;
  found.metrics.max.x += pair.window.x0;
  found.metrics.max.y += pair.window.y0;
  found.excess = count_excess(pair.differences, tolerance);
  found.percent_covered_over = percent_covered_over(pair, tolerance);
  found.object_ids = count_different(pair.a.object_id, pair.b.object_id);
  found.primitive_ids = count_different(pair.a.primitive_id, pair.b.primitive_id);
  found.depths = count_different(pair.a.depth, pair.b.depth);
  return found;
}

std::string first_non_finite(const PicturePair& pair) {
  const auto at =
      std::find(pair.differences.begin(), pair.differences.end(), std::numeric_limits<double>::infinity());
  const auto first = static_cast<std::size_t>(at - pair.differences.begin());
  const std::string in_a = bad_channel(pair.a, first);
  return fmt::format("{}: {} at pixel ({}, {})", in_a.empty() ? pair.b.name : pair.a.name,
                     in_a.empty() ? bad_channel(pair.b, first) : in_a, pair.x(first), pair.y(first));
}

std::vector<glm::vec3> difference_picture(const PicturePair& pair) {
  std::vector<glm::vec3> difference(pair.a.color.size());
  for (std::size_t i = 0; i < difference.size(); ++i) {
    const bool finite = !std::isinf(pair.differences[i]);
    difference[i] = finite ? glm::abs(pair.a.color[i] - pair.b.color[i]) : glm::vec3(1);
  }
  return difference;
}

}  // namespace sidelight
