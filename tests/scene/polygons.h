// SPDX-License-Identifier: MIT
// Simple polygons with integer corners, counter-clockwise, to be triangulated.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/random.h"

namespace sidelight::test {

struct Point {
  std::int64_t x = 0, y = 0;
  bool operator==(const Point&) const = default;
};
using Polygon = std::vector<Point>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

inline std::int64_t twice_area(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

inline int turn(const Point& a, const Point& b, const Point& c) {
  const std::int64_t area = twice_area(a, b, c);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

inline std::int64_t twice_area(const Polygon& polygon) {
  std::int64_t area = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    area += twice_area(polygon[0], polygon[i], polygon[i + 1]);
  return area;
}

// Star-shaped around the origin: random points by angle, one a direction.
inline Polygon star(Random& random, int corners, std::int64_t size) {
  Polygon p{{size, 0}, {0, size}, {-size, 0}, {0, -size}};
  for (int i = 0; i < corners; ++i) p.push_back({random.between(-size, size), random.between(-size, size)});
  std::erase(p, Point{});
  const auto lower = [](const Point& a) { return a.y < 0 || (a.y == 0 && a.x < 0); };
  const auto cross = [](const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; };
  const auto before = [&](const Point& a, const Point& b) {
    return lower(a) != lower(b) ? lower(b) : cross(a, b) > 0;
  };
  std::sort(p.begin(), p.end(), before);
  p.erase(std::unique(p.begin(), p.end(), [&](auto& a, auto& b) { return !before(a, b); }), p.end());
  return p;
}

// Two chains over the same columns, above and below the x axis; flat stretches happen.
inline Polygon two_chains(Random& random, int corners, std::int64_t height) {
  Polygon p;
  for (int i = 0; i <= corners; ++i) p.push_back({i, -random.between(1, height)});
  for (int i = corners; i >= 0; --i) p.push_back({i, random.between(1, height)});
  return p;
}

inline Polygon comb(Random& random, int teeth, std::int64_t length) {
  Polygon p{{0, -1}, {2 * teeth, -1}};
  for (int i = teeth; i > 0; --i) {
    p.push_back({2 * i, random.between(1, length)});
    p.push_back({2 * i - 1, 0});
  }
  p.push_back({0, random.between(1, length)});
  return p;
}

// A corridor of width 1 of `turns` legs that winds inwards.
inline Polygon spiral(Random&, int turns, std::int64_t) {
  Polygon outer, inner;
  const std::int64_t step[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  Point at{0, 0};
  for (int i = 0; i < turns; ++i) {
    const std::int64_t length = 2 * (turns - i) + 2;
    const auto* s = step[i % 4];
    const auto* left = step[(i + 1) % 4];
    outer.push_back(at);
    // The inner wall starts one to the left of and one along this leg.
    inner.push_back({at.x + left[0] + (i > 0 ? s[0] : 0), at.y + left[1] + (i > 0 ? s[1] : 0)});
    at = {at.x + length * s[0], at.y + length * s[1]};
  }
  const auto* left = step[turns % 4];
  outer.push_back(at);
  inner.push_back({at.x + left[0], at.y + left[1]});
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  return outer;
}

inline bool meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto on = [](const Point& p, const Point& q, const Point& r) {
    return turn(p, q, r) == 0 && std::min(p.x, q.x) <= r.x && r.x <= std::max(p.x, q.x) &&
           std::min(p.y, q.y) <= r.y && r.y <= std::max(p.y, q.y);
  };
  if (on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)) return true;
  return turn(a, b, c) != turn(a, b, d) && turn(c, d, a) != turn(c, d, b);
}

// Whether a new edge from corner `from` (i or i + 1) to `at`, in place of edge i, meets no other edge of the polygon.
inline bool free_edge(const Polygon& p, std::size_t i, const Point& at, std::size_t from) {
  for (std::size_t k = 0; k < p.size(); ++k) {
    const std::size_t l = (k + 1) % p.size();
    if (k == i) continue;
    const Point& end = p[from];
    if (k == from || l == from) {  // a neighbour: may meet in the shared corner alone
      const Point& other = k == from ? p[l] : p[k];
      const std::int64_t ahead = (other.x - end.x) * (at.x - end.x) + (other.y - end.y) * (at.y - end.y);
      if (turn(other, end, at) == 0 && ahead > 0) return false;
    } else if (meet(p[k], p[l], end, at)) {
      return false;
    }
  }
  return true;
}

// Any shape: an edge at a time is replaced by two through a random point, as long as the polygon stays simple.
inline Polygon grown(Random& random, int corners, std::int64_t size) {
  Polygon p{{0, 0}, {size, 0}, {0, size}};
  for (int tries = 0; tries < 50 * corners && p.size() < static_cast<std::size_t>(corners); ++tries) {
    const auto i = static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(p.size()) - 1));
    const std::size_t j = (i + 1) % p.size();
    const Point at{random.between(0, size), random.between(0, size)};
    if (at == p[i] || at == p[j] || !free_edge(p, i, at, i) || !free_edge(p, i, at, j)) continue;
    if (turn(p[i], at, p[j]) == 0) continue;
    p.insert(p.begin() + static_cast<std::ptrdiff_t>(i + 1), at);
  }
  if (twice_area(p) < 0) std::reverse(p.begin(), p.end());
  return p;
}

}  // namespace sidelight::test
