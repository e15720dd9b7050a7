// SPDX-License-Identifier: MIT
#include "raytrace/media.h"

#include <algorithm>

#include "common/model/solid.h"

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
  return prepared.bounds[prepared.place_of(a)].meets(prepared.bounds[prepared.place_of(b)]);
}

}  // namespace

// Where the solid is, or belongs.
std::size_t Media::place_of(std::uint32_t solid) const {
  return static_cast<std::size_t>(std::lower_bound(begin(), begin() + size_, solid) - begin());
}

bool Media::operator<(const Media& other) const {
  if (certain_ != other.certain_) return certain_ < other.certain_;
  return std::lexicographical_compare(begin(), begin() + size_, other.begin(), other.begin() + other.size_);
}

void Media::enter(std::uint32_t solid) {
  const std::size_t at = place_of(solid);
  if (at < size_ && begin()[at] == solid) return doubt();
  if (size_ == kFew && many_.empty()) many_.assign(few_.begin(), few_.end());
  if (many_.empty()) {
    std::copy_backward(few_.begin() + at, few_.begin() + size_, few_.begin() + size_ + 1);
    few_[at] = solid;
  } else {
    many_.insert(many_.begin() + static_cast<std::ptrdiff_t>(at), solid);
  }
  ++size_;
}

void Media::leave(std::uint32_t solid) {
  const std::size_t at = place_of(solid);
  if (at == size_ || begin()[at] != solid) return doubt();
  if (many_.empty())
    std::copy(few_.begin() + at + 1, few_.begin() + size_, few_.begin() + at);
  else
    many_.erase(many_.begin() + static_cast<std::ptrdiff_t>(at));
  --size_;
}

Media media_at(const Prepared& prepared, const glm::dvec3& eye) {
  Media media;
  media.certain_ = true;
  for (std::size_t i = 0; i < prepared.solids.size(); ++i) {
    const Object& solid = prepared.scene.objects[prepared.solids[i]];
    if (contains(prepared.scene, solid, eye)) media.enter(prepared.solids[i]);
    if (solid.kind == ObjectKind::mesh && prepared.bounds[i].meets({eye, eye})) media.doubt();
  }
  return media;
}

Media media_behind(const Prepared& prepared, const Ray& ray, const Hit& hit, const Surface& surface,
                   const Media& media, VisibilityCounts& counts) {
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
    const Hit far_side =
        kind == ObjectKind::sphere ? intersect(scene, hit.primitive, ray, hit, counts) : Hit{};
    if (far_side.found() && far_side.t <= surface.together) cross_at(far_side);
    return behind;
  }
  behind.doubt();
  for (const Hit& each : hits_between(prepared, ray, hit, surface.together, counts)) cross_at(each);
  return behind;
}

Media media_behind_lone(const Prepared& prepared, std::uint32_t object, bool entering, const Media& media) {
  Media behind = media;
  if (!prepared.solids.empty() && prepared.scene.objects[object].solid) cross(behind, object, entering);
  return behind;
}

}  // namespace sidelight::raytrace
