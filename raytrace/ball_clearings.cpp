// SPDX-License-Identifier: MIT
#include "raytrace/ball_clearings.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "raytrace/kernels.h"
#include "raytrace/near_kernel.h"

namespace sidelight::raytrace {

BallClearings::BallClearings(const Prepared& prepared, double room, int patience)
    : prepared_(prepared),
      room_(room),
      patience_(patience),
      asked_(prepared.scene.spheres.size()),
      others_(prepared.scene.spheres.size()) {}

// Near is what near_spheres() of the point would visit.
bool BallClearings::contain(std::uint32_t primitive, const glm::dvec3& point, double room, Isa isa) {
  const Scene& scene = prepared_.scene;
  const Others* others = others_of(primitive, primitive_ref(scene, primitive).index, isa);
  if (!others || others->count > Others::kMost) return false;
  return std::none_of(others->spheres.begin(), others->spheres.begin() + others->count, [&](std::uint32_t i) {
    const Sphere& other = scene.spheres[i];
    const glm::dvec3 f = point - other.center;
    return is_near_sphere<double>({f.x, f.y, f.z}, other.radius, room);
  });
}

// Nothing where that is not known yet. Two threads may count one question, or find the same.
const BallClearings::Others* BallClearings::others_of(std::uint32_t primitive, std::uint32_t sphere,
                                                      Isa isa) {
  const std::atomic_ref<const Others*> kept(others_[sphere]);
  if (const Others* known = kept.load(std::memory_order_acquire)) return known;
  const std::atomic_ref<std::uint8_t> asked(asked_[sphere]);
  const int times = asked.load(std::memory_order_relaxed) + 1;
  if (times < patience_) {
    asked.store(static_cast<std::uint8_t>(times), std::memory_order_relaxed);
    return nullptr;
  }
  const Others others = find_others(primitive, prepared_.scene.spheres[sphere], isa);
  const std::lock_guard lock(adding_);
  const Others* added = &found_.emplace_back(others);
  kept.store(added, std::memory_order_release);
  return added;
}

// Twice the room more than is asked for covers all rounding, of a point on the ball, too.
BallClearings::Others BallClearings::find_others(std::uint32_t primitive, const Sphere& ball, Isa isa) const {
  const Scene& scene = prepared_.scene;
  const Others none_clear{Others::kMost + 1, {}};
  const double reach = ball.radius + 4 * room_;
  for (const Plane& plane : scene.planes)
    if (std::abs(glm::dot(plane.normal, ball.center - plane.point)) <= reach) return none_clear;
  const Kernels& kernels = kernels_for(isa);
  bool flat = false;
  auto found_flat = [&](std::uint32_t) { flat = true; };
  if (!prepared_.triangles.bvh.nodes.empty())
    kernels.near_triangles(prepared_.triangles, {ball.center, reach, kNone, visitor_of(found_flat), &flat});
  if (flat) return none_clear;

  Others others;
  bool many = false;
  auto add = [&](std::uint32_t other) {
    const std::uint32_t i = primitive_ref(scene, other).index;
    const Sphere& sphere = scene.spheres[i];
    if (std::abs(glm::distance(sphere.center, ball.center) - sphere.radius) > reach) return;
    many = others.count == Others::kMost;
    if (!many) others.spheres[others.count++] = i;
  };
  kernels.near_spheres(prepared_.spheres, {ball.center, reach, primitive, visitor_of(add), &many});
  return many ? none_clear : others;
}

}  // namespace sidelight::raytrace
