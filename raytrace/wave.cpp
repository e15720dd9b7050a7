// SPDX-License-Identifier: MIT
#include "raytrace/wave.h"

#include <algorithm>
#include <cmath>

#include "common/picture/tile_pixels.h"

namespace sidelight::raytrace {

Wave::Wave(const Prepared& prepared, const Camera& camera, const Media& eye_media,
           const RenderOptions& options, Clearings& clearings)
    : prepared_(prepared),
      scene_(prepared.scene),
      camera_(camera),
      isa_(options.isa),
      primary_(options.primary),
      secondary_(prepared.needs.secondary_rays()),
      shadows_(scene_.trace.shadows && !prepared.tables.lights.empty()),
      want_parts_((options.layers & kLocalParts) != 0),
      want_shadow_((options.layers & layer_bit(Layer::shadow)) != 0),
      want_normal_((options.layers & layer_bit(Layer::normal)) != 0),
      want_t_((options.layers & layer_bit(Layer::depth)) != 0 || options.keep_samples),
      media_(prepared, eye_media),
      eye_packets_(prepared, camera, options.isa),
      shadow_packets_(prepared, options.isa),
      enclosures_(prepared),
      clearings_(clearings) {
  for (const Material& material : scene_.materials) shares_.push_back(shares_of(scene_, material));
  farthest_alone_ = 16 * eye_packets_.reach() / eye_packets_.ray_length();
  for (const ObjectKind kind : {ObjectKind::sphere, ObjectKind::plane, ObjectKind::mesh})
    surfaces_[static_cast<std::size_t>(kind)].kind = kind;
}

void Wave::trace(const Rect& pixels, RenderStats& stats) {
  stats_ = &stats;
  begin(pixels);
  if (!primary_) stats_->rays.primary += samples();
  trace_level(0);
  std::size_t depth = 0;
  while (true) {
    if (take_part(depth + 1)) {
      trace_level(++depth);
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
void Wave::trace_level(std::size_t depth) {
  if (levels_.size() < depth + 2) levels_.resize(depth + 2);
  Level &level = levels_[depth], &next = levels_[depth + 1];
  level.depth = static_cast<int>(depth) + 1;
  find_hits(level);
  find_surfaces(level);
  if (shadows_) add_lights(level);
  sum_up(level);
  if (secondary_) send_secondary(level, next);
}

// Takes rays that wait at this depth as those that are traced next; false if there are none. Most often these are all of
// them. But where every hit sends two rays, whole levels would fill any memory: then a part at a time, of 4096 at first,
// of fewer the deeper. What waits at a depth is at most twice the part of the depth before, so at all depths together no
// more than 2 (4 * 4096 + 16384 ln 64) + 128 depth rays.
bool Wave::take_part(std::size_t depth) {
  Level& level = levels_[depth];
  const std::size_t part = std::clamp<std::size_t>(16384 / depth, 64, 4096);
  level.rays.clear();
  if (level.waiting.size() <= part) {
    level.rays.swap(level.waiting);
  } else {
    const auto first = level.waiting.end() - static_cast<std::ptrdiff_t>(part);
    level.rays.assign(first, level.waiting.end());
    level.waiting.erase(first, level.waiting.end());
  }
  if (media_.full()) forget_media();
  return !level.rays.empty();
}

// All sets of media that no ray has any more: in a crowd of glass there are others at every hit.
void Wave::forget_media() {
  std::vector<MediaSets::Number*> numbers;
  for (Level& level : levels_)
    for (std::vector<WaveRay>* rays : {&level.rays, &level.waiting})
      for (WaveRay& ray : *rays) numbers.push_back(&ray.media);
  media_.keep(numbers);
}

void Wave::begin(const Rect& pixels) {
  if (pixels.width() != pixels_.width() || pixels.height() != pixels_.height()) {
    const auto width = static_cast<std::uint32_t>(camera_.n * pixels.width());
    order_ = EyePackets::order(camera_.n * pixels.width(), camera_.n * pixels.height());
    place_.resize(order_.size());
    column_.clear();
    row_.clear();
    for (std::size_t k = 0; k < order_.size(); ++k) {
      place_[order_[k]] = static_cast<std::uint32_t>(k);
      column_.push_back(order_[k] % width);
      row_.push_back(order_[k] / width);
    }
  }
  pixels_ = pixels;
  media_.clear();
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
  if (!level.is_eye()) return level.rays[ray].ray;
  const auto X = camera_.n * pixels_.x0 + static_cast<int>(order_[ray] % columns());
  const auto Y = camera_.n * pixels_.y0 + static_cast<int>(order_[ray] / columns());
  return {camera_.eye, camera_.direction(X, Y)};
}

MediaSets::Number Wave::media_of(const Level& level, std::size_t ray) const {
  return level.is_eye() ? 0 : level.rays[ray].media;
}

double Wave::weight_of(const Level& level, std::size_t ray) const {
  return level.is_eye() ? 1 : level.rays[ray].weight;
}

// Path::start: of a ray that goes straight on, the hit that sent it.
Hit Wave::start_of(const WaveRay& ray, const Level& parent) const {
  return ray.kind == RayKind::straight ? parent.hits[ray.parent] : kRayStart;
}

// ---- Hits ----

// The samples of this tile, out of those of the frame, which are kept pixel by pixel.
void Wave::take_primary(std::vector<Hit>& hits) const {
  const TilePixels tile(pixels_, camera_.n);
  const auto per_pixel = static_cast<std::size_t>(camera_.n) * static_cast<std::size_t>(camera_.n);
  hits.assign(samples(), {});
  tile.for_each_pixel(*primary_, [&](std::size_t pixel, std::size_t first) {
    std::size_t from = pixel * per_pixel;
    tile.for_each_sample(first, [&](std::size_t sample) {
      const std::uint32_t primitive = primary_->sample_primitive[from];
      if (primitive != kNone) hits[place_[sample]] = {primary_->sample_depth[from], primitive};
      ++from;
    });
  });
}

void Wave::find_hits(Level& level) {
  const std::size_t size = level.is_eye() ? samples() : level.rays.size();
  if (level.is_eye() && primary_) {
    take_primary(level.hits);
  } else if (level.is_eye()) {
    eye_packets_.trace(camera_.n * pixels_.x0, camera_.n * pixels_.y0, static_cast<int>(columns()),
                       camera_.n * pixels_.height(), level.hits, level.alone, stats_->visibility);
  } else {
    level.hits.resize(size);
    level.lone.assign(size, Lone::unknown);
    find_first_hits(level);
    for (std::size_t i = 0; i < size; ++i)
      level.hits[i] = first_shaded(level.hits[i], level.rays[i], level.lone[i]);
  }
  level.color.assign(size, glm::vec3(scene_.background));
  if (!secondary_) return;
  level.mirrored.assign(size, glm::vec3(0));
  level.refracted.assign(size, glm::vec3(0));
  level.cut.assign(size, 0.0);
}

// What rays meet of the balls that they start at: a ray that goes on inside, the far side; else nothing.
void Wave::find_own_hits(Level& level) {
  for (std::size_t i = 0; i < level.rays.size(); ++i) {
    const WaveRay& ray = level.rays[i];
    level.hits[i] = {};
    if (ray.own == kNone) continue;
    const PrimitiveRef ref = primitive_ref(scene_, ray.own);
    if (ref.kind != ObjectKind::sphere) continue;
    const Sphere& sphere = scene_.spheres[ref.index];
    const std::size_t k = balls_.size++;
    balls_.ray[k] = static_cast<std::uint32_t>(i);
    put(balls_.origin, k, ray.ray.origin);
    put(balls_.direction, k, ray.ray.direction);
    put(balls_.center, k, sphere.center);
    balls_.radius[k] = sphere.radius;
    balls_.passes[k] = ray.passes;
    if (balls_.size == BallBatch::kCapacity) take_own_hits(level);
  }
  take_own_hits(level);
}

void Wave::take_own_hits(Level& level) {
  kernels_for(isa_).own_hits(balls_);
  stats_->visibility.tests += balls_.size;
  for (std::size_t k = 0; k < balls_.size; ++k)
    if (std::isfinite(balls_.t[k])) level.hits[balls_.ray[k]] = {balls_.t[k], level.rays[balls_.ray[k]].own};
  balls_.size = 0;
}

// The nearest hits; not that of the surface at which a ray starts and is through: a flat one is not met again, a ball is
// at its far side.
void Wave::find_first_hits(Level& level) {
  questions_.clear();
  asking_.clear();
  find_own_hits(level);
  const Level& parent = levels_[static_cast<std::size_t>(level.depth) - 2];
  for (std::size_t i = 0; i < level.rays.size(); ++i) {
    const WaveRay& ray = level.rays[i];
    const Hit& own = level.hits[i];
    if (own.found() && prepared_.secluded[primitive_ref(scene_, ray.own).index]) continue;
    questions_.push_back({ray.ray, start_of(ray, parent), ray.own, own});
    asking_.push_back(static_cast<std::uint32_t>(i));
  }
  nearest_beside(prepared_, questions_, stats_->visibility, isa_);
  for (std::size_t k = 0; k < asking_.size(); ++k) level.hits[asking_[k]] = questions_[k].best;
}

// From the first hit of a secondary ray on: the first that is not just a surface inside of a medium that goes on behind
// it.
Hit Wave::first_shaded(Hit hit, WaveRay& ray, Lone& lone) {
  for (;; hit = nearest(prepared_, ray.ray, hit, stats_->visibility, Precision::exact, isa_)) {
    lone = Lone::unknown;
    if (!hit.found() || prepared_.solids.empty()) return hit;
    const std::uint32_t object = scene_.primitive_object[hit.primitive];
    if (!scene_.objects[object].solid) return hit;
    lone = lone_hit(prepared_, ray.ray, hit, isa_, &clearings_);
    const MediaSets::Number behind =
        lone != Lone::unknown
            ? media_.behind_lone(object, lone == Lone::entering, ray.media)
            : media_.number_of(media_behind(prepared_, ray.ray, hit,
                                            surface_at(scene_, ray.ray, hit, stats_->visibility),
                                            media_[ray.media], stats_->visibility));
    if (media_[behind].current() != media_[ray.media].current()) return hit;
    ray.media = behind;
  }
}

}  // namespace sidelight::raytrace
