// SPDX-License-Identifier: MIT
// Which primitives of a leaf a ray may meet: filters over lanes D of doubles, each verdict certified by a bound on its
// rounding. A primitive is dropped only where exact arithmetic, and so visibility.h, would find no hit at a depth in
// (0, limit]; what is left is asked there. Included by the kernels only (kernels_in_lanes.h); nothing is fused.
#pragma once

#include "common/math/lane_ops.h"
#include "common/math/norms.h"
#include "common/model/visibility.h"
#include "raytrace/bvh.h"

namespace sidelight::raytrace {

// One bit for each primitive of a leaf: those that may be met, and those of them that surely are, at a positive depth.
struct LeafVerdict {
  std::uint32_t may = 0, must = 0;
};

// That of `count` primitives, of meet(lane) for the lanes from each on.
template <class D, class Meet>
[[gnu::always_inline]] inline LeafVerdict verdict_of_leaf(std::uint32_t count, const Meet& meet) {
  const std::uint32_t used =
      count < Bvh::kMaxLeaf ? count : Bvh::kMaxLeaf;  // so that eight lanes are known to be enough
  LeafVerdict verdict;
  for (std::uint32_t lane = 0; lane < used; lane += kLanes<D>) {
    const LeafVerdict of_lanes = meet(lane);
    verdict.may |= of_lanes.may << lane;
    verdict.must |= of_lanes.must << lane;
  }
  verdict.may &= (1u << count) - 1;
  verdict.must &= verdict.may;
  return verdict;
}

inline constexpr double kUnit = 0x1p-53;  // unit roundoff
// Depths of visibility.h are good to 2^-18.
inline constexpr double kDepthSlack = 1 + 0x1p-16;

// S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: sheared so that the ray runs
// along an axis, a triangle is seen as a flat one, and its edge functions E_k are those of the plane.
//
// Rounding. Of a corner a = v - o, sheared, x = a_x - s_x a_z with |s_x| <= 1 is off by 2 u |a_z| for s_x, u |a_z| for the
// product and u |x| for the difference. With m = |x| + |y| and W at least all 3 |a_z| + m, E_k = x_i y_j - x_j y_i is off
// by u W (m_i + m_j) + 2 u² W² for that, and by 2 u m_i m_j of its own: error = 4 u W (m_0 + m_1 + m_2 + 4 u W) is more.
//   t d_z = N / sum E_k, N = sum E_k a_kz
// N is off by 2 u W M sum |a_kz| for the errors of E_k, with M the sum of all m; and as |E_k| <= m_i m_j <= W M / 2, by
// 1.5 u W M sum |a_kz| for its own products and sums, by u W M sum |a_kz| when divided by d_z: 1.5 errors times
// sum |a_kz| is more.
template <class D>
class TriangleFilter {
 public:
  static constexpr int kRows = 9;

  TriangleFilter() = default;  // to be set
  explicit TriangleFilter(const Ray& ray) {
    const int axis_z =
        greatest_axis(lane_abs(ray.direction.x), lane_abs(ray.direction.y), lane_abs(ray.direction.z));
    const int axis_x = axis_z == 2 ? 0 : axis_z + 1, axis_y = axis_z == 0 ? 2 : axis_z - 1;
    axis_ = {static_cast<std::size_t>(axis_x), static_cast<std::size_t>(axis_y),
             static_cast<std::size_t>(axis_z)};
    for (std::size_t i = 0; i < 3; ++i) origin_[i] = ray.origin[static_cast<int>(axis_[i])];
    inverse_z_ = 1 / ray.direction[axis_z];
    doubt_z_ = 1.5 * lane_abs(inverse_z_);
    shear_x_ = ray.direction[axis_x] * inverse_z_;
    shear_y_ = ray.direction[axis_y] * inverse_z_;
  }

  // Of the `count` triangles of a leaf, which are met at a depth in (0, limit].
  LeafVerdict operator()(const double* leaf, std::uint32_t count, double limit) const {
    const std::size_t rows = count;
    return verdict_of_leaf<D>(count, [&](std::uint32_t lane) {
      const double* first = leaf + lane;
      return meet({first + axis_[0] * rows, first + axis_[1] * rows, first + axis_[2] * rows}, 3 * rows,
                  limit);
    });
  }

