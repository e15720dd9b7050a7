// SPDX-License-Identifier: MIT
// Light of a level's hits: shadow rays light by light, and the sums.
#include <algorithm>

#include "raytrace/wave.h"

namespace sidelight::raytrace {
namespace {

glm::vec3 rgb(const Vec3<float>& v) { return {v.x, v.y, v.z}; }

}  // namespace

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
  ShadowQuery query{get(batch.from, i), level.hits[ray].primitive};
  if (batch.kind == ObjectKind::sphere &&
      !is_entering(scene_, ray_of(level, ray), level.hits[ray], get(batch.facing, i)))
    query.own = kNone;
  return query;
}

// Where a shadow ray is blocked, the light's state becomes that of a surface in its own light: b_i = 0.
void Wave::find_shadows(const Level& level, std::size_t light, RenderStats& stats) {
  const Light& source = scene_.lights[light];
  // Which hits ask, by batch and entry; then what they ask, and the answers, in the same order.
  asking_.resize(used_ * ShadingBatch::kCapacity);
  std::size_t asking = 0;
  for (std::size_t b = 0; b < used_; ++b) {
    const ShadingBatch::Channel& state = batches_[b].lit.light[light].state;
    const auto size = static_cast<std::size_t>(batches_[b].size);
    for (std::size_t i = 0; i < size; ++i) {
      asking_[asking] = {static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(i)};
      asking += state[i] == LightTerms::kAsk;
    }
    stats.self_shadowed += static_cast<std::uint64_t>(
        std::count(state.begin(), state.begin() + batches_[b].size, LightTerms::kSelfShadowed));
  }
  queries_.resize(asking);
  for (std::size_t k = 0; k < asking; ++k)
    queries_[k] = shadow_query(level, batches_[asking_[k].batch], asking_[k].entry);
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
  for (std::size_t k = 0; k < asking; ++k)
    if (dark_[k] != 0)
      batches_[asking_[k].batch].lit.light[light].state[asking_[k].entry] = LightTerms::kSelfShadowed;
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
      level.color[ray] = c1 * get(batch.light, i);
      if (!eye) continue;
      if (want_shadow_) shadow_[ray] = c1 * get(batch.missing, i);
      if (!want_parts_) continue;
      parts_[0][ray] = c1 * get(batch.lit.ambient, i);
      parts_[1][ray] = c1 * get(batch.lit.diffuse, i);
      parts_[2][ray] = c1 * get(batch.lit.specular, i);
    }
  }
}

}  // namespace sidelight::raytrace
