// SPDX-License-Identifier: MIT
#include "raytrace/media_sets.h"

#include <algorithm>
#include <utility>

namespace sidelight::raytrace {

MediaSets::MediaSets(const Prepared& prepared, Media first) : prepared_(prepared) {
  number_of(std::move(first));
}

void MediaSets::keep(std::span<Number* const> numbers) {
  const std::vector<Set> before = std::exchange(sets_, {});
  numbers_.clear();
  crossings_.fill({});
  number_of(before[0].media);
  for (Number* const number : numbers) *number = number_of(before[*number].media);
  full_ = std::max(kFull, 2 * sets_.size());
}

MediaSets::Number MediaSets::number_of(const Media& media) {
  const auto [known, is_new] = numbers_.try_emplace(media, static_cast<Number>(sets_.size()));
  if (is_new) sets_.push_back({media, kNone});
  return known->second;
}

MediaSets::Number MediaSets::behind_lone(std::uint32_t object, bool entering, Number media) {
  Crossing& last = crossings_[(2 * object + (entering ? 1 : 0) + 37 * media) % kRemembered];
  if (last.object != object || last.entering != entering || last.before != media) {
    const Number behind = number_of(media_behind_lone(prepared_, object, entering, sets_[media].media));
    last = {object, entering, media, behind};
  }
  return last.behind;
}

MediaSets::Number MediaSets::doubted(Number media) {
  if (sets_[media].doubted == kNone) {
    Media doubted = sets_[media].media;
    doubted.doubt();
    const Number number = number_of(doubted);
    sets_[media].doubted = number;
  }
  return sets_[media].doubted;
}

}  // namespace sidelight::raytrace
