// SPDX-License-Identifier: MIT
// A fault on purpose: vertices on a grid of fractions of a pixel, as graphics hardware rounds them before set-up.
#pragma once

#include "common/scene/camera.h"
#include "common/scene/scene.h"

namespace sidelight::raster {

// The scene as this camera sees it with every vertex in front of the eye moved, at its own viewing depth, to the
// nearest multiple of 2^-bits pixels on the screen. Vertices behind the eye, those that lie on the grid already (as
// far as rounding can tell) and those beyond 2^20 pixels from the picture stay where they are.
Scene snapped(const Scene& scene, const Camera& camera, int bits);

}  // namespace sidelight::raster
