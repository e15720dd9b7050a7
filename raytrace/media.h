// SPDX-License-Identifier: MIT
// Inside which solids a ray travels, and so in which medium: the containing solid that comes last in the file, index
// 1 outside all. Crossing an outward side enters, any other leaves, and doing it twice changes nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "raytrace/prepared.h"

namespace sidelight::raytrace {

class Media {
 public:
  void enter(std::uint32_t solid);
  void leave(std::uint32_t solid);

  // The object whose medium this is; kNone outside all solids.
  std::uint32_t current() const { return inside_.empty() ? kNone : inside_.back(); }
  double ior(const Scene& scene) const { return inside_.empty() ? 1.0 : scene.objects[current()].ior; }

 private:
  std::vector<std::uint32_t> inside_;   // objects, ascending
};

// The solids that contain the eye.
Media media_at(const Prepared& prepared, const glm::dvec3& eye);

// The media behind a hit at `surface`. Surfaces that lie together (Place::together) are crossed together: glass that
// touches water passes light from one to the other, with no film of air in between.
Media media_behind(const Prepared& prepared, const Ray& ray, const Hit& hit, const Surface& surface,
                   const Media& media, SignCounts& counts);

}  // namespace sidelight::raytrace
