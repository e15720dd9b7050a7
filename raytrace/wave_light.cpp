// SPDX-License-Identifier: MIT
// Light of a level's hits: shadow rays light by light, and the sums.
#include <bit>

#include "raytrace/wave.h"

namespace sidelight::raytrace {
namespace {

glm::vec3 rgb(const Vec3<float>& v) { return {v.x, v.y, v.z}; }

}  // namespace

void Wave::add_lights(const Level& level, RenderStats& stats) {
  queries_.resize(used_ * ShadingBatch::kCapacity);
  enclosing_.resize(queries_.size());
  for (std::size_t b = 0; b < used_; ++b)
    for (std::size_t i = 0; i < static_cast<std::size_t>(batches_[b].size); ++i) {
      const std::size_t query = b * ShadingBatch::kCapacity + i;
      queries_[query] = shadow_query(level, batches_[b], i);
      enclosing_[query] = enclosing_solid(level, batches_[b], i);
    }
  for (std::size_t light = 0; light < prepared_.tables.lights.size(); ++light) find_shadows(light, stats);
  for (std::size_t b = 0; b < used_; ++b) add_lights_of(batches_[b]);
}

ShadowQuery Wave::shadow_query(const Level& level, const HitBatch& batch, std::size_t i) const {
  const std::uint32_t ray = batch.ray[i];
  ShadowQuery query{get(batch.from, i), level.hits[ray].primitive};
  if (batch.kind == ObjectKind::sphere &&
      !is_entering(scene_, ray_of(level, ray), level.hits[ray], get(batch.facing, i)))
    query.own = kNone;
  return query;
}

// Not of eye rays, most of which travel in the open.
std::size_t Wave::enclosing_solid(const Level& level, const HitBatch& batch, std::size_t i) const {
  if (level.rays.empty()) return Enclosures::kNone;
  const std::uint32_t ray = batch.ray[i];
  return enclosures_.around(get(batch.from, i), level.rays[ray].path.media, level.alone[ray]);
}

// Where a shadow ray is blocked, the light's state becomes that of a surface in its own light: b_i = 0.
void Wave::find_shadows(std::size_t light, RenderStats& stats) {
  const Light& source = scene_.lights[light];
  asking_.resize(queries_.size());
  std::size_t asking = 0;
  for (std::size_t b = 0; b < used_; ++b) {
    ShadingBatch::Channel& state = batches_[b].lit.light[light].state;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batches_[b].size); ++i) {
      const std::size_t query = b * ShadingBatch::kCapacity + i;
      const bool asks = state[i] == LightTerms::kAsk, hidden = enclosures_.hide(enclosing_[query], light);
      asking_[asking] = static_cast<std::uint32_t>(query);
      asking += asks && !hidden;
      stats.rays.shadow += asks;
      stats.self_shadowed += state[i] == LightTerms::kSelfShadowed;
      if (asks && hidden) state[i] = LightTerms::kSelfShadowed;  // b_i = 0, as there
    }
  }
  asking_.resize(asking);
  if (source.directional) {
    dark_.clear();
    for (const std::uint32_t hit : asking_)
      dark_.push_back(blocker(prepared_, ray_to_light(queries_[hit].from, source), nullptr, stats.signs,
                              kRayStart, Precision::exact, isa_)
                          .found());
  } else {
    shadow_packets_.trace(source, queries_, asking_, dark_, stats.signs);
  }
  for (std::size_t k = 0; k < asking; ++k)
    if (dark_[k] != 0)
      batches_[asking_[k] / ShadingBatch::kCapacity].lit.light[light].state[asking_[k] %
                                                                            ShadingBatch::kCapacity] =
          LightTerms::kSelfShadowed;
}

// Masks, and not branches that nobody could predict.
void Wave::add_lights_of(HitBatch& batch) const {
  const auto size = static_cast<std::size_t>(batch.size);
  const auto where = [](std::uint32_t mask, float x) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & mask);
  };
  batch.light = batch.lit.ambient;
  for (auto& channel : batch.missing) channel.fill(0);
  for (const LightTerms& terms : batch.lit.light) {
    std::array<std::uint32_t, ShadingBatch::kCapacity> seen;
    for (std::size_t i = 0; i < size; ++i)
      seen[i] = terms.state[i] == LightTerms::kSelfShadowed ? 0 : ~std::uint32_t{0};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const ShadingBatch::Channel& total = terms.total[channel];
      for (std::size_t i = 0; i < size; ++i) batch.light[channel][i] += where(seen[i], total[i]);
      if (!want_shadow_) continue;
      for (std::size_t i = 0; i < size; ++i) batch.missing[channel][i] += where(~seen[i], total[i]);
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
