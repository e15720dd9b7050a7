// SPDX-License-Identifier: MIT
// The local model over a batch, for one lane type. Included only by kernels_scalar.cpp, kernels_avx2.cpp and
// kernels_avx512.cpp, each compiled for its instruction set; the lane type in every name keeps them apart.
#pragma once

#include "common/math/lane_ops.h"
#include "common/model/shading.h"

namespace sidelight {

// The materials of a vector's entries.
template <class F>
struct MaterialLanes {
  // Left as it is until it is filled: a batch seldom fills all. (As Vec3, here and below, a full frame takes 4 % longer.)
  using Rgb = std::array<F, 3>;
  Rgb ambient, diffuse, specular, local;
  F shininess;
};
template <class F>
Vec3<F> vec(const std::array<F, 3>& rgb) {
  return {rgb[0], rgb[1], rgb[2]};
}

// Those of a whole batch. Most often it is one, and read once.
template <class F>
class BatchMaterials {
 public:
  static constexpr auto kCount = static_cast<std::size_t>(kLanes<F>);
  static constexpr std::size_t kVectors = ShadingBatch::kCapacity / kCount;

  // Of the first `vectors` vectors. Entries beyond batch.size have some material that exists.
  BatchMaterials(const ShadingTables& tables, const ShadingBatch& batch, std::size_t vectors) {
    std::uint32_t unlike = 0;
    for (std::size_t i = 1; i < vectors * kCount; ++i) unlike |= batch.material[i] ^ batch.material[0];
    one_ = unlike == 0;
    if (one_) {
      const ShadingMaterial& material = tables.materials[batch.material[0]];
      shiny_ = is_shiny(material);
      fill(0, [&](const auto& of) { return F(of(material)); });
      return;
    }
    for (std::size_t v = 0; v < vectors; ++v) {
      const std::uint32_t* number = &batch.material[v * kCount];
      const auto material = [&](int lane) -> const ShadingMaterial& {
        return tables.materials[number[lane]];
      };
      for (int lane = 0; lane < kLanes<F>; ++lane) shiny_ |= is_shiny(material(lane));
      fill(v, [&](const auto& of) { return generate<F>([&](int lane) { return of(material(lane)); }); });
    }
  }
  bool one() const { return one_; }      // the same in all entries
  bool shiny() const { return shiny_; }  // any of them
  const MaterialLanes<F>& operator[](std::size_t v) const { return of_vector_[one_ ? 0 : v]; }

 private:
  // lanes(of) is of(material) in each lane.
  template <class Lanes>
  void fill(std::size_t v, const Lanes& lanes) {
    const auto rgb = [&](Vec3<float> ShadingMaterial::*color) {
      return std::array<F, 3>{lanes([=](const ShadingMaterial& m) { return (m.*color).x; }),
                              lanes([=](const ShadingMaterial& m) { return (m.*color).y; }),
                              lanes([=](const ShadingMaterial& m) { return (m.*color).z; })};
    };
    MaterialLanes<F>& out = of_vector_[v];
    out.ambient = rgb(&ShadingMaterial::ambient);
    out.diffuse = rgb(&ShadingMaterial::diffuse);
    out.specular = rgb(&ShadingMaterial::specular);
    out.local = rgb(&ShadingMaterial::local);
    out.shininess = lanes([](const ShadingMaterial& m) { return m.shininess; });
  }

