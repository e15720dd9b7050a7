// SPDX-License-Identifier: MIT
// What a level's rays have met: points, normals, the light that would arrive, and where rays start that leave.
#include <algorithm>
#include <numeric>

#include "common/scene/primitive_finder.h"
#include "raytrace/wave.h"

namespace sidelight::raytrace {

HitBatch& Wave::next_batch() {
  if (used_ == batches_.size()) batches_.emplace_back();
  return batches_[used_++];
}

void Wave::find_surfaces(Level& level) {
  const bool eye = level.is_eye();
  used_ = 0;
  for (SurfaceBatch& batch : surfaces_) {
    batch.own_rays = !eye;
    batch.want_leaving = shadows_ || secondary_;
    batch.has_t = !eye || primary_;
    batch.want_t = eye && !primary_ && (want_t_ || batch.want_leaving);
  }
  if (eye) return find_seen_surfaces(level);
  PrimitiveFinder find(scene_);
  for (std::size_t i = 0; i < level.hits.size(); ++i) {
    const Hit& hit = level.hits[i];
    if (!hit.found()) continue;
    SurfaceBatch& batch = surfaces_[static_cast<std::size_t>(find(hit.primitive).kind)];
    const auto entry = static_cast<std::size_t>(batch.size);
    batch.t[entry] = hit.t;
    batch.sample[entry] = static_cast<std::uint32_t>(i);
    put(batch.origin, entry, level.rays[i].ray.origin);
    put(batch.direction, entry, level.rays[i].ray.direction);
    batch.add(hit.primitive);
    if (batch.room() == 0) flush(level, batch);
  }
  for (SurfaceBatch& batch : surfaces_) flush(level, batch);
}

// Stretch by stretch of what is of one object.
void Wave::find_seen_surfaces(Level& level) {
  const Object* object = nullptr;  // most often that of the stretch before
  for (std::size_t k = 0; k < level.hits.size();) {
    const std::uint32_t primitive = level.hits[k].primitive;
    if (primitive == kNone) {
      ++k;
      continue;
    }
    if (!object || primitive - object->first_primitive >= object->count)
      object = &scene_.objects[scene_.primitive_object[primitive]];
    k = add_seen(level, k, *object);
    SurfaceBatch& batch = surfaces_[static_cast<std::size_t>(object->kind)];
    if (batch.room() == 0) flush(level, batch);
  }
  for (SurfaceBatch& batch : surfaces_) flush(level, batch);
}

// Hits of the object in a row, from the first on, as far as there is room. Returns the next one.
std::size_t Wave::add_seen(const Level& level, std::size_t first, const Object& object) {
  SurfaceBatch& batch = surfaces_[static_cast<std::size_t>(object.kind)];
  const auto to = static_cast<std::size_t>(batch.size);
  const std::size_t most = std::min(level.hits.size() - first, static_cast<std::size_t>(batch.room()));
  const Hit* const hits = &level.hits[first];
  const std::uint32_t first_primitive = object.first_primitive, primitives = object.count;
  auto runs = static_cast<std::uint32_t>(batch.runs);
  std::uint32_t before = kNone;
  std::size_t count = 0;
  for (; count < most && hits[count].primitive - first_primitive < primitives; ++count) {
    const std::uint32_t primitive = hits[count].primitive;
    runs += static_cast<std::uint32_t>(primitive != before);
    before = batch.primitive[runs - 1] = primitive;
    batch.run[to + count] = runs - 1;
  }
  batch.runs = static_cast<int>(runs);
  // Steps of column and row are whole numbers, exact.
  const double first_column = camera_.column_factor(camera_.n * pixels_.x0);
  const double first_row = camera_.row_factor(camera_.n * pixels_.y0);
  const double *const column = &column_[first], *const row = &row_[first];
  for (std::size_t i = 0; i < count; ++i) batch.column[to + i] = first_column + 2 * column[i];
  for (std::size_t i = 0; i < count; ++i) batch.row[to + i] = first_row - 2 * row[i];
  std::iota(&batch.sample[to], &batch.sample[to] + count, static_cast<std::uint32_t>(first));
  for (std::size_t i = 0; i < count && batch.has_t; ++i) batch.t[to + i] = hits[i].t;
  batch.size += static_cast<int>(count);
  return first + count;
}

void Wave::flush(Level& level, SurfaceBatch& surfaces) {
  if (surfaces.size == 0) return;
  const bool parts = level.is_eye() && want_parts_;
  surfaces_at(isa_, scene_, camera_, prepared_.tables, surfaces, shading_, stats_->visibility);
  HitBatch& batch = next_batch();
  const auto size = static_cast<std::size_t>(surfaces.size);
  if (surfaces.want_t)
    for (std::size_t i = 0; i < size; ++i) level.hits[surfaces.sample[i]].t = surfaces.t[i];
  batch.size = surfaces.size;
  batch.kind = surfaces.kind;
  std::copy_n(surfaces.sample.begin(), size, batch.ray.begin());
  std::copy_n(shading_.material.begin(), size, batch.material.begin());
  if (level.is_eye() && want_normal_)
    for (std::size_t i = 0; i < size; ++i) normal_[batch.ray[i]] = get(shading_.normal, i);

  if (shadows_) {
    light_terms(isa_, prepared_.tables, shading_, parts, batch.lit);
  } else {
    shade(isa_, prepared_.tables, shading_, parts);
    const bool neighbours = batch.ray[size - 1] - batch.ray[0] == size - 1;  // ray numbers ascend
    const auto put = [&](Colors& to, const ShadingBatch::Rgb& from) {
      if (neighbours) return interleave(from, 0, size, &to[batch.ray[0]]);
      for (std::size_t i = 0; i < size; ++i) to[batch.ray[i]] = get(from, i);
    };
    put(level.color, shading_.unshadowed);
    if (parts) {
      put(parts_[0], shading_.ambient_layer);
      put(parts_[1], shading_.diffuse_layer);
      put(parts_[2], shading_.specular_layer);
    }
  }
  if (surfaces.want_leaving) find_leaving_points(level, surfaces, batch);
  surfaces.clear();
}

// Whether there is nothing to search for near the hit.
bool Wave::stands_alone(Level& level, std::size_t ray, ObjectKind kind) {
  if (level.is_eye()) return !level.alone.empty() && level.alone[ray] && level.hits[ray].t < farthest_alone_;
  Lone& lone = level.lone[ray];
  if (lone != Lone::unknown || kind == ObjectKind::plane) return lone != Lone::unknown;
  const Hit& hit = level.hits[ray];
  const bool clear = is_clear(prepared_, level.rays[ray].ray, hit, clearings_, isa_);
  // On a solid the ray grazes, or lone_hit() would have said so: no reason to call it lone.
  if (clear && !scene_.objects[scene_.primitive_object[hit.primitive]].solid) lone = Lone::clear;
  return clear;
}

// Whether the ray comes from outside. Of secondary rays lone_hit() told it where it could.
bool Wave::enters_ball(const Level& level, std::size_t ray, const glm::dvec3& facing) const {
  const Lone lone = level.is_eye() ? Lone::unknown : level.lone[ray];
  if (lone != Lone::unknown) return lone == Lone::entering;
  return is_entering(scene_, ray_of(level, ray), level.hits[ray], facing);
}

void Wave::find_leaving_points(Level& level, const SurfaceBatch& surfaces, HitBatch& batch) {
  const auto size = static_cast<std::size_t>(batch.size);
  for (std::size_t axis = 0; axis < 3; ++axis)  // leaving_point() of nothing near
    for (std::size_t i = 0; i < size; ++i)
      batch.from[axis][i] = surfaces.point[axis][i] + surfaces.clearance[i] * surfaces.facing[axis][i];
  std::fill_n(batch.plain.begin(), size, true);
  if (secondary_ || batch.kind == ObjectKind::sphere) batch.facing = surfaces.facing;
  if (secondary_) {
    batch.normal = surfaces.normal;
    batch.clearance = surfaces.clearance;
  }
  for (std::size_t i = 0; i < size && batch.kind == ObjectKind::sphere; ++i)
    batch.entering[i] = enters_ball(level, batch.ray[i], get(batch.facing, i));
  for (std::size_t i = 0; i < size; ++i) {
    if (stands_alone(level, batch.ray[i], batch.kind)) continue;
    Place place;
    place.point = get(surfaces.point, i);
    place.facing = get(surfaces.facing, i);
    place.clearance = surfaces.clearance[i];
    const Hit& hit = level.hits[batch.ray[i]];
    const Ray ray = ray_of(level, batch.ray[i]);
    place.together = together_depth(ray, hit, place);
    const glm::dvec3 from = leaving_point(prepared_, ray, hit, place, stats_->visibility, isa_);
    batch.plain[i] = from == get(batch.from, i);
    put(batch.from, i, from);
  }
}

}  // namespace sidelight::raytrace
