// SPDX-License-Identifier: MIT
// The local model term by term, against values worked out by hand, and at the arguments where it likes to
// break: s = 0 and s = 10^6, light from behind, light at the point itself.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/phong.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/random.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

template <class T>
constexpr double kRoundoff = std::numeric_limits<T>::epsilon() / 2;

template <class T>
Vec3<T> vec(const glm::dvec3& v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

// At the origin, facing +z, seen from straight above.
template <class T>
ShadingPoint<T> point_facing_z() {
  ShadingPoint<T> point{};
  point.normal = point.facing = point.to_viewer = {0, 0, 1};
  point.ambient = vec<T>({0.25, 0.5, 0.75});
  point.diffuse = vec<T>({0.5, 0.25, 0.125});
  point.specular = vec<T>({0.25, 0.25, 0.5});
  point.shininess = 2;
  return point;
}

// A light in the direction `to_light` at infinity.
template <class T>
ShadingLight<T> sun(const glm::dvec3& to_light) {
  ShadingLight<T> light;
  light.directional = true;
  light.high = vec<T>(to_light);
  light.intensity = {1, 1, 1};
  return light;
}

// The unit vector in the plane of x and z with this z.
glm::dvec3 with_cosine(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

template <class T>
bool is_zero(const LightTerm<T>& term) {
  return !term.lit && !term.self_shadowed && term.total() == near({0, 0, 0}, 0);
}

}  // namespace

TEST_CASE_TEMPLATE("the ambient term is ka times Ia", T, float, double) {
  const Vec3<T> term = ambient_term<T>(point_facing_z<T>(), vec<T>({2, 1, 0.5}));
  CHECK(term == near({0.5, 0.5, 0.375}, 0));
}

// Light at (0, 3, 4): d = 5, L = (0, 3/5, 4/5), N.L = 4/5, Rl = 2 (4/5) N - L = (0, -3/5, 4/5), Rl.V = 4/5,
// (Rl.V)² = 16/25. f = 1 / (1 + d/5 + d²/25) = 1/3, so that I = (3, 6, 12) arrives as (1, 2, 4).
//   diffuse  = 4/5 (1, 2, 4) kd = (0.4, 0.4, 0.4)        specular = 16/25 (1, 2, 4) ks = (0.16, 0.32, 1.28)
TEST_CASE_TEMPLATE("a point light worked out by hand", T, float, double) {
  ShadingLight<T> light;
  light.high = {0, 3, 4};
  light.intensity = {3, 6, 12};
  light.q0 = 1;
  light.q1 = static_cast<T>(0.2);
  light.q2 = static_cast<T>(0.04);
  const LightTerm<T> term = light_term<T>(point_facing_z<T>(), light);
  CHECK(term.lit);
  CHECK_FALSE(term.self_shadowed);
  // L is good to 2 u, f to 5 u, three products: 12 u of at most 1.28 would do without the power; |Rl - V|²/2
  // is off by 10 u, relative to Rl.V = 0.8 and doubled by the exponent 25 u, log1p and exp 8 u more. Together
  // under 50 u.
  CHECK(term.diffuse == near({0.4, 0.4, 0.4}, 12 * kRoundoff<T>));
  CHECK(term.specular == near({0.16, 0.32, 1.28}, 50 * kRoundoff<T> * 1.28));
  CHECK(term.total() == near({0.56, 0.72, 1.68}, 50 * kRoundoff<T> * 1.68));
}

TEST_CASE_TEMPLATE("attenuation falls with the distance, its square, or not at all", T, float, double) {
  ShadingLight<T> light;
  light.high = {0, 0, 4};
  light.intensity = {1, 1, 1};
  const auto diffuse = [&](T q0, T q1, T q2) {
    light.q0 = q0;
    light.q1 = q1;
    light.q2 = q2;
    return light_term<T>(point_facing_z<T>(), light)
        .diffuse.x;  // kd / (q0 + 4 q1 + 16 q2): powers of two, exact
  };
  CHECK(diffuse(1, 0, 0) == T(0.5));
  CHECK(diffuse(2, 0, 0) == T(0.25));
  CHECK(diffuse(0, 1, 0) == T(0.125));
  CHECK(diffuse(0, 0, 1) == T(0.03125));
  CHECK(diffuse(8, 2, 1) == T(0.015625));
}

TEST_CASE_TEMPLATE("a directional light has no distance, wherever the point is", T, float, double) {
  ShadingPoint<T> point = point_facing_z<T>();
  point.high = {1000, -2000, 500};
  ShadingLight<T> light = sun<T>({0, 0, 1});
  light.q0 = 7;  // means nothing here
  const LightTerm<T> term = light_term<T>(point, light);
  CHECK(term.diffuse == near({0.5, 0.25, 0.125}, 0));
  CHECK(term.specular == near({0.25, 0.25, 0.5}, 0));  // Rl = V: the power is exactly 1
}

TEST_CASE_TEMPLATE("the low parts of two positions count in their difference", T, float, double) {
  // A light 2^-30 above a point at z = 1: high parts alone would coincide in float.
  ShadingPoint<T> point = point_facing_z<T>();
  point.high = {0, 0, 1};
  ShadingLight<T> light;
  light.high = {0, 0, 1};
  light.low = {0, 0, T(0x1p-30)};
  light.intensity = {1, 1, 1};
  light.q0 = 0;
  light.q1 = 1;
  CHECK(light_term<T>(point, light).diffuse.x == T(0x1p29));  // 0.5 / 2^-30
}

TEST_CASE_TEMPLATE("a light at the point itself adds nothing", T, float, double) {
  ShadingPoint<T> point = point_facing_z<T>();
  point.high = {1, 2, 3};
  point.low = {T(0x1p-26), 0, 0};
  ShadingLight<T> light;
  light.high = {1, 2, 3};
  light.low = {T(0x1p-26), 0, 0};
  light.intensity = {1, 1, 1};
  light.q0 = 0;
  light.q2 = 1;  // 1/d² would be infinite
  CHECK(is_zero(light_term<T>(point, light)));
}

// SHA-4
TEST_CASE_TEMPLATE("a light behind the surface or in its plane adds exactly nothing", T, float, double) {
  ShadingPoint<T> point = point_facing_z<T>();
  for (const double cosine : {-1.0, -1e-3, -1e-8, -0.0, 0.0})
    for (const double viewer : {-1.0, 1.0})
      for (const T shininess : {T(0), T(1), T(50)}) {
        CAPTURE(cosine);
        point.to_viewer = {0, 0, static_cast<T>(viewer)};
        point.shininess = shininess;
        CHECK(is_zero(light_term<T>(point, sun<T>(with_cosine(cosine)))));
      }
}

TEST_CASE_TEMPLATE("a surface stands in its own light where N sees it and Nv does not", T, float, double) {
  ShadingPoint<T> point = point_facing_z<T>();
  // Of few bits, so that Nv.L is exactly 0.
  const ShadingLight<T> light = sun<T>({0.625, 0, 0.78125});
  point.facing = {T(-0.78125), 0, T(0.625)};
  CHECK(light_term<T>(point, light).lit);
  CHECK(light_term<T>(point, light).self_shadowed);
  point.facing = {-1, 0, 0};
  CHECK(light_term<T>(point, light).self_shadowed);
  CHECK(light_term<T>(point, light).diffuse.x == T(0.78125) * T(0.5));  // booked as shadow, so the term stays
  point.facing = {1, 0, 0};
  CHECK_FALSE(light_term<T>(point, light).self_shadowed);
  point.normal = {0, 0, -1};
  point.facing = {-1, 0, 0};
  CHECK_FALSE(light_term<T>(point, light).self_shadowed);  // not lit in the first place
}

// PHO-1. N = z; L = N, or in the plane, or behind; V such that Rl.V has the value wanted: where N.L = 1, Rl =
// N. Error of c^s = exp(s log1p(-|Rl - V|²/2)): 1 - c is formed to 4 u, and where it is 1 the power may be
// that of an ulp instead of c's (both below 2 u for s >= 1); log1p and exp add 8 u times s c^s |log c| <= 1.
// 4 eps = 8 u covers it.
TEST_CASE_TEMPLATE("72 combinations of s, Rl.V and N.L follow the definition of the specular term", T, float,
                   double) {
  ShadingPoint<T> point = point_facing_z<T>();
  point.specular = {1, 1, 1};
  double worst = 0;
  for (const double s : {0.0, 1e-30, 1.0, 1.5})
    for (const double rv : {-1.0, -1e-8, -0.0, 0.0, 1e-45, 1.0})
      for (const double nl : {-1.0, 0.0, 1.0}) {
        CAPTURE(s);
        CAPTURE(rv);
        CAPTURE(nl);
        point.shininess = static_cast<T>(s);
        point.to_viewer = vec<T>(with_cosine(rv));
        const double expected = nl > 0 && rv > 0 ? std::pow(rv, s) : 0;
        const LightTerm<T> term = light_term<T>(point, sun<T>(with_cosine(nl)));
        CHECK(term.specular == near(glm::dvec3(expected), 8 * kRoundoff<T>));
        worst = std::max(worst, std::abs(double{term.specular.x} - expected));
      }
  HardCase("PHO-1").at_most(sizeof(T) == 4 ? "72 combinations in float, error in units of eps"
                                           : "72 combinations in double, error in units of eps",
                            worst / (2 * kRoundoff<T>), 4);
}

// PHO-2. The angle is known in double; Rl and V are rounded to float. With y = s |Rl - V|²/2 and an error of
// k u in Rl - V, the power e^-y is off by e^-y sqrt(2 y s) k u <= 0.61 sqrt(s) k u = 3.6e-5 k for s = 10^6; k
// is about 1.
TEST_CASE("the highlight is within 1e-4 of its peak up to s = 10^6") {
  Random random(5);
  double worst_of_all = 0, of_power = 0;  // the second: the usual way, at the largest s
  for (double s = 1; s <= 1e6; s *= 10) {
    double worst = 0;
    of_power = 0;
    for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
      const double power = random.log_uniform(1e-3, 1);
      // c = power^(1/s) through sin(angle / 2), since acos(c) has lost it for large s
      const double angle = 2 * std::asin(std::sqrt(-std::expm1(std::log(power) / s) / 2));
      const glm::dvec3 mirrored = random.direction();
      const glm::dvec3 across = glm::normalize(glm::cross(mirrored, random.direction()));
      const glm::dvec3 to_viewer = std::cos(angle) * mirrored + std::sin(angle) * across;
      const Vec3<float> Rl = vec<float>(mirrored), V = vec<float>(to_viewer);
      const auto shininess = static_cast<float>(s);
      worst = std::max(worst, std::abs(specular_power<float>(Rl, V, 1.0f, shininess) - power));
      const float cosine = Rl.x * V.x + Rl.y * V.y + Rl.z * V.z;
      of_power = std::max(of_power, std::abs(std::pow(cosine, shininess) - power));
    }
    CAPTURE(s);
    CHECK(worst <= 1e-4);
    worst_of_all = std::max(worst_of_all, worst);
  }
  HardCase("PHO-2").at_most("error of the highlight, its peak being 1, s = 1 to 1e6", worst_of_all, 1e-4);
  HardCase("PHO-2").at_least("as a power of a float dot product it would be, at s = 1e6", of_power, 0.1);
}

