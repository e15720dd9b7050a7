// SPDX-License-Identifier: MIT
// The flags of the faults on purpose (common/model/faults.h), for the verbs that render: one table of them.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "common/model/faults.h"
#include "common/scene/scene.h"

namespace sidelight {

struct FaultFlags {
  std::optional<double> shadow_offset, near_plane, far_plane;
  std::optional<int> snap_bits, tessellate;
  std::string depth_format, precision;
};

void add_fault_flags(CLI::App& verb, FaultFlags& flags);

// The faults that the flags ask for; near and far are 1e-3 and 1e3 times the eye's distance to what it looks at, unless
// given. Throws UsageError.
Faults parse_faults(const FaultFlags& flags, const CameraSettings& camera);

// Throws UsageError where the renderer of that name does not make one of the faults.
void check_makes_faults(std::string_view renderer, const Faults& faults);

// The same as arguments: " --snap-bits 4". Empty without faults.
std::string fault_arguments(const Faults& faults);

}  // namespace sidelight
