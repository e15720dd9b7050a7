// SPDX-License-Identifier: MIT
// A mesh of a scene in POV-Ray's language. Private to pov.cpp and pov_limits.cpp.
#pragma once

#include <cstdint>

#include "common/scene/pov_text.h"
#include "common/scene/scene.h"

namespace sidelight {

// Whether corner k of the triangle has a normal; one of 0 is none, which POV-Ray would take for <1,0,0>.
inline bool has_normal(const Scene& scene, const Triangle& triangle, std::size_t k) {
  return triangle.normal[k] != kNone && scene.normals[triangle.normal[k]] != glm::dvec3(0);
}

// A mesh2 of the object's triangles of one material, those without area left out. They go the other way round:
// POV-Ray's handedness makes that the outside, which decides on interior_texture.
void write_pov_mesh(const PovText& out, const Scene& scene, const Object& object, std::uint32_t material);

}  // namespace sidelight
