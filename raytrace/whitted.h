// SPDX-License-Identifier: MIT
// The recursion: what light comes back along a ray. Reads like the lecture's pseudo-code; all geometry is asked of
// prepared.h, all light of common/model.
#pragma once

#include <glm/vec3.hpp>

#include "common/picture/frame.h"
#include "raytrace/media.h"
#include "raytrace/prepared.h"

namespace sidelight::raytrace {

// A ray on its way, with what the recursion needs to know about its past.
struct Path {
  Ray ray;
  Hit start = kRayStart;   // hits up to here lie behind it already
  Media media;             // where it travels
  int depth = 1;           // rays along the path, this one included
  double weight = 1;       // product of the largest channels of c2, c3 along the path
};

// What a ray brings back: color = (unshadowed - shadow) + mirrored + refracted, up to rounding; the terms of DESIGN
// section 2 for an eye ray. The first three parts of `unshadowed` are its ambient, diffuse and specular light.
struct Traced {
  glm::vec3 color{0};
  glm::vec3 ambient{0}, diffuse{0}, specular{0};
  glm::vec3 shadow{0}, mirrored{0}, refracted{0};
  Hit hit;
  std::uint32_t object = kNone;
  glm::vec3 normal{0};
};

class Whitted {
 public:
  Whitted(const Prepared& prepared, RenderStats& stats) : prepared_(prepared), scene_(prepared.scene), stats_(stats) {}

  Traced trace(const Path& path);

 private:
  void add_local(const Surface& surface, const Ray& ray, Traced& out);
  bool lit(const Surface& surface, const Light& light);
  void add_secondary(const Path& path, const Surface& surface, Traced& out);
  glm::vec3 follow(Path path, const glm::dvec3& c, std::uint64_t& counter);

  const Prepared& prepared_;
  const Scene& scene_;
  RenderStats& stats_;
};

}  // namespace sidelight::raytrace
