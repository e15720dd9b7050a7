// SPDX-License-Identifier: MIT
// Two pictures whose pixels can be compared: from files, or one of them just rendered. What is compared:
//   OpenEXR with OpenEXR (or with a rendered picture)   the linear values
//   PNG with PNG                                        the linear values that they stand for
//   PNG with OpenEXR (or with a rendered picture)       both as 8-bit sRGB codes divided by 255
// So 1 is white everywhere, and in the last case one step of a code is 1/255 = 0.0039.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/picture/frame.h"
#include "common/picture/metrics.h"
#include "common/picture/tolerance.h"

namespace sidelight {

struct Picture {
  std::string name;                     // for messages, printable
  bool png = false;                     // which knows its size, but not its place in a larger picture
  int full_width = 0, full_height = 0;  // the whole picture
  Rect window;                          // the part that is stored
  std::vector<glm::vec3> color;         // linear
  std::vector<float> alpha, depth;      // empty where there is none
  std::vector<std::uint32_t> object_id, primitive_id;
};

// Throws InputError.
Picture read_picture(const std::string& path);
// Without alpha. The frame's ids and depth come along.
Picture picture_of(const Frame& frame, const std::string& name);

struct PicturePair {
  // Throws PicturesDoNotMatch, which says what differs: the size, a crop's place, or that only one has alpha.
  PicturePair(Picture first, Picture second);

  // What is compared for a linear colour.
  glm::vec3 value(const glm::vec3& linear) const;
  std::vector<glm::vec3> values(std::span<const glm::vec3> linear) const;
  int width() const { return window.width(); }
  int x(std::size_t i) const { return window.x0 + static_cast<int>(i % static_cast<std::size_t>(width())); }
  int y(std::size_t i) const { return window.y0 + static_cast<int>(i / static_cast<std::size_t>(width())); }

  Picture a, b;
  bool coded;                       // compared as codes
  Rect window;                      // of both, in the coordinates of the whole picture
  std::vector<double> differences;  // per pixel, of the values (tolerance.h)
};

struct Findings {
  Metrics metrics;  // of the values; psnr of the 8-bit pictures; the maximum's x, y in the whole
  Excess excess;
  std::optional<double> percent_covered_over;  // among pixels with an object id in either picture
  // Pixels that differ in these, where both pictures have them.
  std::optional<std::uint64_t> object_ids, primitive_ids, depths;
};
Findings examine(const PicturePair& pair, const Tolerance& tolerance);

// "a.exr: R at pixel (3, 4)": the first value that is not finite. Needs one.
std::string first_non_finite(const PicturePair& pair);

// |a - b| of the colours, linear. White where a value is not finite, so that it is seen.
std::vector<glm::vec3> difference_picture(const PicturePair& pair);

}  // namespace sidelight
