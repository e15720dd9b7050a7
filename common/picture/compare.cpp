// SPDX-License-Identifier: MIT
// The ledger's check, and why a pixel may be off by (2L + 12) u (R + S + M + G), with L lights and u = 2^-24.
//
// Per sample both renderers compute, in float, with A the ambient term, T_i the light terms and b_i in {0, 1}
// (all of them >= 0 and bit-equal in both renderers; the sums run in light order):
//   z-buffer   R = c1 * (A + T_1 + ... + T_L)
//   tracer     l = c1 * (A + b_1 T_1 + ... + b_L T_L)        S = c1 * ((1-b_1) T_1 + ... + (1-b_L) T_L)
//              C = (l + M) + G                               M and G as they are added
// Without rounding (marked *) R* - S* = l*. Each operation rounds by a factor in [1 - u, 1 + u]; a term of R
// or l passes through at most L additions and one product, a term of S through L - 1 and one. To first order:
//   |R - R*| <= (L+1) u R*     |l - l*| <= (L+1) u l*     |S - S*| <= L u S*     |C - (l+M+G)| <= 2u (l+M+G)
// and so, since l* = R* - S*,
//   |C - (R-S+M+G)| <= 2u (l+M+G) + (L+1) u (R*-S*) + (L+1) u R* + L u S*
//                   <= (2L+4) u R + 2u (M+G)                 (the coefficient of S is L - (L+1) - 2 < 0)
// A pixel's layers are means over its samples, summed in double (rounding far below u) and rounded once each,
// which adds
//   u C + u (R+S+M+G) <= 2u (R+M+G)
// and makes (2L+6) u (R+S+M+G) in all. The other 6u cover the terms of second order, the rounding of this
// check itself, and renderers that associate the sums otherwise: T_i added as diffuse and specular apart, for
// one, is another rounding in each of R, l and S. The bound is forward and relative: values that underflow
// (below 2^-126) are outside it. It is a few ulps wide, while what it is there to catch, a term forgotten or
// counted twice, is off by the term.
//
// Where a channel has S = M = G = 0, the tracer computed the very sentence of the z-buffer: no bit differs.
#include "common/picture/compare.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "common/picture/srgb.h"
#include "common/scene/scene.h"

namespace sidelight {
namespace {

// One channel of one pixel.
struct Entry {
  float rastered, shadow, reflection, refraction, traced;

