// SPDX-License-Identifier: MIT
// What leaves a level's hits, and what it brings back.
#include "raytrace/kernels.h"
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

// Batch by batch: who sends rays, where they go, in lanes, and the rays.
void Wave::send_secondary(Level& level, Level& next, RenderStats& stats) {
  for (std::size_t b = 0; b < used_; ++b) {
    find_senders(level, batches_[b], stats);
    kernels_for(isa_).directions(optics_);
    for (std::size_t k = 0; k < optics_.size; ++k) send_mirrored(level, batches_[b], k, next, stats);
    for (std::size_t k = 0; k < optics_.size; ++k) send_transmitted(level, batches_[b], k, next, stats);
  }
}

void Wave::find_senders(Level& level, const HitBatch& batch, RenderStats& stats) {
  optics_.size = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); ++i) {
    const Material& material = scene_.materials[batch.material[i]];
    const double c2 = largest(reflect_of(scene_, material)), c3 = largest(refract_of(scene_, material));
    if (c2 == 0 && c3 == 0) continue;
    const std::uint32_t ray = batch.ray[i];
    const Path& path = path_of(level, ray);
    if (path.depth >= scene_.trace.depth && c3 == 0) {
      level.cut_mirrored[ray] = path.weight * c2;  // not sent, so where to is not asked
      continue;
    }
    const std::size_t k = optics_.size++;
    Sender& sender = senders_[k];
    sender.entry = i;
    put(optics_.direction, k, path.ray.direction);
    put(optics_.normal, k, get(batch.normal, i));
    put(optics_.facing, k, get(batch.facing, i));
    optics_.eta[k] = OpticsBatch::kNoRefraction;
    const Hit& hit = level.hits[ray];
    const bool solid = scene_.objects[scene_.primitive_object[hit.primitive]].solid;
    sender.lone = level.rays.empty() ? Lone::unknown : static_cast<Lone>(level.alone[ray]);
    if (level.rays.empty() && solid && !prepared_.solids.empty())  // EyePackets look for less
      sender.lone = lone_hit(prepared_, path.ray, hit, isa_, &clearings_);
    if (solid || batch.kind == ObjectKind::sphere)
      sender.entering = sender.lone == Lone::unknown || !solid
                            ? is_entering(scene_, path.ray, hit, get(batch.facing, i))
                            : sender.lone == Lone::entering;
    if (c3 == 0 || !solid) continue;
    find_behind(level, batch, path, sender, stats.signs);
    optics_.eta[k] = relative_ior(scene_, path.media, sender.behind);
  }
}

// The media behind a solid's surface.
void Wave::find_behind(const Level& level, const HitBatch& batch, const Path& path, Sender& sender,
                       SignCounts& counts) {
  const Hit& hit = level.hits[batch.ray[sender.entry]];
  const std::uint32_t object = scene_.primitive_object[hit.primitive];
  if (sender.lone != Lone::unknown) {
    sender.behind = media_behind_lone(prepared_, object, sender.entering, path.media);
    return;
  }
  Surface surface;
  surface.object = object;
  surface.facing = get(batch.facing, sender.entry);
  surface.clearance = batch.clearance[sender.entry];
  surface.together = together_depth(path.ray, hit, surface);
  surface.entering = sender.entering;
  sender.behind = media_behind(prepared_, path.ray, hit, surface, path.media, counts);
}

// A ray to be filled in, or nothing where it is not sent.
WaveRay* Wave::send(Level& level, std::uint32_t parent, const glm::dvec3& c, RayKind kind, Level& next,
                    RenderStats& stats) {
  if (largest(c) == 0) return nullptr;
  const Path& path = path_of(level, parent);
  const double weight = path.weight * largest(c);
  if (!is_sent(scene_, path.depth, weight)) {
    (is_mirrored(kind) ? level.cut_mirrored : level.cut_refracted)[parent] = weight;
    return nullptr;
  }
  ++(is_mirrored(kind) ? stats.rays.reflection : stats.rays.refraction);
  WaveRay& ray = next.waiting.emplace_back();
  ray.path.kind = kind;
  ray.path.depth = path.depth + 1;
  ray.path.weight = weight;
  ray.c = c;
  ray.parent = parent;
  return &ray;
}

// One ray carries both weights where reflection is total.
void Wave::send_mirrored(Level& level, const HitBatch& batch, std::size_t k, Level& next,
                         RenderStats& stats) {
  const Sender& sender = senders_[k];
  const std::size_t i = sender.entry;
  const Material& material = scene_.materials[batch.material[i]];
  const glm::dvec3 c2 = reflect_of(scene_, material);
  const bool total = is_total(k);
  WaveRay* ray = send(level, batch.ray[i], total ? c2 + refract_of(scene_, material) : c2,
                      total ? RayKind::internally_reflected : RayKind::mirrored, next, stats);
  if (!ray) return;
  const std::uint32_t primitive = level.hits[batch.ray[i]].primitive;
  ray->path.ray = {get(batch.from, i), get(optics_.mirrored, k)};
  ray->path.media = path_of(level, batch.ray[i]).media;
  if (batch.kind == ObjectKind::sphere && !sender.entering) ray->own = primitive;
  const bool solid = scene_.objects[scene_.primitive_object[primitive]].solid;
  const bool in_the_open = !solid && batch.plain[i] != 0 && ray->path.media.current() == kNone;
  if (sender.lone == Lone::unknown && !in_the_open) ray->path.media.doubt();
}

void Wave::send_transmitted(Level& level, const HitBatch& batch, std::size_t k, Level& next,
                            RenderStats& stats) {
  if (is_total(k)) return;
  const Sender& sender = senders_[k];
  const std::size_t i = sender.entry;
  const bool refracts = optics_.eta[k] != OpticsBatch::kNoRefraction;
  WaveRay* ray = send(level, batch.ray[i], refract_of(scene_, scene_.materials[batch.material[i]]),
                      refracts ? RayKind::refracted : RayKind::straight, next, stats);
  if (!ray) return;
  const Hit& hit = level.hits[batch.ray[i]];
  if (refracts) {
    ray->path.ray = {get(batch.from, i), get(optics_.refracted, k)};
    ray->path.media = sender.behind;
    ray->passes = sender.lone != Lone::unknown && is_steep(ray->path.ray.direction, get(batch.facing, i));
    if (ray->passes) ray->own = hit.primitive;
  } else {  // a sheet without an inside: straight on, along the same ray
    const Path& path = path_of(level, batch.ray[i]);
    ray->path.ray = path.ray;
    ray->path.start = hit;
    ray->path.media = path.media;
  }
  if (!ray->passes) ray->path.media.doubt();
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
    (is_mirrored(ray.path.kind) ? parent.cut_mirrored : parent.cut_refracted)[ray.parent] =
        level.cut_mirrored[i] + level.cut_refracted[i];
  }
}

}  // namespace sidelight::raytrace
