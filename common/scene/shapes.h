// SPDX-License-Identifier: MIT
// Generated shapes: closed meshes around the origin, wound outward, with shared vertices at seams and poles.
#pragma once

#include <glm/vec3.hpp>

#include "common/scene/build.h"

namespace sidelight {

// Axis-aligned, edges `size`, flat faces (6 quadrilaterals, no vertex normals). size > 0.
PolygonMesh make_box(const glm::dvec3& size);

// Around the y axis from y = 0 to `height`; smooth side, flat caps. radius, height > 0; segments >= 3 around.
PolygonMesh make_cylinder(double radius, double height, int segments);

// As the cylinder, closing in an apex at y = height.
PolygonMesh make_cone(double radius, double height, int segments);

// Around the y axis: `major` to the middle of the tube, `minor` the tube's radius, 0 < minor < major; smooth.
// `around` >= 3 segments along the ring, `tube` >= 3 around the tube.
PolygonMesh make_torus(double major, double minor, int around, int tube);

// The sphere of radius 1: `segments` of longitude around the y axis (even, >= 4) and half as many of latitude, vertices
// on the sphere; smooth.
PolygonMesh make_sphere_mesh(int segments);

}  // namespace sidelight