  bool finite() const {
    return std::isfinite(rastered) && std::isfinite(shadow) && std::isfinite(reflection) &&
           std::isfinite(refraction) && std::isfinite(traced);
  }
  bool without_cause() const { return shadow == 0 && reflection == 0 && refraction == 0; }
  bool same_bits() const {
    return std::bit_cast<std::uint32_t>(traced) == std::bit_cast<std::uint32_t>(rastered);
  }
  double residual() const {
    return std::abs(traced - (double{rastered} - double{shadow} + double{reflection} + double{refraction}));
  }
  double scale() const { return double{rastered} + double{shadow} + double{reflection} + double{refraction}; }
  bool explained(double tolerance) const {
    if (!finite()) return false;
    if (without_cause()) return same_bits();
    return residual() <= tolerance * scale();
  }
};

Entry entry(const Frame& rastered, const Frame& traced, std::size_t i, int channel) {
  return {rastered.color[i][channel], traced.layer(Layer::shadow)[i][channel],
          traced.layer(Layer::reflection)[i][channel], traced.layer(Layer::refraction)[i][channel],
          traced.color[i][channel]};
}

// A frame holds its window's pixels row by row; this is where pixel i stands in the picture.
int picture_x(const Frame& frame, std::size_t i) {
  return frame.window.x0 + static_cast<int>(i % static_cast<std::size_t>(frame.width()));
}
int picture_y(const Frame& frame, std::size_t i) {
  return frame.window.y0 + static_cast<int>(i / static_cast<std::size_t>(frame.width()));
}

void assert_comparable(const Frame& rastered, const Frame& traced) {
  assert(rastered.full_width == traced.full_width && rastered.full_height == traced.full_height);
  assert(rastered.window == traced.window);
  assert(rastered.color.size() == rastered.pixels() && traced.color.size() == traced.pixels());
}

void assert_has_causes(const Frame& traced) {
  for (const Layer cause : kCauseLayers) assert(traced.layer(cause).size() == traced.pixels());
}

// Counts covered pixels and mismatching samples. An object is a function of its primitive, so the primitive
// decides for both; a sample that hits nothing has no depth to compare.
void compare_visibility(const Frame& rastered, const Frame& traced, const std::vector<char>& spoiled,
                        Comparison& result) {
  const std::size_t samples = static_cast<std::size_t>(rastered.n) * static_cast<std::size_t>(rastered.n);
  assert(rastered.n == traced.n);
  assert(rastered.sample_primitive.size() == rastered.pixels() * samples);
  assert(traced.sample_primitive.size() == rastered.sample_primitive.size());
  assert(rastered.sample_depth.size() == rastered.sample_primitive.size());
  assert(traced.sample_depth.size() == rastered.sample_primitive.size());

  for (std::size_t i = 0; i < rastered.pixels(); ++i) {
    bool covered = false;
    std::uint64_t mismatches = 0;
    for (std::size_t s = i * samples; s < (i + 1) * samples; ++s) {
      const std::uint32_t primitive = rastered.sample_primitive[s];
      covered = covered || primitive != kNone || traced.sample_primitive[s] != kNone;
      const bool same_primitive = primitive == traced.sample_primitive[s];
      const bool same_depth = std::bit_cast<std::uint64_t>(rastered.sample_depth[s]) ==
                              std::bit_cast<std::uint64_t>(traced.sample_depth[s]);
      if (!same_primitive || (primitive != kNone && !same_depth)) ++mismatches;
    }
    if (covered) ++result.covered;
    if (!spoiled.empty() && spoiled[i]) continue;
    if (mismatches > 0 && result.mismatch_x < 0) {
      result.mismatch_x = picture_x(rastered, i);
      result.mismatch_y = picture_y(rastered, i);
    }
    result.visibility_mismatches += mismatches;
  }
}

void check_ledger(const Frame& rastered, const Frame& traced, std::size_t lights,
                  const std::vector<char>& spoiled, Comparison& result) {
  const double tolerance = (2 * static_cast<double>(lights) + 12) * 0x1p-24;
  for (std::size_t i = 0; i < rastered.pixels(); ++i) {
    if (!spoiled.empty() && spoiled[i]) continue;
    bool explained = true;
    for (int channel = 0; channel < 3; ++channel) {
      const Entry e = entry(rastered, traced, i, channel);
      explained = explained && e.explained(tolerance);
      const double residual = e.residual();
      if (e.finite() && residual > 0) {
        result.ledger_max_residual = std::max(result.ledger_max_residual, residual / e.scale());
      }
    }
    if (explained) continue;
    if (result.unexplained_x < 0) {
      result.unexplained_x = picture_x(rastered, i);
      result.unexplained_y = picture_y(rastered, i);
    }
    ++result.unexplained;
  }
}

Cause sum_up(std::span<const glm::vec3> term) {
  Cause cause;
  for (const glm::vec3& value : term) {
    if (value != glm::vec3(0)) ++cause.pixels;
    for (const float channel : {value.x, value.y, value.z}) {
      if (std::isfinite(channel)) cause.energy += std::abs(double{channel});
    }
  }
  if (!term.empty()) cause.energy /= 3 * static_cast<double>(term.size());
  return cause;
}

// Of |color|.
float luminance(const glm::vec3& color) { return glm::dot(kLuminance, glm::abs(color)); }

glm::vec3 cause_color(const Frame& rastered, const Frame& traced, std::size_t i) {
  if (rastered.color[i] == traced.color[i]) return glm::vec3(0);
  const float brightness = luminance(traced.color[i] - rastered.color[i]);
  bool finite = std::isfinite(brightness);
  std::size_t main_cause = 0;
  float greatest = 0;
  for (std::size_t cause = 0; cause < kCauseLayers.size(); ++cause) {
    const float weight = luminance(traced.layer(kCauseLayers[cause])[i]);
    finite = finite && std::isfinite(weight);
    if (weight > greatest) {
      greatest = weight;
      main_cause = cause;
    }
  }
  const bool without_cause = greatest == 0;
  if (without_cause || !finite) return glm::vec3(1);
  return kCauseHues[main_cause] * std::min(brightness, 1.0f);
}

}  // namespace

// Okabe and Ito, "Color Universal Design" (2008): blue #0072B2, orange #E69F00, bluish green #009E73, decoded
// to linear and scaled to a greatest channel of 1. Along the axis that red-green-blind viewers keep, blue
// against red and green, they lie at the two ends and between.
const std::array<glm::vec3, 3> kCauseHues{{{0.0f, 0.378f, 1.0f}, {1.0f, 0.438f, 0.0f}, {0.0f, 1.0f, 0.501f}}};

Comparison compare(const Frame& rastered, const Frame& traced, std::size_t lights,
                   const std::vector<char>& spoiled) {
  assert_comparable(rastered, traced);
  assert_has_causes(traced);
  Comparison result;
  result.width = rastered.width();
  result.height = rastered.height();
  assert(spoiled.empty() || spoiled.size() == rastered.pixels());
  result.spoiled = spoiled.size() - static_cast<std::size_t>(std::count(spoiled.begin(), spoiled.end(), 0));
  compare_visibility(rastered, traced, spoiled, result);
  check_ledger(rastered, traced, lights, spoiled, result);
  result.shadow = sum_up(traced.layer(Layer::shadow));
  result.reflection = sum_up(traced.layer(Layer::reflection));
  result.refraction = sum_up(traced.layer(Layer::refraction));
  result.metrics = measure(rastered.color, traced.color, result.width, result.height);
  result.metrics.max.x += rastered.window.x0;
  result.metrics.max.y += rastered.window.y0;
  return result;
}

std::vector<glm::vec3> cause_map(const Frame& rastered, const Frame& traced) {
  assert_comparable(rastered, traced);
  assert_has_causes(traced);
  std::vector<glm::vec3> map(rastered.pixels());
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = cause_color(rastered, traced, i);
  return map;
}

std::array<KeptArray<glm::vec3>, 4> ledger_sums(const Frame& rastered, const Frame& traced) {
  assert_comparable(rastered, traced);
  assert_has_causes(traced);
  std::array<KeptArray<glm::vec3>, 4> sums{rastered.color, {}, {}, {}};
  for (std::size_t k = 0; k < kCauseLayers.size(); ++k) {
    const KeptArray<glm::vec3>& term = traced.layer(kCauseLayers[k]);
    const float sign = kCauseLayers[k] == Layer::shadow ? -1.0f : 1.0f;
    sums[k + 1] = sums[k];
    for (std::size_t i = 0; i < term.size(); ++i) sums[k + 1][i] += sign * term[i];
  }
  return sums;
}

std::vector<glm::vec3> absolute_difference(const Frame& rastered, const Frame& traced) {
  assert_comparable(rastered, traced);
  std::vector<glm::vec3> difference(rastered.pixels());
  for (std::size_t i = 0; i < difference.size(); ++i) {
    difference[i] = glm::abs(traced.color[i] - rastered.color[i]);
  }
  return difference;
}

}  // namespace sidelight
