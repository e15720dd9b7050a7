// SPDX-License-Identifier: MIT
// Triangulation of simple polygons with integer corners, checked in integers: the triangles' directed edges are the
// polygon's plus pairs that cancel, all triangles turn the polygon's way, and their areas add up. Together that says
// they tile it.
#include "common/scene/triangulate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "tests/scene/polygons.h"

using namespace sidelight;
using namespace sidelight::test;
using glm::dvec3;

namespace {

std::vector<dvec3> embedded(const Polygon& polygon, const std::function<dvec3(double, double)>& place) {
  std::vector<dvec3> points;
  for (const Point& p : polygon) points.push_back(place(static_cast<double>(p.x), static_cast<double>(p.y)));
  return points;
}

// Empty where `triangles` tile the polygon (wound either way), else what is wrong. `flat`: triangles without area may
// occur.
std::string tiling_fault(const Polygon& polygon, const Triangles& triangles, bool flat = false) {
  const std::int64_t area = twice_area(polygon);
  const std::int64_t way = area < 0 ? -1 : 1;
  if (triangles.size() != polygon.size() - 2) return "count";
  std::int64_t sum = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : triangles) {
    const std::int64_t part = way * twice_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    if (part < 0 || (part == 0 && !flat)) return part < 0 ? "reversed triangle" : "flat triangle";
    sum += part;
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{t[k], t[(k + 1) % 3]}];
      --edges[{t[(k + 1) % 3], t[k]}];
    }
  }
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    --edges[{i, (i + 1) % n}];
    ++edges[{(i + 1) % n, i}];
  }
  const auto cancels = [](const auto& edge) { return edge.second == 0; };
  if (!std::all_of(edges.begin(), edges.end(), cancels)) return "edges";
  return sum == way * area ? "" : "area";
}

const std::vector<std::function<dvec3(double, double)>> kPlaces{
    [](double x, double y) { return dvec3(x, y, 0); },
    [](double x, double y) { return dvec3(7, x, y); },
    [](double x, double y) { return dvec3(y, -3, x); },
    [](double x, double y) { return dvec3(x, y, x - y + 5); },
    [](double x, double y) { return dvec3(x + 1e6, 3 * x + 2 * y, 2 * x - y); },
};

// In all places, both ways round, from several first corners.
void check_tiling(const Polygon& polygon) {
  Polygon p = polygon;
  for (int round = 0; round < 4; ++round) {
    for (std::size_t place = 0; place < kPlaces.size(); ++place) {
      CAPTURE(place);
      CAPTURE(round);
      CHECK(tiling_fault(p, triangulate(embedded(p, kPlaces[place]))) == "");
    }
    std::rotate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(p.size() / 3), p.end());
    if (round == 1) std::reverse(p.begin(), p.end());
  }
}

}  // namespace

TEST_CASE("triangulate: simple polygons are tiled exactly") {
  const std::vector<std::pair<const char*, std::function<Polygon(Random&, int, std::int64_t)>>> shapes{
      {"star", star}, {"two chains", two_chains}, {"comb", comb}, {"spiral", spiral}, {"grown", grown}};
  for (const auto& [name, make] : shapes)
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
      CAPTURE(name);
      CAPTURE(seed);
      Random random(seed);
      const int corners = static_cast<int>(random.between(3, 40));
      check_tiling(make(random, corners, random.between(4, 1000)));
    }
}

TEST_CASE("triangulate: a convex polygon is a fan from corner 0") {
  const Polygon hexagon{{4, 0}, {3, 3}, {0, 4}, {-4, 1}, {-3, -3}, {1, -4}};
  const Triangles fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  CHECK(triangulate(embedded(hexagon, kPlaces[0])) == fan);
  Polygon reversed = hexagon;
  std::reverse(reversed.begin(), reversed.end());
  CHECK(triangulate(embedded(reversed, kPlaces[1])) == fan);
  CHECK(triangulate(embedded({{0, 0}, {1, 0}, {0, 1}}, kPlaces[0])) == Triangles{{0, 1, 2}});
}

