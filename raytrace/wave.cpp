// SPDX-License-Identifier: MIT
#include "raytrace/wave.h"

#include <algorithm>
#include <iterator>

namespace sidelight::raytrace {
namespace {

constexpr LayerMask kParts =
    layer_bit(Layer::ambient) | layer_bit(Layer::diffuse) | layer_bit(Layer::specular);

glm::vec3 rgb(const ShadingBatch::Rgb& from, std::size_t i) { return {from[0][i], from[1][i], from[2][i]}; }
glm::vec3 rgb(const Vec3<float>& v) { return {v.x, v.y, v.z}; }
glm::dvec3 get(const SurfaceBatch::Vectors& from, std::size_t i) {
  return {from[0][i], from[1][i], from[2][i]};
}
void put(SurfaceBatch::Vectors& to, std::size_t i, const glm::dvec3& v) {
  to[0][i] = v.x;
  to[1][i] = v.y;
  to[2][i] = v.z;
}

// Whether the ray comes from the outward side, Nv being `facing`: as locate() has it.
bool is_entering(const Scene& scene, const Ray& ray, const Hit& hit, const glm::dvec3& facing) {
  const PrimitiveRef ref = primitive_ref(scene, hit.primitive);
  if (ref.kind == ObjectKind::sphere)
    return glm::dot(facing, (ray.origin - scene.spheres[ref.index].center) + hit.t * ray.direction) > 0;
  if (ref.kind == ObjectKind::plane) return glm::dot(facing, scene.planes[ref.index].normal) > 0;
  const auto [v0, v1, v2] = corners(scene, scene.triangles[ref.index]);
  return glm::dot(facing, glm::cross(v1 - v0, v2 - v0)) > 0;
}

}  // namespace

Wave::Wave(const Prepared& prepared, const Camera& camera, const Media& eye_media,
           const RenderOptions& options)
    : prepared_(prepared),
      scene_(prepared.scene),
      camera_(camera),
      eye_media_(eye_media),
      isa_(options.isa),
      layers_(options.layers),
      secondary_(prepared.needs[Need::mirrors] || prepared.needs[Need::refraction]),
      shadows_(scene_.trace.shadows && !prepared.tables.lights.empty()),
      want_parts_((options.layers & kParts) != 0),
      want_shadow_((options.layers & layer_bit(Layer::shadow)) != 0),
      want_normal_((options.layers & layer_bit(Layer::normal)) != 0),
      want_t_((options.layers & layer_bit(Layer::depth)) != 0 || options.keep_samples),
      eye_packets_(prepared, camera, options.isa),
      shadow_packets_(prepared, options.isa) {
  farthest_alone_ = 16 * eye_packets_.reach() / eye_packets_.ray_length();
  for (const ObjectKind kind : {ObjectKind::sphere, ObjectKind::plane, ObjectKind::mesh})
    surfaces_[static_cast<std::size_t>(kind)].kind = kind;
}

void Wave::trace(const Rect& pixels, RenderStats& stats) {
  begin(pixels);
  stats.rays.primary += samples();
  trace_level(0, stats);
  std::size_t depth = 0;
  while (true) {
    if (take_part(depth + 1)) {
      trace_level(++depth, stats);
    } else if (depth > 0) {
      bring_back(levels_[depth], levels_[depth - 1]);
      --depth;
    } else {
      break;
    }
  }
  Level& eye = levels_[0];
  if (secondary_)
    for (std::size_t i = 0; i < eye.color.size(); ++i)
      if (eye.hits[i].found()) eye.color[i] = (eye.color[i] + eye.mirrored[i]) + eye.refracted[i];
}

// What is sent on waits at the next level.
void Wave::trace_level(std::size_t depth, RenderStats& stats) {
  if (levels_.size() < depth + 2) levels_.resize(depth + 2);
  Level &level = levels_[depth], &next = levels_[depth + 1];
  const bool eye = depth == 0;
  find_hits(level, eye, stats);
  find_surfaces(level, eye, stats);
  if (shadows_) add_lights(level, stats);
  sum_up(level, eye);
  if (secondary_) send_secondary(level, next, stats);
}

// Takes rays that wait at this depth as those that are traced next; false if there are none. Most often these are all of
// them. But where every hit sends two rays, whole levels would fill any memory: then only so many at a time that what
// waits at all depths together stays below about 2 kMost (1 + log(kMost / kLeast)) + 2 kLeast depth rays.
bool Wave::take_part(std::size_t depth) {
  constexpr std::size_t kMost = 16384, kLeast = 64;
  Level& level = levels_[depth];
  const std::size_t part = std::max(std::min(kMost / depth, std::size_t{1024}), kLeast);
  level.rays.clear();
  if (level.waiting.size() <= part) {
    level.rays.swap(level.waiting);
  } else {
    const auto first = level.waiting.end() - static_cast<std::ptrdiff_t>(part);
    level.rays.assign(std::make_move_iterator(first), std::make_move_iterator(level.waiting.end()));
    level.waiting.erase(first, level.waiting.end());
  }
  return !level.rays.empty();
}

void Wave::begin(const Rect& pixels) {
  pixels_ = pixels;
  if (levels_.empty()) levels_.resize(1);
  const auto size_if = [&](auto& array, bool wanted) {
    if (wanted) array.assign(samples(), {});
  };
  for (Colors& part : parts_) size_if(part, want_parts_);
  size_if(shadow_, want_shadow_);
  size_if(normal_, want_normal_);
  size_if(t_, want_t_);
}

Ray Wave::ray_of(const Level& level, std::size_t ray) const {
  if (!level.rays.empty()) return level.rays[ray].path.ray;
  const auto X = camera_.n * pixels_.x0 + static_cast<int>(ray % columns());
  const auto Y = camera_.n * pixels_.y0 + static_cast<int>(ray / columns());
  return {camera_.eye, camera_.direction(X, Y)};
}

Path Wave::path_of(const Level& level, std::size_t ray) const {
  if (!level.rays.empty()) return level.rays[ray].path;
  Path path;
  path.ray = ray_of(level, ray);
  path.media = eye_media_;
  return path;
}

// ---- Hits ----

void Wave::find_hits(Level& level, bool eye, RenderStats& stats) {
  const std::size_t size = eye ? samples() : level.rays.size();
  if (eye) {
    eye_packets_.trace(camera_.n * pixels_.x0, camera_.n * pixels_.y0, static_cast<int>(columns()),
                       camera_.n * pixels_.height(), level.hits, level.alone, stats.signs);
  } else {
    level.hits.resize(size);
    for (std::size_t i = 0; i < size; ++i) level.hits[i] = first_shaded(level.rays[i], stats);
  }
  level.color.assign(size, glm::vec3(scene_.background));
  if (!secondary_) return;
  level.mirrored.assign(size, glm::vec3(0));
  level.refracted.assign(size, glm::vec3(0));
  level.cut_weight.assign(size, 0.0);
}

// The first hit of a secondary ray that is not just a surface inside of a medium that goes on behind it.
Hit Wave::first_shaded(WaveRay& ray, RenderStats& stats) const {
  Path& path = ray.path;
  for (Hit hit = nearest(prepared_, path.ray, path.start, stats.signs, Precision::exact, isa_);;
       hit = nearest(prepared_, path.ray, hit, stats.signs, Precision::exact, isa_)) {
    if (!hit.found() || prepared_.solids.empty() ||
        !scene_.objects[scene_.primitive_object[hit.primitive]].solid)
      return hit;
    const Surface surface = surface_at(scene_, path.ray, hit, stats.signs);
    const Media behind = media_behind(prepared_, path.ray, hit, surface, path.media, stats.signs);
    if (behind.current() != path.media.current()) return hit;
    path.media = behind;
  }
}

// ---- Surfaces and light ----

HitBatch& Wave::next_batch() {
  if (used_ == batches_.size()) batches_.emplace_back();
  return batches_[used_++];
}

void Wave::find_surfaces(Level& level, bool eye, RenderStats& stats) {
  used_ = 0;
  for (SurfaceBatch& batch : surfaces_) {
    batch.own_rays = !eye;
    batch.want_leaving = shadows_ || secondary_;
    batch.has_t = !eye;
    batch.want_t = eye && (want_t_ || batch.want_leaving);
  }
  for (std::size_t i = 0; i < level.hits.size(); ++i) {
    const Hit& hit = level.hits[i];
    if (!hit.found()) continue;
    SurfaceBatch& batch = surfaces_[static_cast<std::size_t>(primitive_ref(scene_, hit.primitive).kind)];
    const auto entry = static_cast<std::size_t>(batch.size);
    batch.t[entry] = hit.t;
    if (eye) {
      const auto X = camera_.n * pixels_.x0 + static_cast<int>(i % columns());
      const auto Y = camera_.n * pixels_.y0 + static_cast<int>(i / columns());
      batch.add(camera_.column_factor(X), camera_.row_factor(Y), &hit.primitive,
                static_cast<std::uint32_t>(i), 1);
    } else {
      const Ray& ray = level.rays[i].path.ray;
      put(batch.origin, entry, ray.origin);
      put(batch.direction, entry, ray.direction);
      batch.add(0, 0, &hit.primitive, static_cast<std::uint32_t>(i), 1);
    }
    if (batch.room() == 0) flush(level, batch, eye, stats);
  }
  for (SurfaceBatch& batch : surfaces_) flush(level, batch, eye, stats);
}

void Wave::flush(Level& level, SurfaceBatch& surfaces, bool eye, RenderStats& stats) {
  if (surfaces.size == 0) return;
  surfaces_at(isa_, scene_, camera_, prepared_.tables, surfaces, shading_, stats.signs);
  HitBatch& batch = next_batch();
  const auto size = static_cast<std::size_t>(surfaces.size);
  if (surfaces.want_t)
    for (std::size_t i = 0; i < size; ++i) level.hits[surfaces.sample[i]].t = surfaces.t[i];
  batch.size = surfaces.size;
  batch.kind = surfaces.kind;
  std::copy_n(surfaces.sample.begin(), size, batch.ray.begin());
  std::copy_n(shading_.material.begin(), size, batch.material.begin());
  if (eye && want_normal_)
    for (std::size_t i = 0; i < size; ++i) normal_[batch.ray[i]] = rgb(shading_.normal, i);

  if (shadows_) {
    light_terms(isa_, prepared_.tables, shading_, eye && want_parts_, batch.lit);
  } else {
    shade(isa_, prepared_.tables, shading_, eye && want_parts_);
    for (std::size_t i = 0; i < size; ++i) {
      level.color[batch.ray[i]] = rgb(shading_.unshadowed, i);
      if (!eye || !want_parts_) continue;
      parts_[0][batch.ray[i]] = rgb(shading_.ambient_layer, i);
      parts_[1][batch.ray[i]] = rgb(shading_.diffuse_layer, i);
      parts_[2][batch.ray[i]] = rgb(shading_.specular_layer, i);
    }
  }
  if (surfaces.want_leaving) find_leaving_points(level, surfaces, batch, stats);
  surfaces.size = 0;
}

void Wave::find_leaving_points(const Level& level, const SurfaceBatch& surfaces, HitBatch& batch,
                               RenderStats& stats) const {
  batch.normal = surfaces.normal;
  batch.facing = surfaces.facing;
  batch.clearance = surfaces.clearance;
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); ++i) {
    Place place;
    place.point = get(surfaces.point, i);
    place.facing = get(surfaces.facing, i);
    place.clearance = surfaces.clearance[i];
    const Hit& hit = level.hits[batch.ray[i]];
    if (!level.alone.empty() && level.alone[batch.ray[i]] && hit.t < farthest_alone_) {
      put(batch.from, i, place.point + place.clearance * place.facing);  // leaving_point() of nothing near
      continue;
    }
    const Ray ray = ray_of(level, batch.ray[i]);
    place.together = together_depth(ray, hit, place);
    put(batch.from, i, leaving_point(prepared_, ray, hit, place, stats.signs, isa_));
  }
}

