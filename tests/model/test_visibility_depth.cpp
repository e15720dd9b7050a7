// SPDX-License-Identifier: MIT
// The depth of a triangle: positive on every hit and within its stated bound of the exact quotient, for
// slivers, for triangles seen nearly edge-on and at any scale.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/model/visibility.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/scenes.h"
#include "tests/support/wide.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr double kBound = 0x1p-18;  // visibility.h: relative, at worst

// The bound for this very triangle and ray, from the derivation above depth_plane: a0 . n and d . n are each
// off by 4 u times their sum of magnitudes; the quotient adds u. Bounds are themselves rounded: 1 + 2^-17 for
// the second order.
double relative_bound(const TriangleView& view, const DepthPlane& plane, const glm::dvec3& d) {
  const double above = glm::dot(glm::abs(view.a[0]), plane.weight) / std::abs(plane.a0_n);
  const double below = glm::dot(glm::abs(d), plane.weight) / std::abs(glm::dot(d, plane.n));
  return std::min(kBound, (1 + 0x1p-17) * (4 * kU * (above + below) + kU));
}

// a0, a1, a2 are integers and d = i a0 + j a1 + k a2 with i, j, k >= 0, not all 0: the ray meets the triangle
// at exactly t = 1 / (i + j + k), unless the origin lies in its plane.
struct Tally {
  std::uint64_t rays = 0, wrong = 0, missed = 0, rounded_once = 0;
};
void report(const Tally& tally, const std::string& of) {
  const HardCase accuracy("TRI-7");
  accuracy.none("hits of " + of + " that exact arithmetic does not find, or misses", tally.missed,
                tally.rays);
  accuracy.none("depths of " + of + " beyond their bound", tally.wrong, tally.rays);
}
void check_integer_triangle(const std::array<glm::dvec3, 3>& v, const glm::dvec3& origin, Random& random,
                            Tally& tally) {
  const auto& [v0, v1, v2] = v;
  const Scene scene = scene_of_triangle(v0, v1, v2);
  const TriangleView view = view_triangle(origin, v0, v1, v2);
  const double i = random.below(9), j = random.below(9), k = 1 + random.below(8);
  const glm::dvec3 d = i * view.a[0] + j * view.a[1] + k * view.a[2];
  VisibilityCounts counts;
  ++tally.rays;
  const Hit hit = intersect(scene, 0, {origin, d}, kRayStart, counts);
  const bool in_plane = determinant(integers(view.a[0]), integers(view.a[1]), integers(view.a[2])) == 0;
  tally.missed += hit.found() == in_plane;
  if (in_plane) return;

  const double exact = 1 / (i + j + k);
  const DepthPlane plane = depth_plane(view, v0, v1, v2);
  tally.wrong += !(hit.t > 0 && std::abs(hit.t - exact) <= relative_bound(view, plane, d) * exact);
  if (!plane.sure) {
    ++tally.rounded_once;
    tally.wrong += hit.t != exact;
  }
}

}  // namespace

TEST_CASE("the depth of a sliver is within its bound") {
  // A third vertex next to the line through the others, up to 2^-30 of its length off it, and beyond its ends
  // too.
  Random random(1);
  Tally tally;
  for (std::uint64_t left = tier_count("rays_per_case") / 2; left > 0; --left) {
    const glm::dvec3 a = random.on_grid(1 << 30), b = random.on_grid(1 << 30);
    const glm::dvec3 on_line = glm::round(a + random.uniform(-1, 2) * (b - a));
    const std::array v{a, b, on_line + random.on_grid(1ll << random.below(20))};
    check_integer_triangle(v, random.on_grid(1 << 30), random, tally);
  }
  report(tally, "slivers");
}

TEST_CASE(
    "the depth of a triangle seen nearly edge-on is within its bound, and exact where double is unsure") {
  // An origin in the plane, then moved out of it by 0 or 1 in each coordinate (of 2^31 to 2^34).
  Random random(2);
  Tally tally;
  for (std::uint64_t left = tier_count("rays_per_case") / 2; left > 0; --left) {
    const glm::dvec3 v0 = random.on_grid(1 << 30), e1 = random.on_grid(1 << 30), e2 = random.on_grid(1 << 30);
    const glm::dvec3 in_plane =
        v0 + static_cast<double>(random.integer(3)) * e1 + static_cast<double>(random.integer(3)) * e2;
    check_integer_triangle({v0, v0 + e1, v0 + e2}, in_plane + random.on_grid(1), random, tally);
  }
  report(tally, "triangles seen nearly edge-on");
  CHECK(tally.rounded_once > 0);
}

TEST_CASE("the depth of any triangle is within its bound of the quotient in 113 bits") {
  Random random(3);
  std::uint64_t wrong = 0, hits = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const double size = random.log_uniform(1e-6, 1e6), offset = random.log_uniform(1e-6, 1e6);
    const glm::dvec3 center = random.in_box(offset), origin = center + random.in_box(10 * size);
    const std::array<glm::dvec3, 3> v{center + random.in_box(size), center + random.in_box(size),
                                      center + random.in_box(size * random.log_uniform(1e-6, 1))};
    const double b0 = random.uniform(), b1 = random.uniform() * (1 - b0);
    const glm::dvec3 d = b0 * v[0] + b1 * v[1] + (1 - b0 - b1) * v[2] - origin;
    VisibilityCounts counts;
    const Hit hit = intersect(scene_of_triangle(v[0], v[1], v[2]), 0, {origin, d}, kRayStart, counts);
    if (!hit.found()) continue;

    const TriangleView view = view_triangle(origin, v[0], v[1], v[2]);
    const QuadVec a0 = quad(view.a[0]), a1 = quad(view.a[1]), a2 = quad(view.a[2]), q = quad(d);
    const Quad exact =
        determinant(a0, a1, a2) / (determinant(q, a1, a2) + determinant(q, a2, a0) + determinant(q, a0, a1));
    const double bound = relative_bound(view, depth_plane(view, v[0], v[1], v[2]), d);
    wrong += !(hit.t > 0 && magnitude(hit.t - exact) <= bound * exact);
    ++hits;
  }
  HardCase("TRI-7").none("depths of any triangle beyond their bound", wrong, hits);
}

// TRI-9, MET-2: scaling by powers of two is exact, so nothing may change, not even where positions reach
// 1e-30 or 1e15.
TEST_CASE("scaling a triangle and its ray by a power of two changes no bit") {
  Random random(4);
  std::uint64_t changed = 0, hits = 0;
  for (std::uint64_t left = tier_count("rays_per_case") / 8; left > 0; --left) {
    const std::array<glm::dvec3, 3> v{random.in_box(1), random.in_box(1), random.in_box(1)};
    const glm::dvec3 origin = random.in_box(2), d = (v[0] + v[1] + v[2]) / 3.0 + random.in_box(0.3) - origin;
    VisibilityCounts counts;
    const auto at_scale = [&](double s) {
      Scene scene = scene_of_triangle(v[0], v[1], v[2]);
      for (glm::dvec3& p : scene.positions) p *= s;
      return intersect(scene, 0, {s * origin, s * d}, kRayStart, counts);
    };
    const Hit hit = at_scale(1);
    hits += hit.found();
    for (const int k : {-90, -30, -7, 1, 13, 30, 48}) changed += at_scale(std::exp2(k)) != hit;
  }
  HardCase("TRI-9").none("hits of one triangle that change with its scale, 2^-90 to 2^48", changed, 7 * hits);
}