// As long as no corner is reflex but where a low one stands between two high ones, a round of cuts takes off every other corner
// or nearly so, and no cut is longer than the two sides that it replaces: all cuts together are below log2(corners) + 1 times
// the outline. Ears in the order of the ring would fan the wheel out from few corners, by cuts about as long as it is wide.
TEST_CASE("triangulate: a toothed wheel in compact triangles") {
  constexpr int kCorners = 128;
  Polygon wheel;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners, radius = i % 4 < 2 ? 99'000 : 100'000;
    wheel.push_back({std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
  }
  const auto length = [&](std::size_t a, std::size_t b) {
    return std::hypot(static_cast<double>(wheel[a].x - wheel[b].x),
                      static_cast<double>(wheel[a].y - wheel[b].y));
  };
  double outline = 0, edges = 0;
  for (std::size_t i = 0; i < wheel.size(); ++i) outline += length(i, (i + 1) % wheel.size());
  for (const auto& t : triangulate(embedded(wheel, kPlaces[0])))
    for (std::size_t k = 0; k < 3; ++k) edges += length(t[k], t[(k + 1) % 3]);
  const double cuts = (edges - outline) / 2;  // an edge of the outline is in one triangle, a cut in two
  CHECK(cuts < (std::log2(kCorners) + 1) * outline);
}

TEST_CASE("triangulate: corners on an edge never make a T-junction") {
  check_tiling({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {0, 3}});
  check_tiling({{0, 0}, {1, 0}, {2, 0}, {0, 2}});
  check_tiling({{0, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 4}, {0, 4}, {0, 2}});
}

TEST_CASE("triangulate: corners that share a place") {
  const std::vector<Polygon> polygons{
      // A square with a square hole, joined by a bridge that is walked twice.
      {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}},
      // Two holes in a chain.
      {{0, 0},
       {25, 0},
       {25, 20},
       {0, 20},
       {0, 0},
       {3, 9},
       {5, 15},
       {8, 12},
       {13, 6},
       {15, 18},
       {18, 13},
       {16, 2},
       {13, 6},
       {8, 12},
       {6, 4},
       {3, 9}},
      // Two lobes that touch in a corner, the leftmost one.
      {{0, 0}, {9, -9}, {9, -3}, {0, 0}, {9, 3}, {9, 9}},
      // Four lobes around one place, each within a quadrant.
      {{0, 0},
       {9, 1},
       {5, 4},
       {2, 8},
       {0, 0},
       {-1, 7},
       {-6, 6},
       {-9, 1},
       {0, 0},
       {-5, -1},
       {-1, -5},
       {0, 0},
       {1, -9},
       {2, -4},
       {9, -1}},
      // Corners given twice.
      {{0, 0}, {5, 0}, {5, 0}, {5, 5}, {2, 2}, {2, 2}, {0, 5}}};
  for (const Polygon& polygon : polygons) {
    Polygon p = polygon;
    for (std::size_t first = 0; first < p.size(); ++first) {
      CAPTURE(first);
      CHECK(tiling_fault(p, triangulate(embedded(p, kPlaces[0])), true) == "");
      std::rotate(p.begin(), p.begin() + 1, p.end());
    }
  }
}

TEST_CASE("triangulate: the last bit decides") {
  // The middle corner of the upper edge lies one ulp below or above the line of its neighbours.
  for (const double up : {0.5 - 0x1p-54, 0.5, 0.5 + 0x1p-53}) {
    const std::vector<dvec3> p{{0, 0, 1}, {1, 0, 1}, {1, 0.5, 1}, {0.25, up, 1}, {0, 0.5, 1}};
    const Triangles fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    CAPTURE(up);
    CHECK((triangulate(p) == fan) == (up >= 0.5));
    std::vector<dvec3> q(p.begin() + 2, p.end());
    q.insert(q.end(), p.begin(), p.begin() + 2);
    CHECK((triangulate(q) == fan) == (up > 0.5));  // a fan would have a flat triangle at 0.5
  }
}

TEST_CASE("triangulate: where double cannot decide, the exact sign does") {
  // p lies by (i, j) ulps of 0.5 off the line y = x through the corners (24, 24) and (12, 12), as in L. Kettner et al.,
  // "Classroom Examples of Robustness Problems in Geometric Computations", 2008: the polygon is convex iff i > j.
  const Triangles fan{{0, 1, 2}, {0, 2, 3}};
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      const std::vector<dvec3> p{
          {0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53, 0}, {24, 0, 0}, {24, 24, 0}, {12, 12, 0}};
      CHECK((triangulate(p) == fan) == (i > j));
    }
}

TEST_CASE("triangulate: bad polygons give their number of triangles, all of valid corners") {
  const std::vector<Polygon> polygons{{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 0}},           // on one line
                                      {{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}},           // in one place
                                      {{0, 0}, {4, 4}, {4, 0}, {0, 4}},                   // a bow tie
                                      {{0, 10}, {6, -8}, {-10, 3}, {10, 3}, {-6, -8}},    // a pentagram
                                      {{0, 0}, {4, 0}, {8, 0}, {4, 0}, {4, 4}, {4, 0}}};  // spikes
  for (const Polygon& polygon : polygons) {
    const Triangles triangles = triangulate(embedded(polygon, kPlaces[0]));
    CHECK(triangles.size() == polygon.size() - 2);
    for (const auto& t : triangles)
      for (const std::uint32_t corner : t) CHECK(corner < polygon.size());
  }
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Polygon noise;
    for (std::int64_t k = random.between(4, 30); k > 0; --k)
      noise.push_back({random.between(0, 5), random.between(0, 5)});
    CHECK(triangulate(embedded(noise, kPlaces[3])).size() == noise.size() - 2);
  }
}

TEST_CASE("triangulate: ten thousand corners") {
  Random random(11);
  const Polygon large = spiral(random, 4'999, 0);
  REQUIRE(large.size() == 10'000);
  CHECK(tiling_fault(large, triangulate(embedded(large, kPlaces[0]))) == "");
}
