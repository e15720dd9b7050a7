// SPDX-License-Identifier: MIT
// Where a ray met a surface, and where rays start that leave it. In double; shared by the tracer, the z-buffer and both
// references, as visibility.h is.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "common/model/visibility.h"

namespace sidelight {

struct Place {
  glm::dvec3 point{0};
  glm::dvec3 outward{0};                // Ng: unit geometric normal, outward
  glm::dvec3 facing{0};                 // Nv: the same, turned against the ray
  bool entering = false;                // the ray comes from the outward side (decided exactly)
  std::array<double, 3> barycentric{};  // triangles: weights of the three vertices: >= 0, sum 1 to rounding
  double clearance = 0;                 // point +- clearance * outward lies on that side, beyond all rounding
  double together = 0;                  // surfaces of depth <= together count as crossed with this one
};

Place locate(const Scene& scene, const Ray& ray, const Hit& hit, VisibilityCounts& counts);

// What is at0 at a triangle's vertex 0 and differs from it by to1 and to2 at the others.
glm::dvec3 between(const Place& place, const glm::dvec3& at0, const glm::dvec3& to1, const glm::dvec3& to2);

// `together` of a place whose facing and clearance are known.
double together_depth(const Ray& ray, const Hit& hit, const Place& place);

// ---- Rays that leave ----
//
// A ray that leaves starts at point + clearance * Nv, beyond its own surface's rounding. Where two walls meet, that may
// still lie in the other wall's plane, which is then not met, or behind it, and the ray is out of the room. So: it
// starts on the side of every near surface on which the arriving ray travelled, moved there by a few clearances.

// How far from the point, along each axis, a near triangle or sphere may be that has no coordinate above `reach`.
double nearness(const Ray& ray, const Hit& hit, const Place& place, double reach);

// Whether the primitive is near, is another one, and can be met by rays that leave. A cheap no in most cases.
bool stands_near(const Scene& scene, std::uint32_t primitive, const Ray& ray, const Hit& hit,
                 const Place& place, VisibilityCounts& counts);

// `near`: the primitives of which stands_near() is true, ascending.
glm::dvec3 leaving_point(const Scene& scene, const Ray& ray, const Hit& hit, const Place& place,
                         std::span<const std::uint32_t> near, VisibilityCounts& counts);

}  // namespace sidelight
