// SPDX-License-Identifier: MIT
// The pictures of a bench as its report embeds them: so small that the page stays under 10 MB, and equal ones once.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "viewer/bench/result.h"

namespace sidelight {

// The page that holds all pictures of a bench; the rest of it is far less than a megabyte.
inline constexpr std::size_t kMostEmbedded = std::size_t{8} << 20;  // bytes as base64

struct BenchPictures {
  int reduction = 1;  // this many pixels, across and down, became one
  struct Entry {
    Image8 picture, difference;  // reduced; empty where the point has none, or an earlier one the same
    // The first point of the scene with the same picture: itself, or an earlier one.
    std::size_t picture_as = 0, difference_as = 0;
  };
  std::vector<Entry> points;       // one a point
  std::vector<Image8> references;  // one a scene
};
BenchPictures bench_pictures(const BenchResult& result);

// As of embedded_picture.h.
Image8 reduced(const Image8& image, int factor);

}  // namespace sidelight
