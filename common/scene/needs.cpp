// SPDX-License-Identifier: MIT
#include "common/scene/needs.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "common/math/norms.h"

namespace sidelight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool positive(const glm::dvec3& color) { return color.x > 0 || color.y > 0 || color.z > 0; }
bool falls(const Attenuation& q) { return q.q0 != 1 || q.q1 != 0 || q.q2 != 0; }

Bounds padded(Bounds bounds) {
  double reach = 0;
  for (int i = 0; i < 3; ++i) reach = std::max({reach, std::abs(bounds.low[i]), std::abs(bounds.high[i])});
  return {bounds.low - 0x1p-30 * reach, bounds.high + 0x1p-30 * reach};
}

// The half-space { p : n . (p - point) <= 0 }.
Bounds bounds_of_plane(const Plane& plane) {
  Bounds bounds{glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
  for (int i = 0; i < 3; ++i) {
    const double pad = 0x1p-30 * std::abs(plane.point[i]);
    if (plane.normal[i] == 1) bounds.high[i] = plane.point[i] + pad;
    if (plane.normal[i] == -1) bounds.low[i] = plane.point[i] - pad;
  }
  return bounds;
}

// The axis along which bounded solids begin farthest apart: across a row of balls, all of them would be open at once.
int axis_of_rows(std::span<const Bounds> solids) {
  glm::dvec3 least(kInfinity), most(-kInfinity);
  for (const Bounds& solid : solids) {
    if (!std::isfinite(solid.low.x + solid.low.y + solid.low.z)) continue;
    least = glm::min(least, solid.low);
    most = glm::max(most, solid.low);
  }
  const glm::dvec3 spread = most - least;
  return greatest_axis(spread.x, spread.y, spread.z);
}

// Or may, where they are too many to be sure.
bool any_solids_meet(const Scene& scene) {
  std::vector<Bounds> solids;
  for (const Object& object : scene.objects)
    if (object.solid) solids.push_back(bounds_of(scene, object));
  return !visit_meeting(solids, [](std::size_t, std::size_t) { return false; });
}

}  // namespace

bool Bounds::meets(const Bounds& other) const {
  for (int i = 0; i < 3; ++i)
    if (high[i] < other.low[i] || other.high[i] < low[i]) return false;
  return true;
}

Bounds bounds_of(const Scene& scene, const Object& object) {
  if (object.kind == ObjectKind::plane) return bounds_of_plane(scene.planes[object.first]);
  if (object.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene.spheres[object.first];
    return padded({sphere.center - sphere.radius, sphere.center + sphere.radius});
  }
  Bounds bounds{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
  for (std::uint32_t i = object.first; i < object.first + object.count; ++i)
    for (const std::uint32_t v : scene.triangles[i].vertex) {
      bounds.low = glm::min(bounds.low, scene.positions[v]);
      bounds.high = glm::max(bounds.high, scene.positions[v]);
    }
  return padded(bounds);
}

// Sweep: those that are open when one begins are all it can meet.
bool visit_meeting(std::span<const Bounds> bounds,
                   const std::function<bool(std::size_t, std::size_t)>& visit) {
  const int axis = axis_of_rows(bounds);
  std::vector<std::size_t> by_begin(bounds.size()), open;
  std::iota(by_begin.begin(), by_begin.end(), std::size_t{0});
  std::ranges::sort(by_begin, {}, [&](std::size_t i) { return bounds[i].low[axis]; });
  std::size_t looks = 0;
  for (const std::size_t now : by_begin) {
    looks += open.size();
    if (looks > kMostLooks) return false;
    std::erase_if(open, [&](std::size_t other) { return bounds[other].high[axis] < bounds[now].low[axis]; });
    for (const std::size_t other : open)
      if (bounds[other].meets(bounds[now]) && !visit(other, now)) return false;
    open.push_back(now);
  }
  return true;
}

Needs needs_of(const Scene& scene) {
  Needs needs;
  std::vector<char> used(scene.materials.size(), 0);
  for (const Sphere& sphere : scene.spheres) used[sphere.material] = 1;
  for (const Plane& plane : scene.planes) used[plane.material] = 1;
  for (const Triangle& triangle : scene.triangles) used[triangle.material] = 1;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    needs[Need::mirrors] |= scene.trace.reflection && positive(scene.materials[i].reflect);
    needs[Need::refraction] |= scene.trace.refraction && positive(scene.materials[i].refract);
  }
  needs[Need::overlapping_solids] = needs[Need::refraction] && any_solids_meet(scene);
  needs[Need::secondary_attenuation] = needs.secondary_rays() && falls(scene.trace.secondary_attenuation);
  for (const Light& light : scene.lights) {
    needs[Need::live_lights] |= positive(light.intensity);
    needs[Need::light_attenuation] |=
        positive(light.intensity) && !light.directional && falls(light.attenuation);
  }
  needs[Need::spheres] = !scene.spheres.empty();
  needs[Need::planes] = !scene.planes.empty();
  needs[Need::meshes] = !scene.triangles.empty();
  return needs;
}

}  // namespace sidelight
