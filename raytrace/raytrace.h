// SPDX-License-Identifier: MIT
// The recursive ray tracer (Whitted): for each sample, for each object its ray may meet, keep the nearest; then
// local light with shadows, plus what the mirrored and the refracted ray see. The only public header of this folder.
#pragma once

#include <atomic>
#include <memory>

#include "common/error.h"
#include "common/model/explanation.h"
#include "common/picture/frame.h"
#include "common/scene/camera.h"
#include "common/scene/needs.h"
#include "common/scene/scene.h"

namespace sidelight::raytrace {

class Prepared;  // the bounding volume hierarchy and whatever else depends on the scene only

// `scene` must outlive the result. Its time is a renderer's build time.
std::shared_ptr<const Prepared> prepare(const Scene& scene, int threads = 0);
// The same, entering also what `needs` claims beyond needs_of(scene). Not one bit of the picture changes.
std::shared_ptr<const Prepared> prepare_for(const Needs& needs, const Scene& scene, int threads = 0);

// The picture, as scene.trace asks for (depth, cut, switches). Layers: kAllLayers. Throws Interrupted when
// options.cancel is raised, and UsageError for options.primary with what only the tracer's own eye rays have: faults and
// the layer cost.
Frame render(const Prepared& prepared, const Camera& camera, const RenderOptions& options);

// The same picture, sample by sample by the recursion: the readable twin, for tests.
Frame render_recursively(const Prepared& prepared, const Camera& camera, const RenderOptions& options);

// The same rays with their light in double, for a reference image: only a finished sample is rounded to float, and once
// more the mean of a pixel's samples.
Frame render_in_double(const Prepared& prepared, const Camera& camera, const RenderOptions& options);

// The tree of rays behind the sample at lattice position (X, Y), told by the code that render() runs: its root's colour
// is that sample's, bit for bit.
RayRecord explain(const Prepared& prepared, const Camera& camera, int X, int Y);

// What trees of rays may take together: behind a few sheets of glass each level doubles them.
// Rays, the lights of their surfaces and surfaces passed are records: one less is left for each that is told of.
struct ExplainBudget {
  std::size_t records;
  const std::atomic<bool>* cancel = nullptr;
};
// Thrown where the records do not suffice.
class TooManyRays : public UsageError {
 public:
  TooManyRays() : UsageError("too many rays to explain") {}
};
// The same within `budget`. Throws Interrupted when its `cancel` is raised.
RayRecord explain(const Prepared& prepared, const Camera& camera, int X, int Y, ExplainBudget& budget);

// Brute force in double, as the lecture writes it: the text to read first, and the oracle of render().
// Layers: kRaytraceLayers.
Frame render_reference(const Scene& scene, const Camera& camera, const RenderOptions& options);

}  // namespace sidelight::raytrace
