// SPDX-License-Identifier: MIT
#include "viewer/bench/raster_primary.h"

#include "common/clock.h"

namespace sidelight {

Frame render_from_raster(const raster::Prepared& finds, const raytrace::Prepared& traces,
                         const Camera& camera, const RenderOptions& options) {
  RenderOptions samples = options;
  samples.layers = 0;
  samples.keep_samples = true;
  samples.progress = {};
  LapClock clock;
  const Frame found = raster::render(finds, camera, samples);
  const double raster_ms = clock.lap_ms();
  RenderOptions from_there = options;
  from_there.primary = &found;
  Frame frame = raytrace::render(traces, camera, from_there);
  frame.stats.stages = {{"raster", raster_ms}, {"raytrace", clock.lap_ms()}};
  return frame;
}

}  // namespace sidelight
