// SPDX-License-Identifier: MIT
#include "raytrace/clearings.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "raytrace/kernels.h"
#include "raytrace/lone_hit.h"

namespace sidelight::raytrace {

// Weights are off by 2^-50 or so of a triangle's longest side over its height, which moves a point by less than the room
// is rounded up here.
Clearings::Clearings(const Prepared& prepared, int patience)
    : prepared_(prepared), room_((1 + 0x1p-10) * room_for(prepared.reach, 4 * prepared.reach)) {
  if (!prepared.needs.secondary_rays()) return;
  inset_.assign(prepared.scene.triangles.size(), static_cast<float>(-patience));
  balls_.emplace(prepared, room_, patience);
}

bool Clearings::contain(std::uint32_t primitive, const glm::dvec3& point, double room, Isa isa) {
  if (!balls_ || !((1 + 0x1p-10) * room <= room_)) return false;
  const auto [kind, triangle] = primitive_ref(prepared_.scene, primitive);
  if (kind == ObjectKind::sphere) return balls_->contain(primitive, point, room, isa);
  if (kind == ObjectKind::plane) return false;
  const double inset = inset_of(primitive, triangle, isa);
  if (inset < 0 || inset >= 1) return false;
  const auto [v0, v1, v2] = corners(prepared_.scene, prepared_.scene.triangles[triangle]);
  const glm::dvec3 e1 = v1 - v0, e2 = v2 - v0, q = point - v0, n = glm::cross(e1, e2);
  const double whole = glm::dot(n, n), least = inset * whole;
  const double second = glm::dot(glm::cross(q, e2), n), third = glm::dot(glm::cross(e1, q), n);
  return second >= least && third >= least && whole - second - third >= least;
}

// Negative where it is not known. Two threads may count one question, or find the same.
double Clearings::inset_of(std::uint32_t primitive, std::uint32_t triangle, Isa isa) {
  const std::atomic_ref<float> kept(inset_[triangle]);
  float inset = kept.load(std::memory_order_relaxed);
  if (inset >= 0) return inset;
  inset += 1;
  if (inset >= 0) inset = static_cast<float>(find_inset(primitive, isa));
  kept.store(inset, std::memory_order_relaxed);
  return inset;
}

double Clearings::find_inset(std::uint32_t primitive, Isa isa) const {
  const Scene& scene = prepared_.scene;
  const Corners own = corners(scene, scene.triangles[primitive_ref(scene, primitive).index]);
  if (others_near(own, isa)) return 1;
  const double inset = kernels_for(isa).inset(prepared_.triangles, {own, room_, primitive});
  return std::min(1.0, (1 + 0x1p-10) * inset);
}

// Planes and spheres, as near as the triangle is large.
bool Clearings::others_near(const Corners& own, Isa isa) const {
  const Scene& scene = prepared_.scene;
  const glm::dvec3 middle = (own.v0 + own.v1 + own.v2) / 3.0;
  const double size = std::max({glm::distance(own.v0, middle), glm::distance(own.v1, middle),
                                glm::distance(own.v2, middle)}) +
                      2 * room_;
  for (const Plane& plane : scene.planes)
    if (std::abs(glm::dot(plane.normal, middle - plane.point)) <= size) return true;
  bool any = false;
  auto found = [&](std::uint32_t) { any = true; };
  if (!prepared_.spheres.bvh.nodes.empty())
    kernels_for(isa).near_spheres(prepared_.spheres, {middle, size, kNone, visitor_of(found), &any});
  return any;
}

}  // namespace sidelight::raytrace
