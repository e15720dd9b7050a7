// SPDX-License-Identifier: MIT
// The ways to look at the two pictures, by the names that lessons and --mode use (common/scene/step_modes.h).
#pragma once

#include <algorithm>
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
inline std::optional<Mode> find_mode(std::string_view name) {
  const auto at = std::ranges::find(kStepModes, name);
  if (at == kStepModes.end()) return {};
  return static_cast<Mode>(at - kStepModes.begin());
}

// Layers have the names and the order of their modes.
constexpr Mode mode_of(Layer layer) {
  return static_cast<Mode>(static_cast<int>(Mode::ambient) + static_cast<int>(layer));
}
static_assert(std::equal(kLayerNames.begin(), kLayerNames.end(),
                         kStepModes.begin() + static_cast<int>(Mode::ambient)));

// The layer that a mode shows alone; empty for the others.
constexpr std::optional<Layer> layer_of(Mode mode) {
  if (mode < mode_of(Layer{0}) || mode > mode_of(Layer{kLayers - 1})) return {};
  return static_cast<Layer>(static_cast<int>(mode) - static_cast<int>(Mode::ambient));
}

// Both renderers make it: two panels then, else the tracer's picture alone.
constexpr bool both_make(Layer layer) { return (layer_bit(layer) & kLedgerLayers) == 0; }

// It compares pixel with pixel, so both pictures must be finished and of one camera.
constexpr bool compares(Mode mode) {
  return mode == Mode::difference || mode == Mode::causes || mode == Mode::ledger;
}

}  // namespace sidelight
