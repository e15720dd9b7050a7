// SPDX-License-Identifier: MIT
// Mirror and Snell directions: worked out by hand, next to the critical angle against 113-bit arithmetic, and
// the folding rules where an interpolated normal sends a ray to the wrong side.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/optics.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/random.h"
#include "tests/support/rays.h"
#include "tests/support/wide.h"
#include "tests/support/worst.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

const glm::dvec3 kUp{0, 1, 0};

// Travelling down onto the plane y = 0, at this sine with its normal.
glm::dvec3 downward(double sine) { return {sine, -std::sqrt(1 - sine * sine), 0}; }

}  // namespace

TEST_CASE("mirror directions worked out by hand") {
  const glm::dvec3 down{0.6, -0.8, 0};  // R = D - 2 (-0.8) N
  CHECK(reflect_direction(down, kUp, kUp) == near({0.6, 0.8, 0}, 2 * kEps));
  CHECK(reflect_direction({0, -1, 0}, kUp, kUp) == near({0, 1, 0}, 0));
  // A normal tilted by 45 degrees turns a ray from above to the side.
  const double h = std::sqrt(0.5);
  CHECK(reflect_direction({0, -1, 0}, {h, h, 0}, kUp) == near({1, 0, 0}, 4 * kEps));
}

TEST_CASE("refracted directions worked out by hand") {
  // sin T = sin i / 1.5: 0.7071068 / 1.5 = 0.4714045, cos T = sqrt(1 - 2/9) = 0.8819171
  const glm::dvec3 into = *refract_direction(downward(std::sqrt(0.5)), kUp, kUp, 1 / 1.5);
  CHECK(into == near({std::sqrt(2.0) / 3, -std::sqrt(7.0) / 3, 0}, 4 * kEps));
  CHECK(std::abs(into.x - 0.4714045) <= 5e-8);  // all digits of the decimal
  // 30 degrees out of glass: sin T = 0.75
  CHECK(*refract_direction(downward(0.5), kUp, kUp, 1.5) ==
        near({0.75, -std::sqrt(1 - 0.5625), 0}, 4 * kEps));
  // Straight on, whatever the index.
  for (const double eta : {0.25, 1 / 1.5, 1.5, 4.0})
    CHECK(*refract_direction({0, -1, 0}, kUp, kUp, eta) == near({0, -1, 0}, 0));
}

TEST_CASE("beyond the critical angle nothing is transmitted") {
  CHECK_FALSE(refract_direction(downward(std::sqrt(0.5)), kUp, kUp, 1.5));  // 1.5 sin 45° = 1.06
  CHECK_FALSE(refract_direction(downward(0.99), kUp, kUp, 4));
  CHECK_FALSE(refract_direction({1, 0, 0}, kUp, kUp, 1.5));
  CHECK(refract_direction({1, 0, 0}, kUp, kUp, 1 / 1.5));  // grazing entry is refracted: sin T = 1/1.5
}

