// SPDX-License-Identifier: MIT
#include "common/picture/tolerance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace sidelight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Two finite floats are never infinitely far apart in double, so infinity is free to mean "not finite".
double difference(float a, float b) {
  return std::isfinite(a) && std::isfinite(b) ? std::abs(double{a} - double{b}) : kInfinity;
}

}  // namespace

double channel_difference(const glm::vec3& a, const glm::vec3& b) {
  return std::max({difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)});
}

std::vector<double> pixel_differences(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
  assert(a.size() == b.size());
  std::vector<double> differences(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) differences[i] = channel_difference(a[i], b[i]);
  return differences;
}

void include_channel(std::vector<double>& differences, const std::vector<float>& a,
                     const std::vector<float>& b) {
  assert(a.size() == differences.size() && b.size() == differences.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    differences[i] = std::max(differences[i], difference(a[i], b[i]));
}

bool is_over(double difference, double limit) { return difference > limit || difference == kInfinity; }

double Excess::percent_over() const {
  return pixels == 0 ? 0 : 100 * static_cast<double>(over) / static_cast<double>(pixels);
}

// The percentage is a quotient of whole numbers, rounded once: 29 of 10,000 is the double that "0.29" is read as.
bool Excess::within(const Tolerance& tolerance) const {
  const bool few = over <= tolerance.allow || percent_over() <= tolerance.fail_percent;
  return few && hard == 0 && non_finite == 0;
}

Excess count_excess(const std::vector<double>& differences, const Tolerance& tolerance) {
  Excess excess;
  excess.pixels = differences.size();
  for (const double off : differences) {
    if (is_over(off, tolerance.fail)) ++excess.over;
    if (is_over(off, tolerance.hard_fail)) ++excess.hard;
    if (off == kInfinity) ++excess.non_finite;
  }
  return excess;
}

std::vector<std::size_t> worst_pixels(const std::vector<double>& differences, int width, double fail,
                                      std::size_t count, int apart) {
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < differences.size(); ++i)
    if (is_over(differences[i], fail)) candidates.push_back(i);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](std::size_t a, std::size_t b) { return differences[a] > differences[b]; });

  const auto row = static_cast<std::ptrdiff_t>(width);
  const auto near = [&](std::size_t a, std::size_t b) {
    const auto p = static_cast<std::ptrdiff_t>(a), q = static_cast<std::ptrdiff_t>(b);
    return std::abs(p % row - q % row) < apart && std::abs(p / row - q / row) < apart;
  };
  std::vector<std::size_t> worst;
  for (const std::size_t candidate : candidates) {
    if (worst.size() == count) break;
    if (std::none_of(worst.begin(), worst.end(), [&](std::size_t taken) { return near(taken, candidate); }))
      worst.push_back(candidate);
  }
  return worst;
}

}  // namespace sidelight
