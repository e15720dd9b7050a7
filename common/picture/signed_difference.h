// SPDX-License-Identifier: MIT
// The picture of where the tracer is brighter than the z-buffer, and where it is darker; and how many pixels are by how
// much.
//
// The sign is told by hue and by lightness alike, so colour-blind eyes and grey prints keep it: towards yellow and light
// where the tracer is brighter, towards violet and dark where it is darker, mid grey where both are equally bright.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/picture/frame.h"

namespace sidelight {

// The colour (linear RGB) of a difference in luminance, traced - rastered. Full at 1 and beyond, halfway at 1/4: the
// strength is the root of |difference|, so that faint light shows. White for NaN.
glm::vec3 signed_difference_color(double difference);

// The picture, for frames of one size and window. The luminance is that of Rec. 709, of linear colours.
std::vector<glm::vec3> signed_difference(const Frame& rastered, const Frame& traced);

// Its pixels counted, in bins as wide as the colours' strength takes them: a scale of the colours from full violet to full
// yellow has them all in equal widths.
struct DifferenceHistogram {
  static constexpr std::size_t kBins = 64;    // the lower half darker; the outermost hold all beyond 1
  std::array<std::uint64_t, kBins> pixels{};  // of those that differ
  std::uint64_t equal = 0, undefined = 0;     // in luminance; NaN

  // The difference in the middle of a bin, in strength.
  static double middle(std::size_t bin);
  std::uint64_t darker() const;
  std::uint64_t brighter() const;
  std::uint64_t most() const;  // pixels of any bin
  // Of a bin's bar, 0 to 1: logarithmic, so that a lone pixel shows beside many thousands.
  double height(std::size_t bin) const;
};

// For frames of one size and window.
DifferenceHistogram difference_histogram(const Frame& rastered, const Frame& traced);

}  // namespace sidelight