// REF-1, its criteria with eps = 2^-52. The oracle is Snell's law in 113 bits on the same rounded vectors,
// normalised.
TEST_CASE("next to the critical angle directions are unit, keep Snell's law and decide alike") {
  Random random(1);
  std::uint64_t wrong_decision = 0, transmitted = 0, reflected = 0;
  Worst length_error, sine_error, cosine_error;  // in eps, eps and n sqrt(eps)
  const std::uint64_t each = 1 + tier_count("rays_per_case") / 36;
  for (const double n : {1.0001, 1.5, 2.4})
    for (double width = 1e-1; width > 5e-7; width /= 10)
      for (const double side : {-1.0, 1.0})
        for (std::uint64_t left = each; left > 0; --left) {
          const double angle = std::min(std::asin(1 / n) * (1 + side * width * random.uniform()), 1.57);
          const glm::dvec3 normal = random.direction();
          // Unit anew: where `across` was drawn near the normal, it is so many more eps off being square to it.
          const glm::dvec3 d =
              glm::normalize(-std::cos(angle) * normal + std::sin(angle) * across(normal, random));
          const std::optional<glm::dvec3> t = refract_direction(d, normal, normal, n);

          const QuadVec exact_n = (1 / length(quad(normal))) * quad(normal),
                        exact_d = (1 / length(quad(d))) * quad(d);
          const Quad sine = n * length(cross(exact_d, exact_n)), radicand = 1 - sine * sine;
          if ((radicand < 0) == t.has_value()) wrong_decision += magnitude(radicand) > 8 * n * n * kEps;
          ++(t ? transmitted : reflected);
          if (!t || radicand < 0) continue;
          const Quad t_length = length(quad(*t)), t_sine = length(cross(quad(*t), exact_n));
          length_error.add(magnitude(t_length - 1) / kEps);
          sine_error.add(magnitude(t_sine - sine) / kEps);
          cosine_error.add(magnitude(dot(quad(*t), exact_n) + square_root(radicand)) / (n * std::sqrt(kEps)));
        }
  const HardCase critical("REF-1");
  critical.none("total reflections decided wrongly beyond 8 n² eps of the critical angle", wrong_decision,
                transmitted + reflected);
  critical.at_most("length of T off 1, in eps", length_error, 16);
  critical.at_most("error of the refracted sine in eps", sine_error, 16);
  critical.at_most("error of the refracted cosine in n sqrt(eps)", cosine_error, 2);
  CHECK(transmitted > each);
  CHECK(reflected > each);
}

TEST_CASE("the critical cosine itself, rounded up and down, gives a unit direction or none") {
  std::uint64_t wrong = 0, all = 0;
  for (const double n : {1.0001, 1.5, 2.4, 4.0})
    for (const double towards : {0.0, 2.0}) {
      const double cosine = std::nextafter(std::sqrt(1 - 1 / (n * n)), towards);
      const auto t = refract_direction({1 / n, -cosine, 0}, kUp, kUp, n);
      ++all;
      wrong += t && !(std::abs(glm::length(*t) - 1) <= 4 * kEps);
    }
  HardCase("REF-1").none("directions at the rounded critical cosine that are neither unit nor none", wrong,
                         all);
}

// REF-2
TEST_CASE("equal indices give the ray's own direction, bit for bit") {
  Random random(2);
  std::uint64_t changed = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 d = random.direction();
    const auto t = refract_direction(d, random.direction(), random.direction(), 1);
    changed += !t || *t != d;
  }
  HardCase("REF-2").none("directions that equal indices change in any bit", changed,
                         tier_count("rays_per_case"));
}

TEST_CASE("a mirror ray that an interpolated normal sends below the surface is folded back") {
  // D = (1, -1)/sqrt 2 on N = (-0.28, 0.96): D.N = -1.24/sqrt 2, R = D + 2 (1.24/sqrt 2) N
  //   = (0.3056, 1.3808)/sqrt 2: above, kept. On N = (0.6, 0.8): D.N = -0.2/sqrt 2, R = (1.24, -0.68)/sqrt 2:
  //   folded.
  const double h = std::sqrt(0.5);
  CHECK(reflect_direction({h, -h, 0}, {-0.28, 0.96, 0}, kUp) == near({0.3056 * h, 1.3808 * h, 0}, 8 * kEps));
  CHECK(reflect_direction({h, -h, 0}, {0.6, 0.8, 0}, kUp) == near({1.24 * h, 0.68 * h, 0}, 8 * kEps));
}

