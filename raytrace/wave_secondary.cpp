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
void Wave::send_secondary(Level& level, Level& next) {
  for (std::size_t b = 0; b < used_; ++b) {
    find_senders(level, batches_[b]);
    kernels_for(isa_).directions(optics_);
    for (std::size_t k = 0; k < optics_.size; ++k) send_mirrored(level, batches_[b], k, next);
    for (std::size_t k = 0; k < optics_.size; ++k) send_transmitted(level, batches_[b], k, next);
  }
}

void Wave::find_senders(Level& level, const HitBatch& batch) {
  optics_.size = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); ++i) {
    const Shares& shares = shares_[batch.material[i]];
    const double c2 = shares.mirrored.largest, c3 = shares.transmitted.largest;
    if (c2 == 0 && c3 == 0) continue;
    const std::uint32_t number = batch.ray[i];
    if (level.depth >= scene_.trace.depth && c3 == 0) {
      level.cut[number] = weight_of(level, number) * c2;  // not sent, so where to is not asked
      continue;
    }
    const std::size_t k = optics_.size++;
    Sender& sender = senders_[k];
    const Ray ray = ray_of(level, number);
    sender.entry = i;
    put(optics_.direction, k, ray.direction);
    put(optics_.normal, k, get(batch.normal, i));
    put(optics_.facing, k, get(batch.facing, i));
    optics_.eta[k] = OpticsBatch::kNoRefraction;
    const Hit& hit = level.hits[number];
    sender.solid = scene_.objects[scene_.primitive_object[hit.primitive]].solid;
    sender.lone = level.is_eye() ? Lone::unknown : level.lone[number];
    if (level.is_eye() && sender.solid && !prepared_.solids.empty())  // EyePackets look for less
      sender.lone = lone_hit(prepared_, ray, hit, isa_, &clearings_);
    if (batch.kind == ObjectKind::sphere)
      sender.entering = batch.entering[i] != 0;
    else if (sender.solid)
      sender.entering = sender.lone == Lone::unknown ? is_entering(scene_, ray, hit, get(batch.facing, i))
                                                     : sender.lone == Lone::entering;
    if (c3 == 0 || !sender.solid) continue;
    find_behind(level, batch, ray, sender);
    optics_.eta[k] = relative_ior(scene_, media_[media_of(level, number)], media_[sender.behind]);
  }
}

// The media behind a solid's surface.
void Wave::find_behind(const Level& level, const HitBatch& batch, const Ray& ray, Sender& sender) {
  const Hit& hit = level.hits[batch.ray[sender.entry]];
  const std::uint32_t object = scene_.primitive_object[hit.primitive];
  const MediaSets::Number media = media_of(level, batch.ray[sender.entry]);
  if (sender.lone != Lone::unknown) {
    sender.behind = media_.behind_lone(object, sender.entering, media);
    return;
  }
  Surface surface;
  surface.object = object;
  surface.facing = get(batch.facing, sender.entry);
  surface.clearance = batch.clearance[sender.entry];
  surface.together = together_depth(ray, hit, surface);
  surface.entering = sender.entering;
  sender.behind =
      media_.number_of(media_behind(prepared_, ray, hit, surface, media_[media], stats_->visibility));
}

// A ray to be filled in, or nothing where it is not sent.
WaveRay* Wave::send(Level& level, std::uint32_t parent, const Share& share, RayKind kind, Level& next) {
  if (share.largest == 0) return nullptr;
  const double weight = weight_of(level, parent) * share.largest;
  if (!is_sent(scene_, level.depth, weight)) {
    level.cut[parent] += weight;
    return nullptr;
  }
  ++(is_mirrored(kind) ? stats_->rays.reflection : stats_->rays.refraction);
  WaveRay& ray = next.waiting.emplace_back();
  ray.weight = weight;
  ray.c = share.c;
  ray.parent = parent;
  ray.media = media_of(level, parent);
  ray.kind = kind;
  return &ray;
}

// One ray carries both weights where reflection is total.
void Wave::send_mirrored(Level& level, const HitBatch& batch, std::size_t k, Level& next) {
  const Sender& sender = senders_[k];
  const std::size_t i = sender.entry;
  const Shares& shares = shares_[batch.material[i]];
  const bool total = is_total(k);
  WaveRay* ray = send(level, batch.ray[i], total ? shares.total : shares.mirrored,
                      total ? RayKind::internally_reflected : RayKind::mirrored, next);
  if (!ray) return;
  ray->ray = {get(batch.from, i), get(optics_.mirrored, k)};
  if (batch.kind == ObjectKind::sphere && !sender.entering) ray->own = level.hits[batch.ray[i]].primitive;
  const bool in_the_open = !sender.solid && batch.plain[i] != 0 && media_[ray->media].current() == kNone;
  if (sender.lone == Lone::unknown && !in_the_open) ray->media = media_.doubted(ray->media);
}

void Wave::send_transmitted(Level& level, const HitBatch& batch, std::size_t k, Level& next) {
  if (is_total(k)) return;
  const Sender& sender = senders_[k];
  const std::size_t i = sender.entry;
  const bool refracts = optics_.eta[k] != OpticsBatch::kNoRefraction;
  WaveRay* ray = send(level, batch.ray[i], shares_[batch.material[i]].transmitted,
                      refracts ? RayKind::refracted : RayKind::straight, next);
  if (!ray) return;
  if (refracts) {
    ray->ray = {get(batch.from, i), get(optics_.refracted, k)};
    ray->media = sender.behind;
    ray->passes = sender.lone != Lone::unknown && is_steep(ray->ray.direction, get(batch.facing, i));
    if (ray->passes) ray->own = level.hits[batch.ray[i]].primitive;
  } else {  // a sheet without an inside: straight on, along the same ray
    ray->ray = ray_of(level, batch.ray[i]);
  }
  if (!ray->passes) ray->media = media_.doubted(ray->media);
}

// c w(r) color of every ray, to where it came from.
void Wave::bring_back(const Level& level, Level& parent) const {
  for (std::size_t i = 0; i < level.rays.size(); ++i) {
    const WaveRay& ray = level.rays[i];
    const Hit& hit = level.hits[i];
    glm::vec3 color = level.color[i];
    if (hit.found()) color = (color + level.mirrored[i]) + level.refracted[i];
    const float w = prepared_.needs[Need::secondary_attenuation]
                        ? static_cast<float>(distance_weight(scene_.trace.secondary_attenuation, ray.ray,
                                                             start_of(ray, parent), hit))
                        : 1.0f;
    (is_mirrored(ray.kind) ? parent.mirrored : parent.refracted)[ray.parent] = ray.c * (w * color);
    parent.cut[ray.parent] += level.cut[i];
  }
}

}  // namespace sidelight::raytrace
