// SPDX-License-Identifier: MIT
// The tracer's own tree of rays for one eye ray that a test chooses.
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

}  // namespace sidelight::test
