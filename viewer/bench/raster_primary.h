// SPDX-License-Identifier: MIT
// The ray tracer with the z-buffer's answer to what each sample shows, in place of eye rays. Both name the same surface at
// the same depth, so not one bit of the picture changes; what does is who did the work. The one place where a picture
// takes both renderers: neither knows of the other.
#pragma once

#include "raster/raster.h"
#include "raytrace/raytrace.h"

namespace sidelight {

// Layers: kAllLayers but cost, which counts the tests of eye rays. No faults. Its time is that of both renderers, told
// apart in stats.stages (the z-buffer shades what it finds, too); its counts are the ray tracer's.
Frame render_from_raster(const raster::Prepared& finds, const raytrace::Prepared& traces,
                         const Camera& camera, const RenderOptions& options);

}  // namespace sidelight
