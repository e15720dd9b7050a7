// SPDX-License-Identifier: MIT
// How the mouse and the keys move the camera: pure functions from settings to settings. Whatever is done, eye and
// look_at stay apart, finite and within the lengths of a scene file, and the view is never straight up or down.
#pragma once

#include <glm/vec2.hpp>

#include "common/scene/camera.h"

namespace sidelight {

// The eye goes round look_at: by `around` radians about the up direction (positive: to the right), then by `over`
// towards it (positive: up), which stops short of the pole.
CameraSettings orbit(const CameraSettings& camera, double around, double over);

// Eye and look_at move together, by parts of the picture's height at look_at's distance: right, up.
CameraSettings slide(const CameraSettings& camera, glm::dvec2 by);

// The eye's distance to look_at, times `factor` > 0.
CameraSettings dolly(const CameraSettings& camera, double factor);

// Where a point of the scene lies in the picture, in pixels, (0, 0) its top left corner. The point must be in front of
// the eye: in_front below.
glm::dvec2 project(const Camera& camera, const glm::dvec3& point);

// The distance of the point along the viewing direction.
double in_front(const Camera& camera, const glm::dvec3& point);

}  // namespace sidelight
