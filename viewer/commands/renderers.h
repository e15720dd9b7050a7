// SPDX-License-Identifier: MIT
// The four renderers by name: the one place that knows both folders.
#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "common/picture/frame.h"
#include "viewer/commands/job.h"

namespace sidelight {

struct TimedFrame {
  Frame frame;
  double build_ms = 0, frame_ms = 0;
};

using FrameMaker = std::function<Frame(const Camera& camera, const RenderOptions& options)>;

struct Renderer {
  std::string_view name;
  std::string_view label;  // for progress and captions
  LayerMask layers;        // what it can make
  // Does what depends on the scene only, which must outlive the maker of frames.
  FrameMaker (*prepare)(const Scene& scene, int threads);
};

extern const std::array<Renderer, 4> kRenderers;  // raster, raytrace, raster-reference, raytrace-reference

// Null for an unknown name.
const Renderer* find_renderer(std::string_view name);

// The renderer, or with --primary raster what stands for raytrace: the same picture, without the layer cost. Throws
// UsageError where the flag cannot serve: for another renderer, and with faults on purpose.
const Renderer& with_primary(const Job& job, const Renderer& renderer);

// The job's picture.
TimedFrame render_once(const Job& job, const Renderer& renderer, const RenderOptions& options);
// The same after one warm-up and `repeat` frames with the eye moving, whose times go to the vectors.
TimedFrame render_repeatedly(const Job& job, const Renderer& renderer, int repeat,
                             std::vector<double>& frame_ms, std::vector<double>& frame_cpu_ms);

// Throws NumericalFault, with the label and the place, where a value of the frame is not finite.
void check_finite(const Frame& frame, std::string_view label);

// The job's picture with all that the renderer can make, and a progress bar meanwhile. Throws NumericalFault.
TimedFrame render_all_layers(const Job& job, const Renderer& renderer);

}  // namespace sidelight
