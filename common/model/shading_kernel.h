// SPDX-License-Identifier: MIT
// The local model over a batch, for one lane type. Included only by shading_scalar.cpp, shading_avx2.cpp and
// shading_avx512.cpp, each compiled for its instruction set; the lane type in every name keeps them apart.
#pragma once

#include "common/model/shading.h"

namespace sidelight {

template <class F>
Vec3<F> load_rgb(const ShadingBatch::Rgb& from, std::size_t i) {
  return {load<F>(&from[0][i]), load<F>(&from[1][i]), load<F>(&from[2][i])};
}

template <class F>
void store_rgb(const Vec3<F>& value, ShadingBatch::Rgb& to, std::size_t i) {
  store(value.x, &to[0][i]);
  store(value.y, &to[1][i]);
  store(value.z, &to[2][i]);
}

// The materials of entries i and on. Most often it is one, and read once.
template <class F>
struct MaterialLanes {
  Vec3<F> ambient, diffuse, specular, local;
  F shininess;
  bool shiny = false;  // any of them
};

template <class F>
MaterialLanes<F> load_materials(const ShadingTables& tables, const ShadingBatch& batch, std::size_t i) {
  const auto material = [&](int lane) -> const ShadingMaterial& {
    return tables.materials[batch.material[i + static_cast<std::size_t>(lane)]];
  };
  MaterialLanes<F> out;
  bool one = true;
  for (int lane = 0; lane < kLanes<F>; ++lane) {
    one = one && &material(lane) == &material(0);
    out.shiny = out.shiny || is_shiny(material(lane));
  }
  const auto lanes = [&](const auto& number) {
    if (one) return F(number(material(0)));
    std::array<float, static_cast<std::size_t>(kLanes<F>)> values;
    for (int lane = 0; lane < kLanes<F>; ++lane)
      values[static_cast<std::size_t>(lane)] = number(material(lane));
    return load<F>(values.data());
  };
  const auto rgb = [&](Vec3<float> ShadingMaterial::*color) {
    return Vec3<F>{lanes([=](const ShadingMaterial& m) { return (m.*color).x; }),
                   lanes([=](const ShadingMaterial& m) { return (m.*color).y; }),
                   lanes([=](const ShadingMaterial& m) { return (m.*color).z; })};
  };
  out.ambient = rgb(&ShadingMaterial::ambient);
  out.diffuse = rgb(&ShadingMaterial::diffuse);
  out.specular = rgb(&ShadingMaterial::specular);
  out.local = rgb(&ShadingMaterial::local);
  out.shininess = lanes([](const ShadingMaterial& m) { return m.shininess; });
  return out;
}

template <class F>
ShadingPoint<F> load_point(const ShadingBatch& batch, const MaterialLanes<F>& material, std::size_t i) {
  ShadingPoint<F> point;
  point.high = load_rgb<F>(batch.high, i);
  point.low = load_rgb<F>(batch.low, i);
  point.normal = load_rgb<F>(batch.normal, i);
  point.to_viewer = load_rgb<F>(batch.to_viewer, i);
  point.ambient = material.ambient;
  point.diffuse = material.diffuse;
  point.specular = material.specular;
  point.shininess = material.shininess;
  return point;
}

template <class F>
void shade_lanes(const ShadingTables& tables, ShadingBatch& batch, bool with_parts, std::size_t i) {
  const MaterialLanes<F> material = load_materials<F>(tables, batch, i);
  const ShadingPoint<F> point = load_point<F>(batch, material, i);
  const Vec3<F>& local = material.local;  // c1

  const Vec3<float>& light = tables.ambient_light;
  const Vec3<F> ambient = ambient_term<F>(point, {F(light.x), F(light.y), F(light.z)});
  Vec3<F> sum = ambient, diffuse{}, specular{};
  for (const ShadingLight<float>& each : tables.lights) {
    const LightTerm<F> term = light_term<F>(point, each, material.shiny);
    sum = sum + term.total();
    diffuse = diffuse + term.diffuse;
    specular = specular + term.specular;
  }
  store_rgb(local * sum, batch.unshadowed, i);
  if (!with_parts) return;
  store_rgb(local * ambient, batch.ambient_layer, i);
  store_rgb(local * diffuse, batch.diffuse_layer, i);
  store_rgb(local * specular, batch.specular_layer, i);
}

// Whole vectors only: entries beyond batch.size are computed with the others and unused. Their materials are some that
// exist, whatever else they hold.
template <class F>
void shade_batch(const ShadingTables& tables, ShadingBatch& batch, bool with_parts) {
  for (int i = 0; i < batch.size; i += kLanes<F>)
    shade_lanes<F>(tables, batch, with_parts, static_cast<std::size_t>(i));
}

template <class F>
void light_terms_of_batch(const ShadingTables& tables, const ShadingBatch& batch, bool with_parts,
                          LitBatch& out) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); i += kLanes<F>) {
    const MaterialLanes<F> material = load_materials<F>(tables, batch, i);
    ShadingPoint<F> point = load_point<F>(batch, material, i);
    point.facing = load_rgb<F>(batch.facing, i);
    const Vec3<float>& ambient = tables.ambient_light;
    store_rgb(ambient_term<F>(point, {F(ambient.x), F(ambient.y), F(ambient.z)}), out.ambient, i);
    Vec3<F> diffuse{}, specular{};
    for (std::size_t l = 0; l < tables.lights.size(); ++l) {
      const LightTerm<F> term = light_term<F>(point, tables.lights[l], material.shiny);
      const Vec3<F> total = term.total();
      const Mask<F> dark = total.x == F(0) && total.y == F(0) && total.z == F(0);
      const F state = select<F>(term.self_shadowed, F(LightTerms::kSelfShadowed), F(LightTerms::kAsk));
      store_rgb(total, out.light[l].total, i);
      store(select<F>(dark, F(LightTerms::kDark), state), &out.light[l].state[i]);
      diffuse = diffuse + term.diffuse;
      specular = specular + term.specular;
    }
    if (!with_parts) continue;
    store_rgb(diffuse, out.diffuse, i);
    store_rgb(specular, out.specular, i);
  }
}

// One for each instruction set.
void light_terms_scalar(const ShadingTables& tables, const ShadingBatch& batch, bool with_parts,
                        LitBatch& out);
void light_terms_avx2(const ShadingTables& tables, const ShadingBatch& batch, bool with_parts, LitBatch& out);
void light_terms_avx512(const ShadingTables& tables, const ShadingBatch& batch, bool with_parts,
                        LitBatch& out);
void shade_scalar(const ShadingTables& tables, ShadingBatch& batch, bool with_parts);
void shade_avx2(const ShadingTables& tables, ShadingBatch& batch, bool with_parts);
void shade_avx512(const ShadingTables& tables, ShadingBatch& batch, bool with_parts);

}  // namespace sidelight
