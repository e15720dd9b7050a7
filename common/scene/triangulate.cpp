// SPDX-License-Identifier: MIT
// Ear clipping on exact signs. The corners still to be cut form a ring; each knows its turn and whether it is an ear,
// and a cut changes that for its two neighbours only: the other ears of a simple polygon stay as they were. Where
// corners touch or edges cross, this may miss ears that a cut set free, so the ring is searched again, but only a few
// times. Spikes, without area and in the way of others, go before all ears; simple polygons have none.
//
// That ears exist: G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975. An ear here is a
// strictly convex corner whose closed triangle holds no reflex or flat corner; that these suffice: the corner in the
// triangle that is farthest from its base has the polygon's inside above it, so it is not strictly convex. Departure
// from the textbook: a corner at the position of one of the triangle's own (two rings joined by a bridge) is in the
// way only where an edge leads from it into the triangle.
// The normal: M. E. Newell's, in I. E. Sutherland, R. F. Sproull and R. A. Schumacker, "A Characterization of Ten
// Hidden-Surface Algorithms", Computing Surveys 6, 1974. The turn's filter: J. R. Shewchuk, "Adaptive Precision
// Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, section 4.1 (ccwerrboundA).
#include "common/scene/triangulate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "common/model/exact.h"

namespace sidelight {
namespace {

using glm::dvec2;
using glm::dvec3;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr double kRoundoff = 0x1p-53;
constexpr int kSearches = 8;  // of the whole ring for ears; simple polygons need one

// exact::orientation, with the clear cases decided in double.
int turn(const dvec2& a, const dvec2& b, const dvec2& c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double bound = (3 + 16 * kRoundoff) * kRoundoff * (std::abs(left) + std::abs(right));
  if (left - right > bound) return 1;
  if (right - left > bound) return -1;
  return exact::orientation(a, b, c);
}

// Further left, or as far left and further down.
bool lower(const dvec2& a, const dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// --- Into the plane, counter-clockwise ---

std::size_t newell_axis(std::span<const dvec3> polygon) {
  dvec3 normal(0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 a = polygon[i] - polygon[0];
    const dvec3 b = polygon[(i + 1) % polygon.size()] - polygon[0];
    normal += dvec3((a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x), (a.x - b.x) * (a.y + b.y));
  }
  const dvec3 size = glm::abs(normal);
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

// Where the polygon turns at its lowest leftmost point: the winding of a simple polygon, however thin.
int turn_at_extreme(std::span<const dvec2> points) {
  const std::size_t n = points.size();
  const auto lowest = std::min_element(points.begin(), points.end(), lower);
  const auto at = static_cast<std::size_t>(lowest - points.begin());
  std::size_t previous = at, next = at;
  for (std::size_t k = 1; k < n && points[previous] == *lowest; ++k) previous = (previous + n - 1) % n;
  for (std::size_t k = 1; k < n && points[next] == *lowest; ++k) next = (next + 1) % n;
  return turn(points[previous], *lowest, points[next]);
}

// 1 counter-clockwise, -1 clockwise, 0 no area: by the area where rounding cannot change its sign.
int winding(std::span<const dvec2> points) {
  double area = 0, permanent = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const dvec2 a = points[i] - points[0];
    const dvec2 b = points[(i + 1) % points.size()] - points[0];
    area += a.x * b.y - a.y * b.x;
    permanent += std::abs(a.x * b.y) + std::abs(a.y * b.x);
  }
  // Per term: two differences and a product (3 u), their difference (u); then one sum a term. Twice that, for
  // room.
  const double bound = 2 * (static_cast<double>(points.size()) + 4) * kRoundoff * permanent;
  if (std::abs(area) > bound) return area > 0 ? 1 : -1;
  return turn_at_extreme(points);
}

std::vector<dvec2> flattened(std::span<const dvec3> polygon) {
  const auto axis = static_cast<glm::length_t>(newell_axis(polygon));
  std::vector<dvec2> points;
  points.reserve(polygon.size());
  for (const dvec3& p : polygon) points.emplace_back(p[(axis + 1) % 3], p[(axis + 2) % 3]);
  if (winding(points) < 0)
    for (dvec2& p : points) std::swap(p.x, p.y);
  return points;
}

// --- Convex polygons ---

// Convex, with no fan triangle (0, i, i + 1) flat: a corner on an edge at corner 0 must not be fanned away,
// or the mesh would get a T-junction there.
bool fans(std::span<const dvec2> p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i)
    if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0) return false;
  for (std::size_t i = 1; i + 1 < n; ++i)
    if (turn(p[0], p[i], p[i + 1]) <= 0) return false;
  return true;
}

// --- Ears ---

struct Corner {
  std::uint32_t number = 0;  // in the polygon
  dvec2 point{0};
  int turn = 0;        // 1 convex, -1 reflex, 0 flat or a spike
  bool spike = false;  // turns back on itself: no area, and not between its neighbours
  bool ear = false;
};

using Ring = std::vector<Corner>;
using Corners = std::array<dvec2, 3>;  // of a triangle, counter-clockwise

std::size_t previous(const Ring& ring, std::size_t i) { return (i == 0 ? ring.size() : i) - 1; }
std::size_t next(const Ring& ring, std::size_t i) { return i + 1 == ring.size() ? 0 : i + 1; }

// Whether `towards` lies strictly inside the triangle's angle at corner k.
bool within_angle(const Corners& t, std::size_t k, const dvec2& towards) {
  return turn(t[k], t[(k + 1) % 3], towards) > 0 && turn(t[k], towards, t[(k + 2) % 3]) > 0;
}

bool in_the_way(const Ring& ring, std::size_t i, const Corners& t) {
  const dvec2& p = ring[i].point;
  for (std::size_t k = 0; k < 3; ++k)
    if (p == t[k])
      return within_angle(t, k, ring[previous(ring, i)].point) ||
             within_angle(t, k, ring[next(ring, i)].point);
  return turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0;
}

bool is_ear(const Ring& ring, std::size_t i) {
  if (ring[i].turn <= 0) return false;
  const std::size_t before = previous(ring, i), after = next(ring, i);
  const Corners t{ring[before].point, ring[i].point, ring[after].point};
  const dvec2 low = glm::min(t[0], glm::min(t[1], t[2])), high = glm::max(t[0], glm::max(t[1], t[2]));
  for (std::size_t j = 0; j < ring.size(); ++j) {
    if (ring[j].turn > 0 || j == before || j == after) continue;
    const dvec2& p = ring[j].point;
    if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
    if (in_the_way(ring, j, t)) return false;
  }
  return true;
}

void update_turn(Ring& ring, std::size_t i) {
  const dvec2 &a = ring[previous(ring, i)].point, &b = ring[i].point, &c = ring[next(ring, i)].point;
  ring[i].turn = turn(a, b, c);
  const bool between = (lower(a, b) && lower(b, c)) || (lower(c, b) && lower(b, a));
  ring[i].spike = ring[i].turn == 0 && !between;
}

void find_ears(Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i].ear = is_ear(ring, i);
}

