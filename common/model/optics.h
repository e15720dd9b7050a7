// SPDX-License-Identifier: MIT
// Mirror and Snell directions, in double. All vectors are unit; D is the way the ray travels, N the shading normal,
// Nv the geometric normal turned against the ray (D.Nv <= 0). Results are unit to rounding at every bounce.
// After T. Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980; the vector form of Snell's
// law as in A. Glassner (ed.), "An Introduction to Ray Tracing", 1989, section 5.2.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace sidelight {

// R = D - 2 (D.N) N. An interpolated normal may send it below the surface; it is then folded back about Nv.
glm::dvec3 reflect_direction(const glm::dvec3& d, const glm::dvec3& n, const glm::dvec3& nv);

// T for eta = n_from / n_to, or nothing: total internal reflection. Uses N where D.N < 0, else Nv; T is folded to the
// far side of Nv where N sends it back. eta = 1 gives D itself, bit for bit.
std::optional<glm::dvec3> refract_direction(const glm::dvec3& d, const glm::dvec3& n, const glm::dvec3& nv, double eta);

}  // namespace sidelight
