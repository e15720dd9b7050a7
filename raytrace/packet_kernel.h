// SPDX-License-Identifier: MIT
// A packet (packets.h) against the hierarchies, for lane types F of floats (rays, groups, boxes) and D of doubles (the
// set-up of a leaf's triangles side by side). Included by the kernels only (kernels_in_lanes.h).
#pragma once

#include "raytrace/packet_walk.h"

namespace sidelight::raytrace {

// A plane is a triangle without edges.
template <class F>
void test_plane(const Prepared& prepared, RayPacket& p, std::uint32_t primitive, VisibilityCounts& counts) {
  if (casts_none(prepared, p, primitive)) return;
  const Plane& plane = prepared.scene.planes[primitive_ref(prepared.scene, primitive).index];
  const auto along = [n = wide<double>(plane.normal)](const glm::dvec3& d) {
    return dot(n, wide<double>(d));
  };
  const double h = along(plane.point - p.origin), size_h = lane_abs(h);
  const bool sure = size_h > 0x1p-17 * p.distance && size_h > 0x1p-20 * p.reach;
  const double per_h = sure ? 1 / h : 0;
  const double x = per_h * along(p.U), y = per_h * along(p.V), c = per_h * along(p.W);
  const double error =
      0x1p-21 *
          ((lane_abs(x) * static_cast<double>(p.extent_u) + lane_abs(y) * static_cast<double>(p.extent_v)) +
           lane_abs(c)) +
      p.place_error * (lane_abs(x) + lane_abs(y)) + 0x1p-46 * p.length * lane_abs(per_h);
  TriangleSetup s{};
  for (std::size_t k = 0; k < 3; ++k) {
    s.x[k][0] = s.y[k][0] = 0;
    s.c[k][0] = 1;
  }
  s.doubt[0] = sure ? 0.5f : 2.0f;
  s.wx[0] = static_cast<float>(x);
  s.wy[0] = static_cast<float>(y);
  s.wc[0] = static_cast<float>(c);
  s.w_error[0] = sure ? static_cast<float>(error) : kInfinity;
  s.low_u.fill(kInfinity);
  s.low_u[0] = s.low_v[0] = -kFarPlace;
  s.high_u[0] = s.high_v[0] = kFarPlace;
  test_triangles<F>(p, s, all_groups(p), {&primitive}, counts);
}

template <class D>
void find_squares(RayPacket& p) {
  const Vec3<D> W = wide<D>(p.W), U = wide<D>(p.U), V = wide<D>(p.V);
  const D per_square(1 / (p.length * p.length));
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.groups) * RayPacket::kGroup; i += kLanes<D>) {
    const Vec3<D> d = (W + to_double<D>(load<FloatBeside<D>>(&p.u[i])) * U) +
                      to_double<D>(load<FloatBeside<D>>(&p.v[i])) * V;
    store(to_float<D>(per_square * dot(d, d)), &p.square[i]);
  }
}

template <class F, class B, class D>
[[gnu::flatten]] void trace_packet_in_lanes(const Prepared& prepared, RayPacket& p,
                                            VisibilityCounts& counts) {
  if (p.groups == 0) return;
  const PacketAxes axes = packet_axes(p);
  for (const std::uint32_t plane : prepared.planes) test_plane<F>(prepared, p, plane, counts);
  walk_packet<F, B, D>(prepared, axes, prepared.triangles, p, counts);
  if (prepared.spheres.bvh.nodes.empty()) return;
  find_squares<D>(p);
  walk_packet<F, B, D>(prepared, axes, prepared.spheres, p, counts);
}

}  // namespace sidelight::raytrace