void cut(Ring& ring, std::size_t i, Triangles& triangles) {
  triangles.push_back({ring[previous(ring, i)].number, ring[i].number, ring[next(ring, i)].number});
  ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
  const std::size_t after = i == ring.size() ? 0 : i, before = previous(ring, after);
  for (const std::size_t k : {before, after}) update_turn(ring, k);
  for (const std::size_t k : {before, after}) ring[k].ear = is_ear(ring, k);
}

// Taken in the order of the ring, ears would be slivers, side by side from one corner.
Ring::iterator shortest_ear(Ring& ring) {
  auto shortest = ring.end();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (!ring[i].ear) continue;
    const dvec2 across = ring[next(ring, i)].point - ring[previous(ring, i)].point;
    const double length2 = glm::dot(across, across);
    if (length2 >= least) continue;
    least = length2;
    shortest = ring.begin() + static_cast<std::ptrdiff_t>(i);
  }
  return shortest;
}

// Cuts corners until three are left or none can be cut.
void clip_ears(Ring& ring, Triangles& triangles) {
  const auto first = [&](auto has) { return std::find_if(ring.begin(), ring.end(), has); };
  for (std::size_t i = 0; i < ring.size(); ++i) update_turn(ring, i);
  int searches = 0;
  bool searched = false;  // the whole ring, since the last cut
  while (ring.size() > 3) {
    auto it = first([](const Corner& c) { return c.spike; });
    if (it == ring.end()) it = shortest_ear(ring);
    if (it == ring.end() && !searched && searches < kSearches) {
      find_ears(ring);
      ++searches;
      searched = true;
      continue;
    }
    // No ear at all: a corner without area can go without changing what the rest covers.
    if (it == ring.end()) it = first([](const Corner& c) { return c.turn == 0; });
    if (it == ring.end()) return;
    cut(ring, static_cast<std::size_t>(it - ring.begin()), triangles);
    searched = false;
  }
}

}  // namespace

Triangles triangulate(std::span<const dvec3> polygon) {
  assert(polygon.size() >= 3);
  const auto count = static_cast<std::uint32_t>(polygon.size());
  Triangles triangles;
  triangles.reserve(count - 2);
  if (count == 3) return {{0, 1, 2}};

  Ring ring;
  const std::vector<dvec2> points = flattened(polygon);
  for (std::uint32_t i = 0; i < count; ++i) ring.push_back({i, points[i]});
  if (!fans(points)) clip_ears(ring, triangles);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    triangles.push_back({ring[0].number, ring[i].number, ring[i + 1].number});
  return triangles;
}

}  // namespace sidelight
