// SPDX-License-Identifier: MIT
// Set-up: where on the sample lattice a primitive may be seen. Conservative: a box may be too large, and never
// excludes a sample that the primitive covers. Works for primitives around and behind the eye, without clipping.
#pragma once

#include <span>

#include "common/picture/frame.h"
#include "common/scene/camera.h"
#include "common/scene/scene.h"
#include "raster/screen.h"

namespace sidelight::raster {

// The pixels' samples, n x n in each.
inline SampleBox samples_of(const Rect& pixels, int n) {
  return {n * pixels.x0, n * pixels.y0, n * pixels.x1, n * pixels.y1};
}

SampleBox intersection(const SampleBox& a, const SampleBox& b);

// The samples whose rays may meet the convex hull of `points` (relative to the eye): a bounding box where all points
// are well in front of the eye, nothing where all are behind it, the whole lattice else.
SampleBox box_of_points(const Camera& camera, std::span<const glm::dvec3> points);

SampleBox box_of_primitive(const Scene& scene, const Camera& camera, std::uint32_t primitive);

}  // namespace sidelight::raster
