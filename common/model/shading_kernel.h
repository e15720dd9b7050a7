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

template <class F>
void shade_lanes(const ShadingTables& tables, ShadingBatch& batch, std::size_t i) {
  ShadingPoint<F> point;
  point.high = load_rgb<F>(batch.high, i);
  point.low = load_rgb<F>(batch.low, i);
  point.normal = load_rgb<F>(batch.normal, i);
  point.facing = load_rgb<F>(batch.facing, i);
  point.to_viewer = load_rgb<F>(batch.to_viewer, i);
  point.ambient = load_rgb<F>(batch.ambient, i);
  point.diffuse = load_rgb<F>(batch.diffuse, i);
  point.specular = load_rgb<F>(batch.specular, i);
  point.shininess = load<F>(&batch.shininess[i]);
  const Vec3<F> local = load_rgb<F>(batch.local, i);   // c1

  const Vec3<float>& light = tables.ambient_light;
  const Vec3<F> ambient = ambient_term<F>(point, {F(light.x), F(light.y), F(light.z)});
  Vec3<F> sum = ambient, diffuse{}, specular{};
  for (const ShadingLight<float>& each : tables.lights) {
    const LightTerm<F> term = light_term<F>(point, each);
    sum = sum + term.total();
    diffuse = diffuse + term.diffuse;
    specular = specular + term.specular;
  }
  store_rgb(local * sum, batch.unshadowed, i);
  store_rgb(local * ambient, batch.ambient_layer, i);
  store_rgb(local * diffuse, batch.diffuse_layer, i);
  store_rgb(local * specular, batch.specular_layer, i);
}

// Whole vectors only: entries beyond batch.size hold what an earlier batch left, finite and unused.
template <class F>
void shade_batch(const ShadingTables& tables, ShadingBatch& batch) {
  for (int i = 0; i < batch.size; i += kLanes<F>) shade_lanes<F>(tables, batch, static_cast<std::size_t>(i));
}

// One for each instruction set.
void shade_scalar(const ShadingTables& tables, ShadingBatch& batch);
void shade_avx2(const ShadingTables& tables, ShadingBatch& batch);
void shade_avx512(const ShadingTables& tables, ShadingBatch& batch);

}  // namespace sidelight
