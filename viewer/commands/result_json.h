// SPDX-License-Identifier: MIT
// The parts of JSON files that more than one verb writes: one definition, so that they have one shape.
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/picture/frame.h"
#include "common/picture/metrics.h"
#include "viewer/bench/result.h"

namespace sidelight {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// [x, y, z], null for what is not finite.
Json triple_json(const glm::dvec3& v);

// The key crop: [x0, y0, x1, y1], half-open, where `part` is not all of a picture of this size; else there is none.
void add_crop(Json& json, const Rect& part, int full_width, int full_height);

// {max: {value, x, y, channel}, mean, rms, psnr}; x and y count in the whole picture, also of a crop; channel is "R", "G"
// or "B"; psnr is null where the 8-bit pictures are identical.
Json metrics_json(const Metrics& metrics);

// To the file, whole or not at all, or to standard output for "-". Throws OutputError.
void write_json(const std::string& path, const Json& json);

// {min, median, max}
Json spread_json(const Spread& spread);

}  // namespace sidelight