  bool one_ = false, shiny_ = false;
  std::array<MaterialLanes<F>, kVectors> of_vector_;
};

// What a light is to a batch: N.L or 0, f(d), and the log of the highlight, if there can be any.
template <class F>
struct LightLanes {
  static constexpr std::size_t kVectors = BatchMaterials<F>::kVectors;
  std::array<std::array<F, 3>, kVectors> to_light;
  std::array<F, kVectors> cosine, arriving, log;
  static constexpr float kNone = -std::numeric_limits<float>::infinity();  // the log of no highlight
};

// The first steps of light_term(), each for all entries.
template <class F>
void view_light(const ShadingLight<float>& light, const ShadingBatch& batch,
                const BatchMaterials<F>& materials, std::size_t vectors, LightLanes<F>& out) {
  constexpr std::size_t kCount = BatchMaterials<F>::kCount;
  for (std::size_t v = 0; v < vectors; ++v) {
    const std::size_t i = v * kCount;
    const LightView<F> view = view_light<F>(load_rows<F>(batch.high, i), load_rows<F>(batch.low, i),
                                            load_rows<F>(batch.normal, i), light);
    out.to_light[v] = {view.to_light.x, view.to_light.y, view.to_light.z};
    out.cosine[v] = lane_max<F>(F(0), view.cosine);
    out.arriving[v] = view.arriving;
  }
  if (!materials.shiny()) return;
  for (std::size_t v = 0; v < vectors; ++v) {
    const std::size_t i = v * kCount;
    const Vec3<F> mirrored =
        mirrored_light<F>(out.cosine[v], vec(out.to_light[v]), load_rows<F>(batch.normal, i));
    out.log[v] = below_one<F>(mirrored, load_rows<F>(batch.to_viewer, i), out.cosine[v]);
  }
  for (std::size_t v = 0; v < vectors; ++v)
    out.log[v] = any<F>(out.log[v] < F(1)) ? log_highlight<F>(out.log[v], materials[v].shininess)
                                           : F(LightLanes<F>::kNone);
}

// A light's colour as the materials of a vector's entries give it back, without N.L and the highlight.
template <class F>
struct LightColors {
  Vec3<F> diffuse, specular;
};
template <class F>
LightColors<F> light_colors(const ShadingLight<float>& light, const LightLanes<F>& lanes,
                            const BatchMaterials<F>& materials, std::size_t v) {
  const Vec3<F> here = light_here<F>(light, lanes.arriving[v], lanes.cosine[v]);
  return {here * vec(materials[v].diffuse), here * vec(materials[v].specular)};
}

// The last step, for each vector: visit(v, the term, but for what only explanations ask for).
template <class F, class Visit>
void for_each_term(const ShadingLight<float>& light, const LightLanes<F>& lanes,
                   const BatchMaterials<F>& materials, std::size_t vectors, const Visit& visit) {
  const bool one = materials.one() && !light.attenuated;  // colour
  LightColors<F> colors = light_colors(light, lanes, materials, 0);
  for (std::size_t v = 0; v < vectors; ++v) {
    if (!one) colors = light_colors(light, lanes, materials, v);
    const bool shiny = materials.shiny() && any<F>(lanes.log[v] > F(LightLanes<F>::kNone));
    LightTerm<F> term;
    term.diffuse = lanes.cosine[v] * colors.diffuse;
    term.specular = (shiny ? lane_exp<F>(lanes.log[v]) : F(0)) * colors.specular;
    visit(v, term);
  }
}

// Sums over the lights, of each vector of a batch.
template <class F>
using BatchColors = std::array<std::array<F, 3>, BatchMaterials<F>::kVectors>;

template <class F>
void add(std::array<F, 3>& to, const Vec3<F>& v) {
  to = {to[0] + v.x, to[1] + v.y, to[2] + v.z};
}

template <class F>
std::size_t vectors_of(const ShadingBatch& batch) {
  constexpr std::size_t kCount = BatchMaterials<F>::kCount;
  return (static_cast<std::size_t>(batch.size) + kCount - 1) / kCount;
}

template <class F>
Vec3<F> ambient_of(const ShadingTables& tables, const BatchMaterials<F>& materials, std::size_t v) {
  return vec(materials[v].ambient) * wide<F>(tables.ambient_light);
}

// The batch, with the steps of light_term() one after the other. Whole vectors only: entries beyond batch.size are
// computed with the others and unused.
template <class F, bool kParts>
void shade_batch(const ShadingTables& tables, ShadingBatch& batch) {
  const std::size_t vectors = vectors_of<F>(batch);
  const BatchMaterials<F> materials(tables, batch, vectors);
  BatchColors<F> sum, diffuse, specular;
  for (std::size_t v = 0; v < vectors; ++v) {
    const Vec3<F> ambient = ambient_of(tables, materials, v);
    sum[v] = {ambient.x, ambient.y, ambient.z};
    if constexpr (kParts) diffuse[v] = specular[v] = {F(0), F(0), F(0)};
  }

  LightLanes<F> lanes;
  for (const ShadingLight<float>& light : tables.lights) {
    view_light(light, batch, materials, vectors, lanes);
    for_each_term(light, lanes, materials, vectors, [&](std::size_t v, const LightTerm<F>& term) {
      add(sum[v], term.total());
      if constexpr (kParts) {
        add(diffuse[v], term.diffuse);
        add(specular[v], term.specular);
      }
    });
  }
  for (std::size_t v = 0; v < vectors; ++v) {
    const std::size_t i = v * BatchMaterials<F>::kCount;
    const Vec3<F> local = vec(materials[v].local);  // c1
    store_rows<F>(local * vec(sum[v]), batch.unshadowed, i);
    if constexpr (kParts) {
      store_rows<F>(local * ambient_of(tables, materials, v), batch.ambient_layer, i);
      store_rows<F>(local * vec(diffuse[v]), batch.diffuse_layer, i);
      store_rows<F>(local * vec(specular[v]), batch.specular_layer, i);
    }
  }
}

template <class F>
[[gnu::flatten]] void shade_batch(const ShadingTables& tables, ShadingBatch& batch, bool with_parts) {
  with_parts ? shade_batch<F, true>(tables, batch) : shade_batch<F, false>(tables, batch);
}

// Light by light: what each adds, and whether a shadow ray has to ask whether it does.
template <class F>
[[gnu::flatten]] void light_terms_of_batch(const ShadingTables& tables, const ShadingBatch& batch,
                                           bool with_parts, LitBatch& out) {
  constexpr std::size_t kCount = BatchMaterials<F>::kCount;
  const std::size_t vectors = vectors_of<F>(batch);
  const BatchMaterials<F> materials(tables, batch, vectors);
  BatchColors<F> diffuse, specular;
  for (std::size_t v = 0; v < vectors; ++v) {
    store_rows<F>(ambient_of(tables, materials, v), out.ambient, v * kCount);
    diffuse[v] = specular[v] = {F(0), F(0), F(0)};
  }

  LightLanes<F> lanes;
  for (std::size_t l = 0; l < tables.lights.size(); ++l) {
    view_light(tables.lights[l], batch, materials, vectors, lanes);
    for_each_term(tables.lights[l], lanes, materials, vectors, [&](std::size_t v, const LightTerm<F>& term) {
      const std::size_t i = v * kCount;
      const Vec3<F> total = term.total();
      const Mask<F> dark = total.x == F(0) && total.y == F(0) && total.z == F(0);
      // Not dark, so it is lit.
      const Mask<F> self_shadowed = fused_dot(load_rows<F>(batch.facing, i), vec(lanes.to_light[v])) <= F(0);
      const F state = select<F>(self_shadowed, F(LightTerms::kSelfShadowed), F(LightTerms::kAsk));
      store_rows<F>(total, out.light[l].total, i);
      store(select<F>(dark, F(LightTerms::kDark), state), &out.light[l].state[i]);
      add(diffuse[v], term.diffuse);
      add(specular[v], term.specular);
    });
  }
  for (std::size_t v = 0; with_parts && v < vectors; ++v) {
    store_rows<F>(vec(diffuse[v]), out.diffuse, v * kCount);
    store_rows<F>(vec(specular[v]), out.specular, v * kCount);
  }
}

}  // namespace sidelight