void Wave::add_lights(const Level& level, RenderStats& stats) {
  for (std::size_t b = 0; b < used_; ++b) {
    HitBatch& batch = batches_[b];
    batch.light = batch.lit.ambient;
    for (auto& channel : batch.missing) channel.fill(0);
  }
  for (std::size_t light = 0; light < prepared_.tables.lights.size(); ++light) {
    find_shadows(level, light, stats);
    add_light(light);
  }
}

ShadowQuery Wave::shadow_query(const Level& level, const HitBatch& batch, std::size_t i) const {
  const std::uint32_t ray = batch.ray[i];
  ShadowQuery query{batch.from_of(i), level.hits[ray].primitive};
  if (batch.kind == ObjectKind::sphere &&
      !is_entering(scene_, ray_of(level, ray), level.hits[ray], get(batch.facing, i)))
    query.own = kNone;
  return query;
}

// Where a shadow ray is blocked, the light's state becomes that of a surface in its own light: b_i = 0.
void Wave::find_shadows(const Level& level, std::size_t light, RenderStats& stats) {
  const Light& source = scene_.lights[light];
  // What is asked, batch by batch; then the answers in the same order.
  const auto for_each_asked = [&](const auto& visit) {
    for (std::size_t b = 0; b < used_; ++b)
      for (std::size_t i = 0; i < static_cast<std::size_t>(batches_[b].size); ++i)
        if (batches_[b].lit.light[light].state[i] == LightTerms::kAsk) visit(batches_[b], i);
  };
  queries_.clear();
  for (std::size_t b = 0; b < used_; ++b)
    for (std::size_t i = 0; i < static_cast<std::size_t>(batches_[b].size); ++i)
      stats.self_shadowed += batches_[b].lit.light[light].state[i] == LightTerms::kSelfShadowed;
  for_each_asked(
      [&](const HitBatch& batch, std::size_t i) { queries_.push_back(shadow_query(level, batch, i)); });
  stats.rays.shadow += queries_.size();
  if (source.directional) {
    dark_.clear();
    for (const ShadowQuery& query : queries_)
      dark_.push_back(blocker(prepared_, ray_to_light(query.from, source), nullptr, stats.signs, kRayStart,
                              Precision::exact, isa_)
                          .found());
  } else {
    shadow_packets_.trace(source, queries_, dark_, stats.signs);
  }
  std::size_t next = 0;
  for_each_asked([&](HitBatch& batch, std::size_t i) {
    if (dark_[next++] != 0) batch.lit.light[light].state[i] = LightTerms::kSelfShadowed;
  });
}

