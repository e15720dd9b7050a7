// SPDX-License-Identifier: MIT
// Sets of media by number are the sets themselves.
#include <doctest/doctest.h>

#include "common/scene/build.h"
#include "raytrace/media_sets.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::raytrace;
using namespace sidelight::test;

namespace {

bool equal(const raytrace::Media& a, const raytrace::Media& b) { return !(a < b) && !(b < a); }

}  // namespace

TEST_CASE("media sets: numbers are crossed as their sets are") {
  constexpr std::uint32_t kSolids = 12;
  Scene scene = empty_scene();
  scene.materials[0].refract = glm::dvec3(0.5);
  for (std::uint32_t i = 0; i < kSolids; ++i) add_sphere(scene, {glm::dvec3(i), 2, 0}, {});
  const Prepared prepared(scene);
  raytrace::Media first = media_at(prepared, {3, 0, 0});
  CHECK(first.certain());
  MediaSets sets(prepared, first);
  Random random(71);
  for (int round = 0; round < 3; ++round) {
    // As many as there are at once, each beside what it stands for.
    std::vector<std::pair<MediaSets::Number, raytrace::Media>> rays(50, {0, first});
    for (int step = 0; step < 4000; ++step) {
      auto& [number, media] = rays[random.below(50)];
      const std::uint32_t solid = random.below(kSolids);
      const bool entering = random.uniform() < 0.5;
      if (random.uniform() < 0.02) {
        number = sets.doubted(number);
        media.doubt();
      } else if (random.uniform() < 0.02) {
        number = 0;
        media = first;
      } else {
        number = sets.behind_lone(solid, entering, number);
        media = media_behind_lone(prepared, solid, entering, media);
      }
      REQUIRE(equal(sets[number], media));
      CHECK(sets[number].current() == media.current());
      CHECK(sets[number].certain() == media.certain());
      CHECK(sets.number_of(media) == number);
    }
    // Those of half the rays are kept, by other numbers.
    std::vector<MediaSets::Number*> numbers;
    for (std::size_t i = 0; i < rays.size(); i += 2) numbers.push_back(&rays[i].first);
    sets.keep(numbers);
    for (std::size_t i = 0; i < rays.size(); i += 2) CHECK(equal(sets[rays[i].first], rays[i].second));
    CHECK(equal(sets[0], first));
    CHECK(!sets.full());
    if (round == 1) sets.clear();
  }
}

TEST_CASE("media sets: other sets have other numbers") {
  Scene scene = empty_scene();
  const Prepared prepared(scene);
  MediaSets sets(prepared, {});
  raytrace::Media media;
  CHECK(sets.number_of(media) == 0);
  for (std::uint32_t solid = 0; solid < 9; ++solid) {
    media.enter(solid);
    CHECK(sets.number_of(media) == solid + 1);
  }
  media.leave(8);
  CHECK(sets.number_of(media) == 8);
  media.leave(0);
  CHECK(sets.number_of(media) == 10);
}
