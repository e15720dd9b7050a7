// SPDX-License-Identifier: MIT
// Why the inspected pixel has its colour: the records that both renderers' own code tells (common/model/explanation.h),
// as `sidelight explain` prints them. The records are of the exact answers, whatever faults on purpose are on; but the
// facets of a tessellation are told of, since they are the scene that is drawn.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/model/explanation.h"
#include "viewer/report/explain_words.h"
#include "viewer/window/state.h"

namespace sidelight {

struct Inspection {
  glm::ivec2 pixel{0};
  std::shared_ptr<const Scene> scene;
  double asked_ms = 0;  // of the task whose picture it explains
  Camera camera;
  std::vector<ExplainedSample> samples;  // all of the pixel's, row by row
  // (n/2, n/2), whose ids and depth the picture has, and whose lobe and rays are drawn.
  const ExplainedSample& middle() const {
    return samples[static_cast<std::size_t>((camera.n / 2) * camera.n + camera.n / 2)];
  }
  bool too_many_rays = false;  // to be told of: then every sample's tree is empty
};

// A ray of the pixel, to be drawn into the pictures: from a surface to what it met, or to its light.
enum class SegmentKind { mirrored, refracted, straight, light_seen, light_blocked };
struct RaySegment {
  glm::dvec3 from{0}, to{0};
  SegmentKind kind{};
};
// Of the tree under the middle sample; the eye ray is a point in this picture and left out. A ray that meets nothing, or
// goes to a light infinitely far, ends a few times the eye's distance away.
std::vector<RaySegment> ray_segments(const Inspection& inspection);

// The specular lobe of the middle sample's first surface under one light, in the plane of the lecture's plot: angles in
// radians.
struct Lobe {
  std::size_t light = 0;
  double shininess = 1;
  double light_angle = 0;       // between N and L, and so between N and Rl
  double view_angle = 0;        // between Rl and V
  bool towards_normal = false;  // V, which need not lie in this plane, is shown on the normal's side of Rl
  double value = 0;             // max(0, cos view_angle)^s, as the renderers have it
};
// Of the light that shines on the pixel most by its specular term; nothing on the background or in the dark.
std::optional<Lobe> specular_lobe(const Inspection& inspection);

// Of the view that `pictures` show, by the renderers that drew them. Nothing if no pixel is inspected, or if the tracer's
// picture is still an earlier view's.
std::optional<Inspection> inspect_pixel(const WindowState& state, const Pictures& pictures);

// What one renderer says of the pixel, in the words of `explain`: of several samples the middle one first, which is told
// apart.
std::string inspected_words(const Inspection& inspection, Side side);

// What the words of an inspection leave out of the faults that are on, and what not; empty without any.
std::string told_of_faults(const Faults& faults);

}  // namespace sidelight
