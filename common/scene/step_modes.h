// SPDX-License-Identifier: MIT
// The view modes that a lesson's [[step]] may name. The scene reader checks against this list, the window offers it.
#pragma once

#include <array>
#include <string_view>

namespace sidelight {

inline constexpr std::array<std::string_view, 19> kStepModes = {
    "raster",  "raytrace",  "side-by-side", "swipe",  "flip",       "difference", "causes",
    "ambient", "diffuse",   "specular",     "shadow", "reflection", "refraction", "depth",
    "object",  "primitive", "normal",       "cost",   "ledger"};

}  // namespace sidelight
