// SPDX-License-Identifier: MIT
// The z-buffer: for each object, for each sample it may cover, keep the nearest; then shade what is visible, with
// the local model only (every light unshadowed). The only public header of this folder.
#pragma once

#include <memory>

#include "common/model/explanation.h"
#include "common/picture/frame.h"
#include "common/scene/camera.h"
#include "common/scene/needs.h"
#include "common/scene/scene.h"

namespace sidelight::raster {

class Prepared;  // what depends on the scene only, and so survives a frame

// `scene` must outlive the result. Its time is a renderer's build time. One thread does it all: `threads` is there so that
// both renderers are called alike.
std::shared_ptr<const Prepared> prepare(const Scene& scene, int threads = 0);
// The same, entering also what `needs` claims beyond needs_of(scene). Not one bit of the picture changes.
std::shared_ptr<const Prepared> prepare_for(const Needs& needs, const Scene& scene);

// The picture. Layers: kRasterLayers and cost. Throws Interrupted when options.cancel is raised.
Frame render(const Prepared& prepared, const Camera& camera, const RenderOptions& options);

// What competed for the sample at lattice position (X, Y) and how the winner was lit, told by the code that render()
// runs: its colour is that sample's, bit for bit.
RasterRecord explain(const Prepared& prepared, const Camera& camera, int X, int Y);

// The lecture's loop, in double, one sample at a time: the text to read first, and the oracle of render().
// Layers: kRasterLayers.
Frame render_reference(const Scene& scene, const Camera& camera, const RenderOptions& options);

}  // namespace sidelight::raster
