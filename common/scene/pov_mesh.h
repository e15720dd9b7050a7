// SPDX-License-Identifier: MIT
// A mesh of a scene in POV-Ray's language. Private to pov.cpp.
#pragma once

#include <cstdint>

#include "common/scene/pov_text.h"
#include "common/scene/scene.h"

namespace sidelight {

// A mesh2 of the object's triangles of one material, those without area left out. They go the other way round:
// POV-Ray's handedness makes that the outside, which decides on interior_texture.
void write_pov_mesh(const PovText& out, const Scene& scene, const Object& object, std::uint32_t material);

}  // namespace sidelight
