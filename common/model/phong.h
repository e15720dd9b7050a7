// SPDX-License-Identifier: MIT
// The local light model, term by term, over lanes: the one definition that both renderers shade with (the references
// write it out again, on purpose).
//
//   local(P) = ka Ia + sum_i b_i f_i(d) I_i [ kd (N.L) + ks max(0, Rl.V)^s ],   a light's term only where N.L > 0,
//   its specular part only where Rl.V > 0, also for s = 0.
//   N unit normal facing the viewer, L unit vector to the light, V unit vector to the viewer, Rl = 2 (N.L) N - L.
// After B. T. Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975, with the mirrored light
// direction as the lecture has it.
//
// Units: a scene's lengths times ShadingTables::length_scale, a power of two, so that float holds their squares.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "common/math/lane_math.h"
#include "common/math/vec.h"

namespace sidelight {

// A light with numbers of type T. A position is high + low, so that a difference of two positions is as good as if
// it had been taken in twice the precision.
template <class T>
struct ShadingLight {
  bool directional = false;
  bool attenuated = true;              // else f(d) = 1
  std::array<T, 3> high{}, low{};      // point: position; directional: high is the unit vector to the light
  std::array<T, 3> intensity{};
  T q0 = 1, q1 = 0, q2 = 0;
};

// What the model needs of a visible point.
template <class F>
struct ShadingPoint {
  Vec3<F> high, low;      // position
  Vec3<F> normal;         // N
  Vec3<F> facing;         // Nv: the geometric normal, turned against the ray
  Vec3<F> to_viewer;      // V
  Vec3<F> ambient, diffuse, specular;   // ka, kd, ks
  F shininess;
};

// What one light adds if nothing blocks it: T_i = diffuse + specular.
template <class F>
struct LightTerm {
  Vec3<F> diffuse, specular;
  F cosine, highlight, arriving;   // N.L, max(0, Rl.V)^s and f(d), for explanations
  Mask<F> lit;             // N.L > 0 and d > 0; the term is zero elsewhere
  Mask<F> self_shadowed;   // lit, but Nv.L <= 0: the surface stands in its own light

  Vec3<F> total() const { return diffuse + specular; }
};

// ka Ia
template <class F>
Vec3<F> ambient_term(const ShadingPoint<F>& point, const Vec3<F>& ambient_light) {
  return point.ambient * ambient_light;
}

// max(0, Rl.V)^s for unit Rl, V, as exp(s log1p(-|Rl - V|²/2)): 1 - Rl.V without the cancellation that makes a power
// of a float dot product wrong by 37 % at s = 10^6.
template <class F>
F specular_power(const Vec3<F>& mirrored, const Vec3<F>& to_viewer, const F& shininess) {
  const Vec3<F> apart = mirrored - to_viewer;
  const F below_one = F(Scalar<F>(0.5)) * dot(apart, apart);   // 1 - Rl.V
  const Mask<F> seen = dot(mirrored, to_viewer) > F(0);
  // Next to grazing, rounding takes it to 1 and beyond: then the smallest cosine it can tell from 0, so that s = 0 is 1.
  const F most = F(1 - std::numeric_limits<Scalar<F>>::epsilon() / 2);
  const F capped = select<F>(below_one < most, below_one, most);
  const F power = lane_exp<F>(shininess * lane_log1p<F>(-capped));
  return select<F>(seen, power, F(0));
}

// With shiny = false, for points whose ks is 0, no highlight is looked for: nothing but `highlight` differs.
template <class F>
LightTerm<F> light_term(const ShadingPoint<F>& point, const ShadingLight<Scalar<F>>& light, bool shiny = true) {
  const auto wide = [](const std::array<Scalar<F>, 3>& v) { return Vec3<F>{F(v[0]), F(v[1]), F(v[2])}; };

  // L, and how much of the light arrives: f(d)
  Vec3<F> to_light = wide(light.high);
  F arriving = F(1);
  Mask<F> apart = Mask<F>(true);
  if (!light.directional) {
    const Vec3<F> offset = (wide(light.high) - point.high) + (wide(light.low) - point.low);
    const F distance2 = dot(offset, offset);
    apart = distance2 > F(0);
    const F distance = square_root(select<F>(apart, distance2, F(1)));
    to_light = (F(1) / distance) * offset;
    if (light.attenuated)
      arriving = F(1) / ((F(light.q0) + F(light.q1) * distance) + F(light.q2) * distance2);
  }

  const F cosine = dot(point.normal, to_light);
  F highlight = F(0);
  if (shiny) {
    const Vec3<F> mirrored = (F(2) * cosine) * point.normal - to_light;
    highlight = specular_power<F>(mirrored, point.to_viewer, point.shininess);
  }

  LightTerm<F> term;
  term.cosine = cosine;
  term.highlight = highlight;
  term.arriving = arriving;
  term.lit = apart && cosine > F(0);
  term.self_shadowed = term.lit && dot(point.facing, to_light) <= F(0);
  const Vec3<F> light_here = arriving * wide(light.intensity);
  term.diffuse = select<F>(term.lit, cosine * (light_here * point.diffuse), Vec3<F>{});
  term.specular = select<F>(term.lit, highlight * (light_here * point.specular), Vec3<F>{});
  return term;
}

}  // namespace sidelight
