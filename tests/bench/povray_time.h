// SPDX-License-Identifier: MIT
// How long POV-Ray takes for a scene.
#pragma once

#include <optional>

#include "common/scene/scene.h"

namespace sidelight::bench {

// Processor seconds of one thread of Debian's povray for the scene's picture, without reading the file; empty where
// there is no povray, or it fails.
std::optional<double> povray_seconds(const Scene& scene);

}  // namespace sidelight::bench
