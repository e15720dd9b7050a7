// SPDX-License-Identifier: MIT
#include "raytrace/media.h"

#include <algorithm>

namespace sidelight::raytrace {
namespace {

void cross(Media& media, std::uint32_t object, bool entering) {
  if (entering)
    media.enter(object);
  else
    media.leave(object);
}

}  // namespace

void Media::enter(std::uint32_t solid) {
  const auto at = std::lower_bound(inside_.begin(), inside_.end(), solid);
  if (at == inside_.end() || *at != solid) inside_.insert(at, solid);
}

void Media::leave(std::uint32_t solid) {
  const auto at = std::lower_bound(inside_.begin(), inside_.end(), solid);
  if (at != inside_.end() && *at == solid) inside_.erase(at);
}

Media media_at(const Prepared& prepared, const glm::dvec3& eye) {
  Media media;
  for (const std::uint32_t solid : prepared.solids)
    if (contains(prepared.scene, prepared.scene.objects[solid], eye)) media.enter(solid);
  return media;
}

Media media_behind(const Prepared& prepared, const Ray& ray, const Hit& hit, const Surface& surface,
                   const Media& media, SignCounts& counts) {
  Media behind = media;
  if (prepared.solids.empty() || !prepared.scene.objects[surface.object].solid) return behind;
  if (prepared.solids.size() == 1) {
    cross(behind, surface.object, surface.entering);
    return behind;
  }
  for (const Hit& each : hits_between(prepared, ray, hit, surface.together, counts)) {
    const std::uint32_t object = prepared.scene.primitive_object[each.primitive];
    if (prepared.scene.objects[object].solid)
      cross(behind, object, locate(prepared.scene, ray, each, counts).entering);
  }
  return behind;
}

}  // namespace sidelight::raytrace
