// SPDX-License-Identifier: MIT
// The places of shadow rays on the faces of a cube around the light: every instruction set finds those of a plain loop, bit
// for bit, and no query is seen through two faces.
#include <doctest/doctest.h>

#include "raytrace/shadow_places.h"
#include "tests/support/random.h"

using namespace sidelight;
using namespace sidelight::test;
using namespace sidelight::raytrace;

namespace {

// One place after the other: those of queries that ask, and lie behind the face if `behind`. Whether it shows them all.
bool find_plainly(const ShadowQueries& queries, const CubeFace& face, bool behind, ShadowPlaces& places) {
  bool seen = true;
  places.resize(0);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (queries.asks[i] == 0) continue;
    const glm::dvec3 from = queries.from(i), p = from - face.light;
    const CubeFace own = face_towards(from, face.light);
    const double depth = face.sign * p[face.axis], per_depth = 1 / depth;
    const double u = per_depth * p[(face.axis + 1) % 3], v = per_depth * p[(face.axis + 2) % 3];
    const bool deep = depth >= CubeFace::kLeastDepth;
    if (behind && !(deep && own.axis == face.axis && own.sign == face.sign)) continue;
    seen &= deep && std::abs(u) <= CubeFace::kWide && std::abs(v) <= CubeFace::kWide;
    places.u.push_back(static_cast<float>(u - face.middle_u));
    places.v.push_back(static_cast<float>(v - face.middle_v));
    places.per_depth.push_back(static_cast<float>(per_depth));
    places.number.push_back(static_cast<std::int32_t>(i));
    places.own.push_back(queries.own[i]);
  }
  return seen;
}

bool same(const ShadowPlaces& a, const ShadowPlaces& b) {
  return a.u == b.u && a.v == b.v && a.per_depth == b.per_depth && a.number == b.number && a.own == b.own;
}

// On a grid, so that points lie on the borders of faces, on the light and beside it; or in a narrow cone.
ShadowQueries drawn_queries(Random& random, const glm::dvec3& light, bool narrow) {
  ShadowQueries queries;
  const std::uint32_t size = 1 + random.below(70);
  queries.resize(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    const glm::dvec3 off =
        narrow ? glm::dvec3(0.1, 1, 0.2) + 0.25 * random.in_box(1) : glm::dvec3(random.on_grid(3));
    queries.x[i] = light.x + off.x;
    queries.y[i] = light.y + off.y;
    queries.z[i] = light.z + off.z;
    queries.own[i] = random.below(3) == 0 ? -1 : static_cast<std::int32_t>(i);
    queries.asks[i] = random.below(4) != 0;
  }
  return queries;
}

}  // namespace

TEST_CASE("shadow places are those of a plain loop, on every instruction set") {
  Random random(910);
  std::size_t all_seen = 0, not_all = 0;
  for (int round = 0; round < 400; ++round) {
    const glm::dvec3 light = random.on_grid(5);
    const ShadowQueries queries = drawn_queries(random, light, round % 2 == 0);
    for (const Isa isa : kIsas) {
      if (!machine_has(isa)) continue;
      CAPTURE(round);
      CAPTURE(static_cast<int>(isa));
      ShadowPlaces expected, found;
      const CubeFace face = face_towards(queries.from(0), light);
      const bool seen = find_plainly(queries, face, false, expected);
      REQUIRE(find_places(isa, queries, face, true, found) == seen);
      if (seen) CHECK(same(found, expected));
      ++(seen ? all_seen : not_all);

      std::size_t behind = 0, asking = 0;
      for (int number = 0; number < 6; ++number) {
        const CubeFace one{number / 2, number % 2 == 0 ? 1.0 : -1.0, light};
        find_plainly(queries, one, true, expected);
        find_places(isa, queries, one, false, found);
        CHECK(same(found, expected));
        behind += found.size();
      }
      for (std::size_t i = 0; i < queries.size(); ++i)
        asking += queries.asks[i] != 0 && queries.from(i) != light;
      CHECK(behind == asking);
    }
  }
  CHECK(all_seen > 100);
  CHECK(not_all > 100);
}
