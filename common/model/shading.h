// SPDX-License-Identifier: MIT
// From surfaces to light: the scene's materials and lights as the kernel reads them, in float or double, and the
// shading of many visible points at once. phong.h has the model itself; this is where double ends and, in
// every picture but a reference image, float begins.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/math/isa.h"
#include "common/model/phong.h"
#include "common/model/surface.h"
#include "common/scene/needs.h"
#include "common/scene/scene.h"

namespace sidelight {

template <class T>
struct ShadingMaterialOf {
  Vec3<T> ambient, diffuse, specular;  // ka, kd, ks
  Vec3<T> local, reflect, refract;     // c1, c2, c3
  T shininess = 1;
};
using ShadingMaterial = ShadingMaterialOf<float>;

// Whether there can be a highlight, for which V is needed.
inline bool is_shiny(const ShadingMaterial& material) {
  const Vec3<float>& ks = material.specular;
  return ks.x != 0 || ks.y != 0 || ks.z != 0;
}

template <class T>
struct ShadingTablesOf {
  double length_scale = 1;  // a power of two that brings the scene's extent near 1: squares stay in float
  Vec3<T> ambient_light;
  std::vector<ShadingMaterialOf<T>> materials;
  std::vector<ShadingLight<T>> lights;  // none where no light is live
};
using ShadingTables = ShadingTablesOf<float>;

// T: float, or double for a reference image.
template <class T = float>
ShadingTablesOf<T> make_shading_tables(const Scene& scene, const Needs& needs);

// Vectors between these squared lengths are given unit length in float as they are, others first in double.
inline constexpr float kLeastPlain = 0x1p-60f, kMostPlain = 0x1p60f;

// The point as the kernel wants it, seen along `ray`.
template <class T>
ShadingPoint<T> shading_point(const ShadingTablesOf<T>& tables, const Surface& surface, const Ray& ray);

// Up to kCapacity visible points in structure-of-arrays form, and what the local model makes of them.
struct ShadingBatch {
  static constexpr int kCapacity = 128, kGroup = 16;  // multiples of every lane count
  using Channel = std::array<float, static_cast<std::size_t>(kCapacity)>;
  using Rgb = std::array<Channel, 3>;

  int size = 0;
  alignas(64) Rgb high{}, low{}, normal{}, to_viewer{};  // V only where some material of the batch is shiny
  alignas(64) Rgb facing{};                              // only light_terms() asks for it
  std::array<std::uint32_t, static_cast<std::size_t>(kCapacity)> material{};  // into ShadingTables::materials
  // Results, c1 included: R = local (ka Ia + sum T_i), and its three parts, if asked for.
  alignas(64) Rgb unshadowed{}, ambient_layer{}, diffuse_layer{}, specular_layer{};

  // Entry i. A batch takes the coefficients from the tables.
  void set(std::size_t i, const ShadingPoint<float>& point, std::uint32_t material_number);
};

// Entry i.
inline glm::vec3 get(const ShadingBatch::Rgb& from, std::size_t i) {
  return {from[0][i], from[1][i], from[2][i]};
}
// Entries [first, first + count) as a picture has them, one after the other.
void interleave(const ShadingBatch::Rgb& from, std::size_t first, std::size_t count, glm::vec3* to);
// The same past the caches (stream_four() in four.h), zeros without a sign: `to` is a multiple of 16 bytes, `count` of 4.
void stream(const ShadingBatch::Rgb& from, std::size_t first, std::size_t count, glm::vec3* to);

// Fills the results of entries [0, size); the three parts of R if `with_parts`. The same bytes for every isa. `isa` must
// be one the machine has.
void shade(Isa isa, const ShadingTables& tables, ShadingBatch& batch, bool with_parts = true);

// What each light adds to the points of a batch where nothing blocks it, for whoever asks that: c1 left out.
struct LightTerms {
  ShadingBatch::Rgb total{};                 // T_i
  ShadingBatch::Channel state{};             // kDark, kSelfShadowed or kAsk
  static constexpr float kDark = 0;          // T_i is zero
  static constexpr float kSelfShadowed = 1;  // b_i = 0 without a ray
  static constexpr float kAsk = 2;
};
struct LitBatch {
  alignas(64) ShadingBatch::Rgb ambient{};              // ka Ia
  alignas(64) ShadingBatch::Rgb diffuse{}, specular{};  // sums over the lights
  std::vector<LightTerms> light;                        // as many as the tables have
};

// Fills entries [0, size) of `out`; the sums only if `with_parts`. The same bytes for every isa, and those of
// light_term().
void light_terms(Isa isa, const ShadingTables& tables, const ShadingBatch& batch, bool with_parts,
                 LitBatch& out);

}  // namespace sidelight
