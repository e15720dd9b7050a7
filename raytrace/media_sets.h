// SPDX-License-Identifier: MIT
// Sets of media (media.h) by number, each kept once: a ray of a wave carries a number in place of its own set, and the
// crossings that many rays do alike are found once. For one thread.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "raytrace/media.h"

namespace sidelight::raytrace {

class MediaSets {
 public:
  using Number = std::uint32_t;

  // `first` is number 0.
  MediaSets(const Prepared& prepared, Media first);

  // Forgets all sets but the first and these, which get new numbers.
  void keep(std::span<Number* const> numbers);
  void clear() { keep({}); }
  // Whether there are so many that those should be forgotten which no ray has any more.
  bool full() const { return sets_.size() >= full_; }

  // Until another set is added.
  const Media& operator[](Number media) const { return sets_[media].media; }
  // Of a set that is known or new: equal sets have one number.
  Number number_of(const Media& media);

  // media_behind_lone().
  Number behind_lone(std::uint32_t object, bool entering, Number media);
  // After Media::doubt().
  Number doubted(Number media);

 private:
  static constexpr std::size_t kRemembered = 256;
  static constexpr std::size_t kFull = 4096;

  struct Set {
    Media media;
    Number doubted;
  };
  struct Crossing {
    std::uint32_t object = kNone;
    bool entering = false;
    Number before = 0, behind = 0;
  };

  const Prepared& prepared_;
  std::vector<Set> sets_;
  std::size_t full_ = kFull;
  std::map<Media, Number> numbers_;
  std::array<Crossing, kRemembered> crossings_;  // the last ones
};

}  // namespace sidelight::raytrace