void Wave::add_light(std::size_t light) {
  for (std::size_t b = 0; b < used_; ++b) {
    HitBatch& batch = batches_[b];
    const LightTerms& terms = batch.lit.light[light];
    const auto size = static_cast<std::size_t>(batch.size);
    for (std::size_t channel = 0; channel < 3; ++channel)
      for (std::size_t i = 0; i < size; ++i) {
        const float total = terms.total[channel][i];
        const bool seen = terms.state[i] != LightTerms::kSelfShadowed;
        batch.light[channel][i] += seen ? total : 0.0f;
        batch.missing[channel][i] += seen ? 0.0f : total;
      }
  }
}

// color = c1 (ka Ia + sum b_i T_i), shadow = c1 sum (1 - b_i) T_i, and the unshadowed parts.
void Wave::sum_up(Level& level, bool eye) {
  if (eye && want_t_)
    for (std::size_t i = 0; i < level.hits.size(); ++i) t_[i] = level.hits[i].found() ? level.hits[i].t : 0.0;
  if (eye && want_parts_)  // the background is booked as ambient light
    for (std::size_t i = 0; i < level.hits.size(); ++i)
      if (!level.hits[i].found()) parts_[0][i] = level.color[i];
  if (!shadows_) return;
  for (std::size_t b = 0; b < used_; ++b) {
    const HitBatch& batch = batches_[b];
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); ++i) {
      const std::uint32_t ray = batch.ray[i];
      const glm::vec3 c1 = rgb(prepared_.tables.materials[batch.material[i]].local);
      level.color[ray] = c1 * rgb(batch.light, i);
      if (!eye) continue;
      if (want_shadow_) shadow_[ray] = c1 * rgb(batch.missing, i);
      if (!want_parts_) continue;
      parts_[0][ray] = c1 * rgb(batch.lit.ambient, i);
      parts_[1][ray] = c1 * rgb(batch.lit.diffuse, i);
      parts_[2][ray] = c1 * rgb(batch.lit.specular, i);
    }
  }
}

