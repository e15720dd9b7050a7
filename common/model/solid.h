// SPDX-License-Identifier: MIT
// Which points a solid contains. In double; shared by the tracer and its reference, as visibility.h is.
#pragma once

#include <glm/vec3.hpp>

#include "common/scene/scene.h"

namespace sidelight {

// Whether a solid object (Object::solid) contains the point: by distance, side, or, for a mesh, winding number
// (A. van Oosterom and J. Strackee, "The Solid Angle of a Plane Triangle", 1983). O(triangles).
bool contains(const Scene& scene, const Object& solid, const glm::dvec3& point);

}  // namespace sidelight
