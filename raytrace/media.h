// SPDX-License-Identifier: MIT
// Inside which solids a ray travels, and so in which medium: the containing solid that comes last in the file, index
// 1 outside all. Crossing an outward side enters, any other leaves, and doing it twice changes nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raytrace/prepared.h"

namespace sidelight::raytrace {

class Media {
 public:
  void enter(std::uint32_t solid);
  void leave(std::uint32_t solid);

  // The object whose medium this is; kNone outside all solids.
  std::uint32_t current() const { return size_ == 0 ? kNone : begin()[size_ - 1]; }
  double ior(const Scene& scene) const { return size_ == 0 ? 1.0 : scene.objects[current()].ior; }

  // Whether meshes of this set surely wind around the point, however they overlap themselves: so it is where no mesh did at
  // the eye, and since then each crossing was found alone, into what was outside before or out of what was inside.
  // Set by media_at(), lost with the first crossing of another kind, or by doubt().
  bool certain() const { return certain_; }
  void doubt() { certain_ = false; }

  bool operator<(const Media& other) const;  // some total order

 private:
  friend Media media_at(const Prepared& prepared, const glm::dvec3& eye);

  static constexpr std::size_t kFew = 3;

  const std::uint32_t* begin() const { return many_.empty() ? few_.data() : many_.data(); }
  std::size_t place_of(std::uint32_t solid) const;

  // Objects, ascending: a few, as nearly always, or any number.
  std::uint32_t size_ = 0;
  bool certain_ = false;
  std::array<std::uint32_t, kFew> few_{};
  std::vector<std::uint32_t> many_;  // in place of the few, where there are more
};

// The solids that contain the eye.
Media media_at(const Prepared& prepared, const glm::dvec3& eye);

// The media behind a hit at `surface`. Surfaces that lie together (Place::together) are crossed together: glass that
// touches water passes light from one to the other, with no film of air in between. Of the surface object, entering and
// together are read.
Media media_behind(const Prepared& prepared, const Ray& ray, const Hit& hit, const Surface& surface,
                   const Media& media, VisibilityCounts& counts);
// The same of a lone hit (lone_hit.h): there is nothing to search for.
Media media_behind_lone(const Prepared& prepared, std::uint32_t object, bool entering, const Media& media);

}  // namespace sidelight::raytrace
