// SPDX-License-Identifier: MIT
// What leaves a level's hits, and what it brings back.
#include "raytrace/wave.h"

namespace sidelight::raytrace {

bool is_entering(const Scene& scene, const Ray& ray, const Hit& hit, const glm::dvec3& facing) {
  const PrimitiveRef ref = primitive_ref(scene, hit.primitive);
  if (ref.kind == ObjectKind::sphere)
    return glm::dot(facing, (ray.origin - scene.spheres[ref.index].center) + hit.t * ray.direction) > 0;
  if (ref.kind == ObjectKind::plane) return glm::dot(facing, scene.planes[ref.index].normal) > 0;
  const auto [v0, v1, v2] = corners(scene, scene.triangles[ref.index]);
  return glm::dot(facing, glm::cross(v1 - v0, v2 - v0)) > 0;
}

// What departures() reads of a surface; of a lone one `together` is not asked for.
Surface Wave::surface_of(const Level& level, const HitBatch& batch, std::size_t i, const Ray& ray,
                         bool lone) const {
  const Hit& hit = level.hits[batch.ray[i]];
  Surface surface;
  surface.object = scene_.primitive_object[hit.primitive];
  surface.material = batch.material[i];
  surface.normal = get(batch.normal, i);
  surface.facing = get(batch.facing, i);
  surface.clearance = batch.clearance[i];
  if (!lone) surface.together = together_depth(ray, hit, surface);
  surface.entering = is_entering(scene_, ray, hit, surface.facing);
  return surface;
}

// Whether a hit on a solid is known to be lone. EyePackets look for less.
bool Wave::is_lone(const Level& level, std::size_t ray, const Ray& way) {
  if (!level.rays.empty()) return level.alone[ray];
  const Hit& hit = level.hits[ray];
  return !prepared_.solids.empty() && scene_.objects[scene_.primitive_object[hit.primitive]].solid &&
         lone_hit(prepared_, way, hit, isa_, &clearings_) != Lone::unknown;
}

void Wave::send_secondary(Level& level, Level& next, RenderStats& stats) {
  Path eye_path;
  for (std::size_t b = 0; b < used_; ++b) {
    const HitBatch& batch = batches_[b];
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); ++i) {
      const Material& material = scene_.materials[batch.material[i]];
      const glm::dvec3 c2 = reflect_of(scene_, material), c3 = refract_of(scene_, material);
      if (largest(c2) == 0 && largest(c3) == 0) continue;
      const std::uint32_t ray = batch.ray[i];
      if (level.rays.empty()) eye_path = path_of(level, ray);
      const Path& path = level.rays.empty() ? eye_path : level.rays[ray].path;
      if (path.depth >= scene_.trace.depth && largest(c3) == 0)
        level.cut_weight[ray] += path.weight * largest(c2);  // not sent, so where to is not asked
      else
        send_from(level, batch, i, path, next, stats);
    }
  }
}

void Wave::send_from(Level& level, const HitBatch& batch, std::size_t i, const Path& path, Level& next,
                     RenderStats& stats) {
  const std::uint32_t ray = batch.ray[i];
  const auto follow = [&](Departure& leaving, std::uint32_t own, bool passes) {
    auto& [way, c] = leaving;
    if (largest(c) == 0) return;
    if (!send(scene_, c, way)) {
      level.cut_weight[ray] += way.weight;
      return;
    }
    ++(is_mirrored(way.kind) ? stats.rays.reflection : stats.rays.refraction);
    next.waiting.push_back({std::move(way), c, ray, own, passes});
  };
  const Hit& hit = level.hits[ray];
  const bool lone = is_lone(level, ray, path.ray);
  const Surface surface = surface_of(level, batch, i, path.ray, lone);
  Departures leaving = departures(prepared_, path, hit, surface, get(batch.from, i), stats.signs, lone);
  const Path& refracted = leaving.refracted.path;
  const bool passes =
      lone && refracted.kind == RayKind::refracted && is_steep(refracted.ray.direction, surface.facing);
  const bool in_the_open = path.media.current() == kNone && batch.plain[i] != 0;
  if (!lone && (scene_.objects[surface.object].solid || !in_the_open)) leaving.mirrored.path.media.doubt();
  if (!passes) leaving.refracted.path.media.doubt();
  const bool stays_inside = batch.kind == ObjectKind::sphere && !surface.entering;
  follow(leaving.mirrored, stays_inside ? hit.primitive : kNone, false);
  follow(leaving.refracted, passes ? hit.primitive : kNone, passes);
}

// c w(r) color of every ray, to where it came from.
void Wave::bring_back(const Level& level, Level& parent) const {
  for (std::size_t i = 0; i < level.rays.size(); ++i) {
    const WaveRay& ray = level.rays[i];
    glm::vec3 color = level.color[i];
    if (level.hits[i].found()) color = (color + level.mirrored[i]) + level.refracted[i];
    const float w =
        prepared_.needs[Need::secondary_attenuation]
            ? static_cast<float>(distance_weight(scene_.trace.secondary_attenuation, ray.path, level.hits[i]))
            : 1.0f;
    (is_mirrored(ray.path.kind) ? parent.mirrored : parent.refracted)[ray.parent] =
        glm::vec3(ray.c) * (w * color);
    parent.cut_weight[ray.parent] += level.cut_weight[i];
  }
}

}  // namespace sidelight::raytrace