 private:
  // from[i]: that axis of the first corner, those of the next ones each `corner` further on.
  LeafVerdict meet(const std::array<const double*, 3>& from, std::size_t corner, double limit) const {
    D x[3], y[3], z[3], m[3], far[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = [&](std::size_t i) { return load<D>(from[i] + k * corner) - D(origin_[i]); };
      z[k] = a(2);
      x[k] = a(0) - D(shear_x_) * z[k];
      y[k] = a(1) - D(shear_y_) * z[k];
      m[k] = lane_abs<D>(x[k]) + lane_abs<D>(y[k]);
      far[k] = lane_abs<D>(z[k]);
    }
    const D size = (m[0] + m[1]) + m[2], depth = (far[0] + far[1]) + far[2];
    const auto wide = [&](std::size_t k) { return D(3) * far[k] + m[k]; };
    const D widest = lane_max<D>(lane_max<D>(wide(0), wide(1)), wide(2));
    const D slack = D(4 * kUnit) * widest;
    const D error = slack * (size + slack);
    const D e0 = x[1] * y[2] - x[2] * y[1], e1 = x[2] * y[0] - x[0] * y[2], e2 = x[0] * y[1] - x[1] * y[0];
    const D low = lane_min<D>(lane_min<D>(e0, e1), e2), high = lane_max<D>(lane_max<D>(e0, e1), e2);

    const D sum = (e0 + e1) + e2, depths = ((e0 * z[0] + e1 * z[1]) + e2 * z[2]) * D(inverse_z_);
    const D turned = select<D>(sum < D(0), -depths, depths);  // t |sum|
    const D doubt = error * depth * D(doubt_z_);
    const D total = lane_abs<D>(sum), margin = D(4) * error;
    const Mask<D> apart = low < -error && high > error;  // of different sign
    const Mask<D> behind = turned<-doubt, beyond = turned - doubt> D(limit * kDepthSlack) * (total + margin);
    const Mask<D> met = (low > error || high < -error) && turned > doubt;
    return {mask_bits<D>(!(apart || (total > margin && (behind || beyond)))), mask_bits<D>(met)};
  }

  std::array<std::size_t, 3> axis_;
  std::array<double, 3> origin_;
  double shear_x_, shear_y_, inverse_z_, doubt_z_;
};

// Rounding. A bounds all components of f = o - c and the radius. The point of the line that is nearest to the centre is
// found as f - (f.d / d.d) d, off by at most 22 u A in each component, 64 u A with room; visibility.h's is as much off.
// Its own rounding of a root is small only where the line runs well inside; elsewhere nothing is said of depths.
template <class D>
class SphereFilter {
 public:
  static constexpr int kRows = 4;

  SphereFilter() = default;  // to be set
  SphereFilter(const Ray& ray, double reach) {
    double largest = reach;
    for (std::size_t i = 0; i < 3; ++i) {
      const int axis = static_cast<int>(i);
      origin_[i] = ray.origin[axis];
      direction_[i] = ray.direction[axis];
      largest = lane_max(largest, lane_abs(origin_[i]));
    }
    reach_ = 2 * largest;
    inverse_square_ =
        1 / ((direction_[0] * direction_[0] + direction_[1] * direction_[1]) + direction_[2] * direction_[2]);
    doubt_ = 0x1p-20 * reach_ * square_root(inverse_square_);
    clear_ = 0x1p-32 * reach_ * reach_;
    if (!(clear_ * inverse_square_ > 0x1p-900)) clear_ = std::numeric_limits<double>::infinity();
  }

  // Of the `count` spheres of a leaf, which may be met at a depth in (0, limit]; which surely are, before the limit and all
  // rounding of it (before_light()).
  LeafVerdict operator()(const double* leaf, std::uint32_t count, double limit) const {
    return verdict_of_leaf<D>(count, [&](std::uint32_t lane) { return meet(leaf + lane, count, limit); });
  }

 private:
  LeafVerdict meet(const double* leaf, std::uint32_t count, double limit) const {
    const D radius = load<D>(leaf + 3 * count), slack(128 * kUnit * reach_);
    D f[3], along(0), from_center2(0), distance2(0), size(0);
    for (std::uint32_t i = 0; i < 3; ++i) {
      f[i] = D(origin_[i]) - load<D>(leaf + i * count);
      along = along - f[i] * D(direction_[i]);
      from_center2 = from_center2 + f[i] * f[i];
    }
    const D t = along * D(inverse_square_);  // of the nearest point
    for (std::uint32_t i = 0; i < 3; ++i) {
      const D n = f[i] + t * D(direction_[i]);
      distance2 = distance2 + n * n;
      size = size + lane_abs<D>(n);
    }
    const D inside = radius * radius - distance2;  // half the chord, squared
    // A ray that leaves a ball, as sphere_roots() sees it: in its own bits, both roots are negative.
    const Mask<D> leaving = from_center2 - radius * radius > D(0) && along < D(0);
    const Mask<D> missed = inside < -(slack * (D(2) * (size + radius) + slack));
    // Both ends of a chord that is not short, t -+ half, in units of length along the ray: squares tell as much.
    const Mask<D> clear = inside > D(clear_);
    const D half2 = inside * D(inverse_square_);
    const D before = D(-doubt_) - t, after = t - D(limit * kDepthSlack + doubt_);
    const Mask<D> behind = before > D(0) && half2 < before * before;
    const Mask<D> beyond = after > D(0) && half2 < after * after;
    // The near end is at a positive depth, the middle before the limit.
    const D ahead = t - D(doubt_);
    const Mask<D> met =
        clear && ahead > D(0) && half2 < ahead * ahead && t < D(limit * (2 - kDepthSlack) - doubt_);
    return {mask_bits<D>(!(leaving || missed || (clear && (behind || beyond)))), mask_bits<D>(met)};
  }

  std::array<double, 3> origin_, direction_;
  double reach_, inverse_square_, doubt_;
  double clear_;  // half a chord, squared, whose ends are told apart; infinite where its square might be lost
};

}  // namespace sidelight::raytrace
