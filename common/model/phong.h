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

#include <glm/vec3.hpp>

#include "common/math/lane_math.h"
#include "common/math/lane_ops.h"
#include "common/math/vec.h"

namespace sidelight {

// A light with numbers of type T. A position is high + low, so that a difference of two positions is as good as if
// it had been taken in twice the precision.
template <class T>
struct ShadingLight {
  bool directional = false;
  bool attenuated = true;  // else f(d) = 1
  Vec3<T> high{}, low{};   // point: position; directional: high is the unit vector to the light
  Vec3<T> intensity{};
  T q0 = 1, q1 = 0, q2 = 0;
};

// What the model needs of a visible point.
template <class F>
struct ShadingPoint {
  Vec3<F> high, low;                   // position
  Vec3<F> normal;                      // N
  Vec3<F> facing;                      // Nv: the geometric normal, turned against the ray
  Vec3<F> to_viewer;                   // V
  Vec3<F> ambient, diffuse, specular;  // ka, kd, ks
  F shininess;
};

// What one light adds if nothing blocks it: T_i = diffuse + specular.
template <class F>
struct LightTerm {
  Vec3<F> diffuse, specular;
  F cosine, highlight, arriving;  // N.L, max(0, Rl.V)^s (0 if not lit) and f(d), for explanations
  Mask<F> lit;                    // N.L > 0 and d > 0; the term is zero elsewhere
  Mask<F> self_shadowed;          // lit, but Nv.L <= 0: the surface stands in its own light

  Vec3<F> total() const { return diffuse + specular; }
};

// ka Ia
template <class F>
Vec3<F> ambient_term(const ShadingPoint<F>& point, const Vec3<F>& ambient_light) {
  return point.ambient * ambient_light;
}

// What a light is to a point before its colours count. A kernel over many points takes the steps of light_term() one after
// the other for all of them, so that the processor has many short chains at hand and not a few long ones.
template <class F>
struct LightView {
  Vec3<F> to_light;    // L, of length 0 where d = 0
  F cosine, arriving;  // N.L, f(d)
};

template <class F>
LightView<F> view_light(const Vec3<F>& high, const Vec3<F>& low, const Vec3<F>& normal,
                        const ShadingLight<Scalar<F>>& light) {
  LightView<F> view{wide<F>(light.high), F(0), F(1)};
  if (!light.directional) {
    const Vec3<F> offset = (wide<F>(light.high) - high) + (wide<F>(light.low) - low);
    // Where d² is below what float holds, L is short, and 0 where d is: then N.L > 0 does not hold.
    const F distance2 = lane_max<F>(fused_dot(offset, offset), F(std::numeric_limits<Scalar<F>>::min()));
    const F distance = square_root(distance2);
    view.to_light = (F(1) / distance) * offset;
    if (light.attenuated)
      view.arriving = F(1) / fused<F>(F(light.q2), distance2, fused<F>(F(light.q1), distance, F(light.q0)));
  }
  view.cosine = fused_dot(normal, view.to_light);
  return view;
}

// max(0, Rl.V)^s for unit Rl, V is exp(s log1p(-|Rl - V|²/2)): 1 - Rl.V without the cancellation that makes a power of a
// float dot product wrong by 37 % at s = 10^6. This is |Rl - V|²/2 where Rl.V > 0 and N.L > 0, and 1 elsewhere.
template <class F>
F below_one(const Vec3<F>& mirrored, const Vec3<F>& to_viewer, const F& lit_cosine) {
  const Vec3<F> apart = mirrored - to_viewer;
  const F below = F(Scalar<F>(0.5)) * fused_dot(apart, apart);  // 1 - Rl.V
  // Next to grazing, rounding takes it to 1 and beyond: then the smallest cosine it can tell from 0, so that s = 0 is 1.
  const F most = F(1 - std::numeric_limits<Scalar<F>>::epsilon() / 2);
  const Mask<F> seen = lane_min<F>(fused_dot(mirrored, to_viewer), lit_cosine) > F(0);
  return select<F>(seen, lane_min<F>(below, most), F(1));
}
template <class F>
Vec3<F> mirrored_light(const F& lit_cosine, const Vec3<F>& to_light, const Vec3<F>& normal) {
  return fused<F>(F(2) * lit_cosine, normal, -to_light);
}

// log of max(0, Rl.V)^s, of which lane_exp() makes 0 where it is nothing.
template <class F>
F log_highlight(const F& below, const F& shininess) {
  // Of 1 it is the log of a number next to 0.
  return select<F>(below < F(1), shininess * lane_log1p<F>(-below),
                   F(-std::numeric_limits<Scalar<F>>::infinity()));
}

template <class F>
F specular_power(const Vec3<F>& mirrored, const Vec3<F>& to_viewer, const F& lit_cosine, const F& shininess) {
  return lane_exp<F>(log_highlight<F>(below_one<F>(mirrored, to_viewer, lit_cosine), shininess));
}

// What arrives of a light's intensity, where it is lit. (Elsewhere f(d) may be infinite.)
template <class F>
Vec3<F> light_here(const ShadingLight<Scalar<F>>& light, const F& arriving, const F& lit_cosine) {
  const Vec3<F> intensity = wide<F>(light.intensity);
  return light.attenuated ? select<F>(lit_cosine > F(0), arriving, F(0)) * intensity : intensity;
}

// With shiny = false, for points whose ks is 0, no highlight is looked for: nothing but `highlight` differs.
template <class F>
LightTerm<F> light_term(const ShadingPoint<F>& point, const ShadingLight<Scalar<F>>& light,
                        bool shiny = true) {
  const LightView<F> view = view_light<F>(point.high, point.low, point.normal, light);
  LightTerm<F> term;
  term.cosine = view.cosine;
  term.highlight = F(0);
  term.arriving = view.arriving;
  term.lit = view.cosine > F(0);
  term.self_shadowed = term.lit && fused_dot(point.facing, view.to_light) <= F(0);
  const F lit_cosine = lane_max<F>(F(0), view.cosine);
  if (shiny && any<F>(term.lit))
    term.highlight = specular_power<F>(mirrored_light<F>(lit_cosine, view.to_light, point.normal),
                                       point.to_viewer, lit_cosine, point.shininess);
  const Vec3<F> here = light_here<F>(light, view.arriving, lit_cosine);
  term.diffuse = lit_cosine * (here * point.diffuse);
  term.specular = term.highlight * (here * point.specular);
  return term;
}

}  // namespace sidelight
