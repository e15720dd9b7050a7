// SPDX-License-Identifier: MIT
// The four renderers by name: the one place that knows both folders.
#pragma once

#include <array>
#include <string_view>

#include "common/picture/frame.h"
#include "viewer/commands/job.h"

namespace sidelight {

struct TimedFrame {
  Frame frame;
  double build_ms = 0, frame_ms = 0;
};

struct Renderer {
  std::string_view name;
  std::string_view label;  // for progress and captions
  LayerMask layers;        // what it can make
  TimedFrame (*render)(const Job& job, const Camera& camera, const RenderOptions& options);
  // Renders `repeat` times after one warm-up with the eye moving, then the picture itself; times go to the vectors.
  TimedFrame (*measure)(const Job& job, const RenderOptions& options, int repeat,
                        std::vector<double>& frame_ms, std::vector<double>& cpu_ms);
};

extern const std::array<Renderer, 4> kRenderers;  // raster, raytrace, raster-reference, raytrace-reference

// raytrace with the z-buffer's surfaces in place of eye rays (--primary raster): the same picture, without the layer cost.
extern const Renderer kRaytraceFromRaster;

// Null for an unknown name.
const Renderer* find_renderer(std::string_view name);

// Throws NumericalFault, with the label and the place, where a value of the frame is not finite.
void check_finite(const Frame& frame, std::string_view label);

// The job's picture with all that the renderer can make, and a progress bar meanwhile. Throws NumericalFault.
TimedFrame render_all_layers(const Job& job, const Renderer& renderer);

}  // namespace sidelight
