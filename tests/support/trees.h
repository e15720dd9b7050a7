// SPDX-License-Identifier: MIT
// The tracer's own tree of rays for one eye ray that a test chooses, and a walk over it.
#pragma once

#include <glm/vec3.hpp>

#include "common/scene/camera.h"
#include "raytrace/prepared.h"
#include "raytrace/raytrace.h"

namespace sidelight::test {

// Of the ray from `eye` towards a point.
inline RayRecord tree_of(const raytrace::Prepared& prepared, const glm::dvec3& eye, const glm::dvec3& towards) {
  CameraSettings settings;
  settings.eye = eye;
  settings.look_at = towards;
  settings.view_height = 0x1p-10;
  return raytrace::explain(prepared, make_camera(settings, 1, 1, 1), 0, 0);
}

// Calls visit(ray) for the rays of a tree that were sent.
template <class Visit>
void for_each_ray(const RayRecord& root, const Visit& visit) {
  if (!root.sent) return;
  visit(root);
  for (const RayRecord& child : root.children) for_each_ray(child, visit);
}

}  // namespace sidelight::test
