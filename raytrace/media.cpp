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

// Whether surfaces of two solids may lie together. A grazing ray alone cannot tell: to it, much lies close.
bool meets(const Prepared& prepared, std::uint32_t a, std::uint32_t b) {
  if (a == b) return true;
  const auto bounds = [&](std::uint32_t solid) {
    const auto at = std::lower_bound(prepared.solids.begin(), prepared.solids.end(), solid);
    return prepared.bounds[static_cast<std::size_t>(at - prepared.solids.begin())];
  };
  return bounds(a).meets(bounds(b));
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
  const Scene& scene = prepared.scene;
  const auto cross_at = [&](const Hit& each) {
    const std::uint32_t object = scene.primitive_object[each.primitive];
    if (scene.objects[object].solid && meets(prepared, object, surface.object))
      cross(behind, object, each == hit ? surface.entering : locate(scene, ray, each, counts).entering);
  };
  const ObjectKind kind = scene.objects[surface.object].kind;
  if (!prepared.needs[Need::overlapping_solids] && kind != ObjectKind::mesh) {
    // Only the solid's own surface can lie together with the hit, a ball's far side: no need to search the scene.
    cross_at(hit);
    const Hit far_side = kind == ObjectKind::sphere ? intersect(scene, hit.primitive, ray, hit, counts) : Hit{};
    if (far_side.found() && far_side.t <= surface.together) cross_at(far_side);
    return behind;
  }
  for (const Hit& each : hits_between(prepared, ray, hit, surface.together, counts)) cross_at(each);
  return behind;
}

}  // namespace sidelight::raytrace
