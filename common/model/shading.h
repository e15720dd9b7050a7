// SPDX-License-Identifier: MIT
// From surfaces to light: the scene's materials and lights as the kernel reads them, in float or double, and the
// z-buffer's shading of many visible points at once. phong.h has the model itself; this is where double ends and, in
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
  Vec3<T> ambient, diffuse, specular;   // ka, kd, ks
  Vec3<T> local, reflect, refract;      // c1, c2, c3
  T shininess = 1;
};
using ShadingMaterial = ShadingMaterialOf<float>;

template <class T>
struct ShadingTablesOf {
  double length_scale = 1;   // a power of two that brings the scene's extent near 1, so that no square leaves float
  Vec3<T> ambient_light;
  std::vector<ShadingMaterialOf<T>> materials;
  std::vector<ShadingLight<T>> lights;   // none where no light is live
};
using ShadingTables = ShadingTablesOf<float>;

// T: float, or double for a reference image.
template <class T = float>
ShadingTablesOf<T> make_shading_tables(const Scene& scene, const Needs& needs);

// The point as the kernel wants it, seen along `ray`.
template <class T>
ShadingPoint<T> shading_point(const ShadingTablesOf<T>& tables, const Surface& surface, const Ray& ray);

// Up to kCapacity visible points in structure-of-arrays form, and what the local model makes of them.
struct ShadingBatch {
  static constexpr int kCapacity = 64;   // a multiple of every lane count
  using Channel = std::array<float, kCapacity>;
  using Rgb = std::array<Channel, 3>;

  int size = 0;
  Rgb high{}, low{}, normal{}, facing{}, to_viewer{}, ambient{}, diffuse{}, specular{}, local{};
  Channel shininess{};
  // Results, c1 included: R = local (ka Ia + sum T_i), and its three parts.
  Rgb unshadowed{}, ambient_layer{}, diffuse_layer{}, specular_layer{};

  bool full() const { return size == kCapacity; }
  void add(const ShadingPoint<float>& point, const ShadingMaterial& material);
};

// Fills the results of entries [0, size). The same bytes for every isa. `isa` must be one the machine has.
void shade(Isa isa, const ShadingTables& tables, ShadingBatch& batch);

}  // namespace sidelight
