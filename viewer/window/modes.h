// SPDX-License-Identifier: MIT
// The ways to look at the two pictures, by the names that lessons and --mode use (common/scene/step_modes.h).
#pragma once

#include <optional>
#include <string_view>

#include "common/picture/frame.h"
#include "common/scene/step_modes.h"

namespace sidelight {

// In the order of kStepModes.
enum class Mode {
  raster,
  raytrace,
  side_by_side,
  swipe,
  flip,
  difference,
  causes,
  ambient,
  diffuse,
  specular,
  shadow,
  reflection,
  refraction,
  depth,
  object,
  primitive,
  normal,
  cost,
  ledger
};
inline constexpr int kModes = static_cast<int>(kStepModes.size());
static_assert(static_cast<int>(Mode::ledger) == kModes - 1);

constexpr std::string_view mode_name(Mode mode) { return kStepModes[static_cast<std::size_t>(mode)]; }

// Empty for a name that is none.
std::optional<Mode> find_mode(std::string_view name);

// The layer that a mode shows alone; empty for the others.
std::optional<Layer> layer_of(Mode mode);
Mode mode_of(Layer layer);

// Both renderers make it: two panels then, else the tracer's picture alone.
bool both_make(Layer layer);

// It compares pixel with pixel, so both pictures must be finished and of one camera.
bool compares(Mode mode);

}  // namespace sidelight