// ---- Secondary rays ----

// What departures() reads of a surface.
Surface Wave::surface_of(const Level& level, const HitBatch& batch, std::size_t i, const Ray& ray) const {
  const Hit& hit = level.hits[batch.ray[i]];
  Surface surface;
  surface.object = scene_.primitive_object[hit.primitive];
  surface.material = batch.material[i];
  surface.normal = get(batch.normal, i);
  surface.facing = get(batch.facing, i);
  surface.clearance = batch.clearance[i];
  surface.together = together_depth(ray, hit, surface);
  surface.entering = is_entering(scene_, ray, hit, surface.facing);
  return surface;
}

void Wave::send_secondary(Level& level, Level& next, RenderStats& stats) const {
  const auto follow = [&](Departure& leaving, std::uint32_t parent) {
    auto& [path, c] = leaving;
    if (largest(c) == 0) return;
    if (!send(scene_, c, path)) {
      level.cut_weight[parent] += path.weight;
      return;
    }
    ++(is_mirrored(path.kind) ? stats.rays.reflection : stats.rays.refraction);
    next.waiting.push_back({std::move(path), c, parent});
  };
  for (std::size_t b = 0; b < used_; ++b) {
    const HitBatch& batch = batches_[b];
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); ++i) {
      const Material& material = scene_.materials[batch.material[i]];
      if (largest(refract_of(scene_, material)) == 0 && largest(reflect_of(scene_, material)) == 0) continue;
      const std::uint32_t ray = batch.ray[i];
      const Hit& hit = level.hits[ray];
      const Path path = path_of(level, ray);
      const Surface surface = surface_of(level, batch, i, path.ray);
      Departures leaving = departures(prepared_, path, hit, surface, batch.from_of(i), stats.signs);
      follow(leaving.mirrored, ray);
      follow(leaving.refracted, ray);
    }
  }
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
