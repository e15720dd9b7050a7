// SPDX-License-Identifier: MIT
// Pictures as a page embeds them: of few enough pixels that a page of a dozen of them still opens.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/picture/frame.h"
#include "common/picture/srgb.h"

namespace sidelight {

// By which whole factor the frame's pictures are reduced, across and down, to at most 2^22 pixels.
int embedding_reduction(const Frame& frame);

// Blocks of factor x factor pixels become their mean, in linear light; what is left over at the edges is cut off, but a
// picture keeps at least one pixel each way. linear.size() == width * height.
Image8 reduced(std::span<const glm::vec3> linear, int width, int height, int factor);

// One of the frame's pictures, reduced.
Image8 embedded_picture(std::span<const glm::vec3> picture, const Frame& frame);

}  // namespace sidelight
