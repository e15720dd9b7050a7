// SPDX-License-Identifier: MIT
#include "viewer/window/modes.h"

#include <algorithm>

namespace sidelight {
namespace {

constexpr int kFirstLayer = static_cast<int>(Mode::ambient);

constexpr bool names_agree() {
  for (int i = 0; i < kLayers; ++i)
    if (kStepModes[static_cast<std::size_t>(kFirstLayer + i)] != kLayerNames[static_cast<std::size_t>(i)])
      return false;
  return true;
}
static_assert(names_agree(), "layers have the names and the order of their modes");

}  // namespace

std::optional<Mode> find_mode(std::string_view name) {
  const auto at = std::find(kStepModes.begin(), kStepModes.end(), name);
  if (at == kStepModes.end()) return {};
  return static_cast<Mode>(at - kStepModes.begin());
}

std::optional<Layer> layer_of(Mode mode) {
  const int layer = static_cast<int>(mode) - kFirstLayer;
  if (layer < 0 || layer >= kLayers) return {};
  return static_cast<Layer>(layer);
}

Mode mode_of(Layer layer) { return static_cast<Mode>(kFirstLayer + static_cast<int>(layer)); }

bool both_make(Layer layer) { return (layer_bit(layer) & kLedgerLayers) == 0; }

bool compares(Mode mode) { return mode == Mode::difference || mode == Mode::causes || mode == Mode::ledger; }

}  // namespace sidelight
