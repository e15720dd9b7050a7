// SPDX-License-Identifier: MIT
// Random numbers that can be repeated: splitmix64, seeded by a small number.
// S. Vigna, "splitmix64.c", 2015, after G. Steele, D. Lea, C. Flood, "Fast Splittable Pseudorandom Number
// Generators", OOPSLA 2014.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>

namespace sidelight::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * kStep + 0x1234567) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += kStep;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }

  // In [0, 1), in [low, high).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // In [low, high), evenly spread over the magnitudes; 0 < low < high.
  double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }

  // In [0, count), in [-limit, limit], in [low, high].
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(uniform() * count); }
  std::int64_t integer(std::int64_t limit) { return between(-limit, limit); }
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }

  glm::dvec3 in_box(double half_edge) {
    const double x = uniform(-half_edge, half_edge), y = uniform(-half_edge, half_edge);
    return {x, y, uniform(-half_edge, half_edge)};
  }
  glm::dvec3 on_grid(std::int64_t limit) {
    const auto coordinate = [&] { return static_cast<double>(integer(limit)); };
    const double x = coordinate(), y = coordinate();
    return {x, y, coordinate()};
  }
  // Uniform on the unit sphere.
  glm::dvec3 direction() {
    const double z = 2 * uniform() - 1, phi = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15;
  std::uint64_t state_;
};

}  // namespace sidelight::test
