// SPDX-License-Identifier: MIT
// Whether two pictures of one size are near enough: how far each pixel is off, how many may be off by more than
// is allowed, and which are the worst. Not a metric (metrics.h): one cracked pixel in a million moves no mean,
// but it is one pixel too many here.
//
// After OpenImageIO's idiff (--fail, --failpercent, --hardfail), save that a value which is not finite is never
// near anything, itself included.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace sidelight {

// The greatest |a - b| of the channels, in double; infinite where a value is not finite in one or both.
double channel_difference(const glm::vec3& a, const glm::vec3& b);

// That, for each pixel. a.size() == b.size().
std::vector<double> pixel_differences(std::span<const glm::vec3> a, std::span<const glm::vec3> b);
// Counts one more channel (alpha) in. All three of one size.
void include_channel(std::vector<double>& differences, const std::vector<float>& a,
                     const std::vector<float>& b);

// Exactly the limit is not over; what is not finite is, whatever the limit.
bool is_over(double difference, double limit);

// What is allowed. A pixel is over if a channel is off by more than `fail`.
struct Tolerance {
  double fail = 0;
  double fail_percent = 0;                                     // so many percent of the pixels may be over,
  std::uint64_t allow = 0;                                     // or so many pixels, whichever is more,
  double hard_fail = std::numeric_limits<double>::infinity();  // but none by more than this
};

// What was found.
struct Excess {
  std::uint64_t pixels = 0;
  std::uint64_t over = 0;        // by more than `fail`
  std::uint64_t hard = 0;        // by more than `hard_fail`
  std::uint64_t non_finite = 0;  // with a value that is not finite

  double percent_over() const;  // 0 of no pixels
  bool within(const Tolerance& tolerance) const;
};
Excess count_excess(const std::vector<double>& differences, const Tolerance& tolerance);

// At most `count` of the pixels that are over, the worst first, the first of equals before the others. No
// two are nearer to each other than `apart` in both x and y, so that they are not one spot five times.
std::vector<std::size_t> worst_pixels(const std::vector<double>& differences, int width, double fail,
                                      std::size_t count, int apart);

}  // namespace sidelight