// Both kernels get the same numbers, each a float. Diffuse: f good to 8 u, N.L to 5 u absolutely, products 3
// u, of at most I kd = 1: 16 u. Specular: L, Rl and Rl - V good to 8 u a component, so |Rl - V|²/2 <= 1 to 24
// u and the power to s 24 u (|d(c^s)/dc| <= s), log1p and exp 8 u: with the factor, (24 s + 24) u.
TEST_CASE("float and double agree to the rounding of float") {
  Random random(6);
  std::uint64_t wrong = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const Vec3<float> at = vec<float>(random.in_box(1)), light_at = vec<float>(random.in_box(4));
    const Vec3<float> normal = vec<float>(random.direction()), to_viewer = vec<float>(random.direction());
    const auto shininess = static_cast<float>(random.log_uniform(1, 100));
    const auto evaluate = [&]<class T>(T) {
      const auto same = [](const Vec3<float>& v) { return Vec3<T>{v.x, v.y, v.z}; };
      ShadingPoint<T> point{};
      point.high = same(at);
      point.normal = point.facing = same(normal);
      point.to_viewer = same(to_viewer);
      point.diffuse = point.specular = {1, 1, 1};
      point.shininess = shininess;
      ShadingLight<T> light;
      light.high = {light_at.x, light_at.y, light_at.z};
      light.intensity = {1, 1, 1};
      light.q0 = 1;
      light.q1 = light.q2 = T(0.25);
      return light_term<T>(point, light);
    };
    const LightTerm<float> narrow = evaluate(0.0f);
    const LightTerm<double> wide = evaluate(0.0);
    wrong += !(std::abs(narrow.diffuse.x - wide.diffuse.x) <= 16 * kRoundoff<float>);
    // Where Rl.V or N.L is 0 to rounding, only one of them may see the highlight: up to its height there, s
    // 24 u.
    const bool edge = (narrow.specular.x > 0) != (wide.specular.x > 0);
    wrong +=
        !edge && !(std::abs(narrow.specular.x - wide.specular.x) <= (24 * shininess + 24) * kRoundoff<float>);
  }
  CHECK(wrong == 0);
}
