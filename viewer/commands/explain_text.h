// SPDX-License-Identifier: MIT
// Explanations in words and as JSON.
#pragma once

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "viewer/commands/job.h"
#include "viewer/report/explain_words.h"

namespace sidelight {

// The pixel's colours are the means of the samples given (as PixelMean takes them).
std::string explanation_text(const Job& job, glm::ivec2 pixel, const std::vector<ExplainedSample>& samples);

// {pixel, color: {raster, raytrace}, samples: [{sample, raster: {color, fragments, local}, raytrace: RAY}]} with RAY =
// {kind, sent, coefficient, falloff, depth, path_weight, origin, direction, passed, color, background or local,
// children: [RAY]} and local = {primitive, object, line, material, depth, point, normal, c1, ambient, lights}.
nlohmann::ordered_json explanation_json(const Job& job, glm::ivec2 pixel, const std::vector<ExplainedSample>& samples);

}  // namespace sidelight
