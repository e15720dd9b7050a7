// SPDX-License-Identifier: MIT
// The peer of the tracer: what a program with Embree draws of a scene, in single precision, with rays that leave a
// surface by a small offset. Whole frames come from a plain recursive shader over single rays, by the rules of the
// tracer's model, but for glass, which a ray is in after its last surface said so. Eye rays, and eye rays with shadow
// rays, also go in packets of 16 (4x4 pixels, marked coherent), and are shaded as cheaply as can be: by the angle of the
// triangle alone, so that the time is Embree's.
#pragma once

#include <cstdint>
#include <vector>

#include "common/scene/camera.h"
#include "tests/bench/embree_scene.h"

namespace sidelight::bench {

enum class RayKind { eye, eye_and_shadow, whole };

struct EmbreePicture {
  std::vector<glm::vec3> color;  // row by row, top row first
  std::uint64_t rays = 0;        // queries made
};

class EmbreeTracer {
 public:
  EmbreeTracer(const Scene& scene, int threads);

  void build() { hierarchy_.build(); }
  // `packets`: not for whole frames.
  EmbreePicture draw(const Camera& camera, RayKind kind, bool packets) const;
  // How many of a picture's eye rays, of a camera of one row, do not meet one of the first `triangles` triangles.
  std::uint64_t misses(const Camera& camera, std::uint32_t triangles, bool packets) const;

 private:
  const Scene& scene_;
  int threads_;
  EmbreeScene hierarchy_;
};

}  // namespace sidelight::bench
