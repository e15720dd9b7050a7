// SPDX-License-Identifier: MIT
// The records of explanation.h in words, as `explain` prints them and the window shows them: one wording for both.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "common/model/explanation.h"

namespace sidelight {

// Both renderers' records of one sample of a pixel.
struct ExplainedSample {
  int i = 0, j = 0;  // within the pixel
  RasterRecord raster;
  RayRecord raytrace;
};

// The pixel's colour: the mean of its samples (as PixelMean takes it).
enum class Side { raster, raytrace };
glm::vec3 mean_color(const std::vector<ExplainedSample>& samples, Side side);

const char* ray_name(RayKind kind);

// "primitive 3, sphere of line 40, material red", printable.
std::string primitive_text(const Scene& scene, std::uint32_t primitive);

// "(0.1, 0.25, 1)", six digits.
std::string color_text(const glm::vec3& color);

// Lines that end in newlines, indented by two spaces a level, from `depth` on.
std::string raster_words(const Scene& scene, const RasterRecord& record, int depth);
std::string ray_words(const Scene& scene, const RayRecord& ray, int depth);

}  // namespace sidelight
