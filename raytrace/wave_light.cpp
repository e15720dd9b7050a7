// SPDX-License-Identifier: MIT
// Light of a level's hits: shadow rays light by light, and the sums.
#include <algorithm>
#include <bit>

#include "raytrace/wave.h"

namespace sidelight::raytrace {
namespace {

glm::vec3 rgb(const Vec3<float>& v) { return {v.x, v.y, v.z}; }

}  // namespace

void Wave::add_lights(const Level& level) {
  find_queries(level);
  for (std::size_t light = 0; light < prepared_.tables.lights.size(); ++light) find_shadows(light);
  for (std::size_t b = 0; b < used_; ++b) add_lights_of(batches_[b]);
}

void Wave::find_queries(const Level& level) {
  constexpr std::size_t kCapacity = ShadingBatch::kCapacity;
  queries_.resize(used_ * kCapacity);
  queries_.seen_by_eye = level.is_eye();
  // Not of eye rays, most of which travel in the open.
  const bool may_enclose = !queries_.seen_by_eye && !prepared_.solids.empty();
  enclosing_.resize(may_enclose ? queries_.size() : 0);
  for (std::size_t b = 0, first = 0; b < used_; ++b, first += kCapacity) {
    const HitBatch& batch = batches_[b];
    const auto size = static_cast<std::size_t>(batch.size);
    std::copy_n(batch.from[0].begin(), size, &queries_.x[first]);
    std::copy_n(batch.from[1].begin(), size, &queries_.y[first]);
    std::copy_n(batch.from[2].begin(), size, &queries_.z[first]);
    for (std::size_t i = 0; i < size; ++i)
      queries_.own[first + i] = static_cast<std::int32_t>(level.hits[batch.ray[i]].primitive);
    for (std::size_t i = 0; i < size && batch.kind == ObjectKind::sphere; ++i)
      if (batch.entering[i] == 0) queries_.own[first + i] = -1;
    for (std::size_t i = 0; i < size && may_enclose; ++i)
      enclosing_[first + i] = enclosures_.around(get(batch.from, i), media_[level.rays[batch.ray[i]].media],
                                                 level.lone[batch.ray[i]] != Lone::unknown);
  }
}

// Where a shadow ray is blocked, the light's state becomes that of a surface in its own light: b_i = 0.
void Wave::find_shadows(std::size_t light) {
  const Light& source = scene_.lights[light];
  find_asking(light);
  shadow_packets_.trace(source, queries_, dark_, stats_->visibility);
  for (std::size_t b = 0, first = 0; b < used_; ++b, first += ShadingBatch::kCapacity) {
    ShadingBatch::Channel& state = batches_[b].lit.light[light].state;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batches_[b].size); ++i)
      state[i] = dark_[first + i] != 0 ? LightTerms::kSelfShadowed : state[i];
  }
}

// Which queries ask this light.
void Wave::find_asking(std::size_t light) {
  for (std::size_t b = 0, first = 0; b < used_; ++b, first += ShadingBatch::kCapacity) {
    ShadingBatch::Channel& state = batches_[b].lit.light[light].state;
    const auto size = static_cast<std::size_t>(batches_[b].size);
    std::int32_t* asks = &queries_.asks[first];
    unsigned asking = 0, shadowed = 0;
    for (std::size_t i = 0; i < size; ++i) {
      asks[i] = state[i] == LightTerms::kAsk;
      asking += static_cast<unsigned>(asks[i]);
      shadowed += state[i] == LightTerms::kSelfShadowed;
    }
    std::fill(asks + size, asks + ShadingBatch::kCapacity, 0);
    stats_->rays.shadow += asking;
    stats_->self_shadowed += shadowed;
    for (std::size_t i = 0; i < size && asking > 0 && !enclosing_.empty(); ++i)
      if (asks[i] != 0 && enclosures_.hide(enclosing_[first + i], light)) {
        asks[i] = 0;
        state[i] = LightTerms::kSelfShadowed;  // b_i = 0, as there
      }
  }
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
void Wave::sum_up(Level& level) {
  const bool eye = level.is_eye();
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
