// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace sidelight {

// The greatest of the components' absolute values.
inline double max_norm(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace sidelight
