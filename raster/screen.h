// SPDX-License-Identifier: MIT
// Where the samples see a vertex: its place on the lattice in fixed point, and 1/t. Vertices are projected once a frame;
// boxes, tiny and small triangles are made of these records. A certificate, not a picture: the true place lies within
// kSnapped of a unit, which is a term of every bound (screen_triangle.h), and no bit of a record reaches the frame.
//
// Fixed point, because differences of integers are exact: at x = 1000 a float would be worth 2^-14 samples.
#pragma once

#include <cstdint>
#include <span>

#include "common/math/four.h"
#include "common/math/lane_ops.h"
#include "common/scene/camera.h"

namespace sidelight::raster {

// Half-open rectangle of lattice samples; empty where x0 >= x1 or y0 >= y1.
struct SampleBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

struct alignas(16) ScreenVertex {
  std::int32_t x = 0, y = 0;  // from the lattice's centre, in units of 2^-bits samples; y down
  float w = 0;                // 1/t of the point on its ray: 2nH / (a.f)
  std::uint32_t state = 0;  // ScreenSpace's flags; 0 where x, y and w hold and the point may be on the screen
};

struct ScreenSpace {
  explicit ScreenSpace(const Camera& camera);

  // A vertex with this flag has no place in fixed point: beside or behind the eye, too far out, or rounding may have
  // moved it too far. The other flags hold for every vertex: surely behind the eye, or beyond a side of the picture.
  // What is so for three corners is so for their triangle.
  static constexpr std::uint32_t kUnplaced = 1, kBehind = 2, kLeft = 4, kRight = 8, kAbove = 16, kBelow = 32;

  glm::dvec3 eye, right, up, forward;
  int columns, rows;  // of the lattice
  int bits;           // of a sample's fraction
  int center_x, center_y;
  double scale;               // 2nH / h²: a.r / a.f times this is 2X + 1 - nW
  double depth_scale;         // 2nH
  double half_unit;           // units in half a sample
  double offset_x, offset_y;  // of the picture's centre, in units
  double lens;                // 2nH / h: how fast rounding grows into samples
};

ScreenVertex project(const ScreenSpace& space, const glm::dvec3& vertex);

// The samples between a triangle's corners, all of them placed, each up to a unit off: where it may be seen.
template <class I>
struct Box {
  I x0, y0, x1, y1;
};
template <class I>
Box<I> box_of_places(const ScreenSpace& space, const I& left, const I& top, const I& right, const I& bottom) {
  const int bits = space.bits, last = (1 << space.bits) - 1;
  const auto first_from = [&](const I& low) { return (low - I(1) + I(last)) >> bits; };
  const auto end_at = [&](const I& high) { return ((high + I(1)) >> bits) + I(1); };
  return {lane_max(first_from(left) + I(space.center_x), I(0)),
          lane_max(first_from(top) + I(space.center_y), I(0)),
          lane_min(end_at(right) + I(space.center_x), I(space.columns)),
          lane_min(end_at(bottom) + I(space.center_y), I(space.rows))};
}

// ---- The kernel, for lanes D of doubles ----

// The records of as many vertices.
template <class D, class I, class W>
void put_records(const I& x, const I& y, const W& w, const I& state, ScreenVertex* to) {
  constexpr int kCount = kLanes<D>;
  if constexpr (kCount == 1) {
    *to = {x, y, w, static_cast<std::uint32_t>(state)};
  } else {
    alignas(64) std::int32_t xs[kCount], ys[kCount], states[kCount];
    alignas(64) float ws[kCount];
    store(x, xs);
    store(y, ys);
    store(w, ws);
    store(state, states);
    for (int i = 0; i < kCount; i += 4) {
      const auto records =
          transposed(load_four(xs + i), load_four(ys + i), load_four(ws + i), load_four(states + i));
      for (std::size_t k = 0; k < 4; ++k) store_four(records[k], to + i + k);
    }
  }
}

// Derivation. X = (scale a.r / a.f + columns - 1) / 2 in exact arithmetic. With q = |a|_1 / a.f the dot products are
// off by at most 4u |a||r| and 4u |a|, so scale a.r / a.f by 8u q² lens; that a, r, u, f and the sample's own ray are
// rounded adds 8u q lens, that r, u and f are orthogonal only up to rounding 8u q lens, the quotient by way of 1/(a.f) 2u
// and the sums 4u (columns + rows).
// 2^-47 = 64u times (q² lens + columns + rows) is more than all. Placed is what this leaves within a quarter of a unit;
// rounding to a whole number of units adds a half.
template <class D>
void project_lanes(const ScreenSpace& space, const D& vx, const D& vy, const D& vz, ScreenVertex* to) {
  const D ax = vx - D(space.eye.x), ay = vy - D(space.eye.y), az = vz - D(space.eye.z);
  const auto along = [&](const glm::dvec3& axis) {
    return (ax * D(axis.x) + ay * D(axis.y)) + az * D(axis.z);
  };
  const D size = (lane_abs(ax) + lane_abs(ay)) + lane_abs(az);
  const D depth = along(space.forward), x = D(space.scale) * along(space.right),
          y = D(space.scale) * along(space.up);
  const Mask<D> in_front = depth > size * D(0x1p-10);
  const D per_depth = D(1) / select<D>(in_front, depth, D(1));
  const D place_x = D(space.half_unit) * (x * per_depth) + D(space.offset_x);
  const D place_y = D(space.offset_y) - D(space.half_unit) * (y * per_depth);
  const D q = size * per_depth;
  const D extent(static_cast<double>(space.columns) + static_cast<double>(space.rows));
  const D moved = D(0x1p-46) * (D(space.half_unit) * (q * q * D(space.lens) + extent));
  const D limit(0x1p30 - 4);
  const Mask<D> placed =
      in_front && moved <= D(0.25) && lane_abs(place_x) < limit && lane_abs(place_y) < limit;

  // Beyond a side of the frustum by half a sample and the rounding above.
  const D slack = D(0x1p-46 * (space.lens + space.columns + space.rows)) * size;
  const D half_width = D(space.columns) * depth, half_height = D(space.rows) * depth;
  const auto flag = [](const Mask<D>& mask, std::uint32_t bit) { return select<D>(mask, D(bit), D(0)); };
  const D state =
      flag(!placed, ScreenSpace::kUnplaced) + flag(depth < size * D(-0x1p-40), ScreenSpace::kBehind) +
      flag(x + half_width < -slack, ScreenSpace::kLeft) + flag(x - half_width > slack, ScreenSpace::kRight) +
      flag(y - half_height > slack, ScreenSpace::kAbove) +
      flag(y + half_height < -slack, ScreenSpace::kBelow);

  // A double's low bits after adding 1.5 * 2^52 are its nearest integer.
  const D round(0x1.8p52);
  const auto integer = [&](const D& v) { return low_halves<D>(to_bits<D>(v + round)); };
  put_records<D>(integer(select<D>(placed, place_x, D(0))), integer(select<D>(placed, place_y, D(0))),
                 to_float(D(space.depth_scale) * per_depth), integer(state), to);
}

}  // namespace sidelight::raster