TEST_CASE("no mirror ray starts below the geometric surface, no refracted ray above it") {
  Random random(3);
  std::uint64_t below = 0, above = 0, folded = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    glm::dvec3 d = random.direction(), n = random.direction();
    const glm::dvec3 nv = random.direction();
    if (glm::dot(d, nv) > 0) d = -d;
    if (glm::dot(n, nv) < 0) n = -n;
    const glm::dvec3 plain = d - 2 * glm::dot(d, n) * n;
    const glm::dvec3 mirrored = reflect_direction(d, n, nv);
    folded += glm::dot(plain, nv) < 0;
    // Folding leaves |R.Nv| as it was, to the rounding of three dot products of unit vectors.
    below += !(glm::dot(mirrored, nv) >= -8 * kEps);
    below += !(std::abs(glm::dot(mirrored, nv) - std::abs(glm::dot(plain, nv))) <= 8 * kEps);
    const auto t = refract_direction(d, n, nv, random.uniform(0.25, 4));
    above += t && !(glm::dot(*t, nv) <= 8 * kEps);
  }
  const HardCase fold("MIR-6");
  fold.none("mirror directions below the surface, beyond 8 eps", below, tier_count("rays_per_case"));
  fold.none("refracted directions above it", above, tier_count("rays_per_case"));
  CHECK(folded > 0);
}

TEST_CASE("Snell's law uses Nv where the ray comes from behind N, and folds T to the far side") {
  // Only where D.N > 0 is it as if N were Nv.
  const glm::dvec3 d = downward(0.5);
  const glm::dvec3 behind{0.8, 0.6, 0};      // d.N = 0.4 - 0.52
  const glm::dvec3 shallow = downward(0.9);  // shallow.N = 0.72 - 0.26
  CHECK(*refract_direction(shallow, behind, kUp, 1 / 1.5) == *refract_direction(shallow, kUp, kUp, 1 / 1.5));
  CHECK(*refract_direction(d, behind, kUp, 1 / 1.5) != *refract_direction(d, kUp, kUp, 1 / 1.5));

  // cos i = 0.1 on N, leaving a denser medium: sin² T = 1.004² 0.99, cos T = 0.045, so T = 1.004 D + 0.055 N,
  // about. Nv is nearly N, but D.Nv is only -0.001: T.Nv = 0.05, which is on the side it came from.
  const glm::dvec3 n{-0.96, 0.28, 0}, along{0.28, 0.96, 0};
  const glm::dvec3 grazing = glm::normalize(along - 0.1 * n);
  const glm::dvec3 tilted{-0.96, 0.2, 0.2};
  const glm::dvec3 facing = glm::normalize(tilted - (glm::dot(tilted, grazing) + 1e-3) * grazing);
  const glm::dvec3 t = *refract_direction(grazing, n, facing, 1.004);
  CHECK(std::abs(glm::length(t) - 1) <= 4 * kEps);
  CHECK(glm::dot(t, facing) < 0);
}

// MIR-1. Two mirrors that face each other, the second tilted by a: every pair of bounces turns the ray by 2a
// about y.
TEST_CASE("a thousand bounces between two mirrors keep length and direction") {
  constexpr double kTilt = 1e-4;
  const glm::dvec3 floor{0, 0, 1}, ceiling{std::sin(kTilt), 0, -std::cos(kTilt)};
  const glm::dvec3 start = glm::normalize(glm::dvec3(0.1, 0.3, -1));
  glm::dvec3 d = start;
  Worst drift;
  for (int bounce = 0; bounce < 1000; ++bounce) {
    const glm::dvec3& n = bounce % 2 == 0 ? floor : ceiling;
    d = reflect_direction(d, n, n);
    drift.add(magnitude(length(quad(d)) - 1) / kEps);
  }
  HardCase("MIR-1").at_most("length of D off 1 at any of 1000 bounces, in eps", drift, 8);
  const double turn = 1000 * kTilt;  // 500 pairs
  const glm::dvec3 expected(std::cos(turn) * start.x - std::sin(turn) * start.z, start.y,
                            std::sin(turn) * start.x + std::cos(turn) * start.z);
  // A bounce adds at most 8 u of its own to the direction and passes earlier errors on unchanged.
  HardCase("MIR-1").at_most("error of the direction after 1000 bounces, in eps a bounce",
                            glm::length(d - expected) / (1000 * kEps), 4);
}
