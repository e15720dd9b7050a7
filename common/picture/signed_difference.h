// SPDX-License-Identifier: MIT
// The picture of where the tracer is brighter than the z-buffer, and where it is darker.
//
// The sign is told by hue and by lightness alike, so colour-blind eyes and grey prints keep it: towards yellow and light
// where the tracer is brighter, towards violet and dark where it is darker, mid grey where both are equally bright.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/picture/frame.h"

namespace sidelight {

// The colour (linear RGB) of a difference in luminance, traced - rastered. Full at 1 and beyond, halfway at 1/4: the
// strength is the root of |difference|, so that faint light shows. White for NaN.
glm::vec3 signed_difference_color(double difference);

// The picture, for frames of one size and window. The luminance is that of Rec. 709, of linear colours.
std::vector<glm::vec3> signed_difference(const Frame& rastered, const Frame& traced);

}  // namespace sidelight
