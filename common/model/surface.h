// SPDX-License-Identifier: MIT
// The surface at a hit, as the fast renderers use it: where it is, its normals, its material. In double; the local
// model rounds to float from here (shading.h). The references take only the place (place.h), and work out the normal and
// the material for themselves.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "common/model/place.h"
#include "common/scene/scene.h"

namespace sidelight {

struct Surface : Place {
  glm::dvec3 normal{0};  // N: the interpolated normal on the side of Nv; Nv where there is none; unit
  glm::dvec3 smooth{0};  // the same before it has unit length, which light in float gives it (shading.h)
  std::uint32_t object = 0;
  std::uint32_t material = 0;
};

Surface surface_at(const Scene& scene, const Ray& ray, const Hit& hit, VisibilityCounts& counts);

}  // namespace sidelight
