// SPDX-License-Identifier: MIT
// surface_at() and shading_point() over lanes of double: the same operations in the same order, so the same bits. Included
// only by surface_scalar.cpp, surface_avx2.cpp and surface_avx512.cpp, each compiled for its instruction set; the lane
// type in every name keeps them apart.
//
// Where visibility.h bounds a rounding by a permanent, component by component, the bound here is by lengths (Cauchy and
// Schwarz), which is greater and cheaper. A lane that fails it is marked, and asked again by surface_at().
#pragma once

#include "common/math/lane_ops.h"
#include "common/math/vec.h"
#include "common/model/surface_batch.h"

namespace sidelight {

struct SurfaceView {
  Vec3<double> eye, right, up, axis;  // of the camera
  double length_scale = 1;            // of the shading tables
};

template <class F>
Vec3<F> wide(const Vec3<double>& v) {
  return {F(v.x), F(v.y), F(v.z)};
}
template <class F>
F size(const Vec3<F>& v) {
  return (lane_abs(v.x) + lane_abs(v.y)) + lane_abs(v.z);
}
template <class F>
Vec3<F> absolute(const Vec3<F>& v) {
  return {lane_abs(v.x), lane_abs(v.y), lane_abs(v.z)};
}
// As glm::normalize: by the reciprocal of the length.
template <class F>
Vec3<F> normalized(const Vec3<F>& v) {
  return (F(1) / square_root(dot(v, v))) * v;
}

// ---- From and to the batches ----

template <class F>
class SurfaceLanes {
 public:
  SurfaceLanes(SurfaceBatch& batch, std::size_t first)
      : batch_(batch), first_(first), group_(first / SurfaceBatch::kGroup * SurfaceBatch::kGroup) {}

  const SurfaceBatch::Group& group() const { return batch_.group[first_ / SurfaceBatch::kGroup]; }
  F scene_number(std::size_t vector, std::size_t component) const {
    const auto& channel = batch_.vector[vector][component];
    return group().one ? F(channel[group_]) : load<F>(&channel[first_]);
  }
  Vec3<F> scene_vector(std::size_t i) const {
    return {scene_number(i, 0), scene_number(i, 1), scene_number(i, 2)};
  }
  Vec3<F> origin(const SurfaceView& view) const {
    return batch_.own_rays ? own(batch_.origin) : wide<F>(view.eye);
  }
  Vec3<F> direction(const SurfaceView& view) const {
    if (batch_.own_rays) return own(batch_.direction);
    const F column = load<F>(&batch_.column[first_]), row = load<F>(&batch_.row[first_]);
    return (column * wide<F>(view.right) + row * wide<F>(view.up)) + wide<F>(view.axis);
  }
  F given_t() const { return load<F>(&batch_.t[first_]); }
  void put_t(const F& t) { store(t, &batch_.t[first_]); }
  bool wants_leaving() const { return batch_.want_leaving; }
  void put_leaving(const Vec3<F>& point, const Vec3<F>& facing, const Vec3<F>& normal, const F& clearance) {
    put(point, batch_.point);
    put(facing, batch_.facing);
    put(normal, batch_.normal);
    store(clearance, &batch_.clearance[first_]);
  }
  void put_doubt(const Mask<F>& sure) {
    store(select<F>(sure, F(0), F(1)), &batch_.doubtful[first_]);
    if constexpr (kLanes<F> == 1)
      batch_.any_doubtful |= !sure;
    else
      batch_.any_doubtful |= !stdx::all_of(sure);
  }

 private:
  Vec3<F> own(const SurfaceBatch::Vectors& from) const {
    return {load<F>(&from[0][first_]), load<F>(&from[1][first_]), load<F>(&from[2][first_])};
  }
  void put(const Vec3<F>& v, SurfaceBatch::Vectors& to) {
    store(v.x, &to[0][first_]);
    store(v.y, &to[1][first_]);
    store(v.z, &to[2][first_]);
  }

  SurfaceBatch& batch_;
  std::size_t first_, group_;
};

template <class F>
void put_rounded(const Vec3<F>& v, ShadingBatch::Rgb& to, std::size_t i) {
  store(to_float(v.x), &to[0][i]);
  store(to_float(v.y), &to[1][i]);
  store(to_float(v.z), &to[2][i]);
}

// shading_point()
template <class F>
void put_point(const SurfaceView& view, const Vec3<F>& point, const Vec3<F>& normal, const Vec3<F>& direction,
               bool shiny, ShadingBatch& out, std::size_t i) {
  const Vec3<F> scaled = F(view.length_scale) * point;
  const auto above = [](const F& x) { return x - to_double<F>(to_float(x)); };
  put_rounded(scaled, out.high, i);
  put_rounded(Vec3<F>{above(scaled.x), above(scaled.y), above(scaled.z)}, out.low, i);
  put_rounded(normal, out.normal, i);
  if (shiny) put_rounded(-normalized(direction), out.to_viewer, i);
}

// ---- Triangles ----

// A triangle seen from the eye: visibility.h's TriangleView and DepthPlane, place.cpp's outward normal.
template <class F>
struct TriangleLanes {
  Vec3<F> v0, e1, e2;
  std::array<Vec3<F>, 3> edge, normal;
  Vec3<F> facing;  // Nv; not of unit length unless a triangle of the group is flat, or rays leave
  F clearance;     // if rays leave
  F facing_size;   // |x| + |y| + |z| of it
  F lengths2;      // |a_0|² + |a_1|² + |a_2|²
  Vec3<F> n;
  F a0_n, depth_bound;  // lengths2 (|e1|² + |e2|²)
  Mask<F> sure, sure_depth;
};

// place.cpp's clearance_of() by kind.
template <class F>
F triangle_clearance(const Vec3<F>& outward, const Vec3<F>& v0, const Vec3<F>& v1, const Vec3<F>& v2) {
  const auto reach = [](const F& a, const F& b, const F& c) {
    return lane_max(lane_max(lane_abs(a), lane_abs(b)), lane_abs(c));
  };
  return F(16 * 0x1p-53) * dot(absolute(outward), Vec3<F>{reach(v0.x, v1.x, v2.x), reach(v0.y, v1.y, v2.y),
                                                          reach(v0.z, v1.z, v2.z)});
}
template <class F>
F sphere_clearance(const Vec3<F>& outward, const Vec3<F>& center, const F& radius) {
  return F(16 * 0x1p-53) * (dot(absolute(outward), absolute(center)) + radius);
}
template <class F>
F plane_clearance(const Vec3<F>& normal, const Vec3<F>& on_plane, const Vec3<F>& p) {
  return F(0x1p-53) * dot(absolute(normal), F(10) * absolute(p - on_plane) + F(3) * absolute(p));
}

// Bounds, by |p_j q_k| + |p_k q_j| <= |p| |q|, with room for their own rounding:
//   side: 6 u |a0| . weight <= 6 u sqrt(3) |a0| |a1| |a2|; squared, 2^-99.2 times the product of the squares.
//   depth: w1 <= |e1| + |a0| + |a1| <= 2 (|a0| + |a1|), so weight <= 4 sqrt(S T) with S = |a0|² + |a1|² + |a2|²,
//   T = |e1|² + |e2|²; |a0| . weight <= sqrt(3 S) 4 sqrt(S T) <= 2^31 |a0 . n| iff S² T <= 2^56.4 (a0 . n)².
template <class F>
TriangleLanes<F> triangle_lanes(const SurfaceLanes<F>& lanes, const Vec3<F>& origin, bool want_t) {
  TriangleLanes<F> out;
  const Vec3<F> v1 = lanes.scene_vector(1), v2 = lanes.scene_vector(2);
  out.v0 = lanes.scene_vector(0);
  out.e1 = v1 - out.v0;
  out.e2 = v2 - out.v0;
  const Vec3<F> a0 = out.v0 - origin, a1 = v1 - origin, a2 = v2 - origin;
  out.edge = {cross(a1, a2), cross(a2, a0), cross(a0, a1)};

  const F s0 = dot(a0, a0), s1 = dot(a1, a1), s2 = dot(a2, a2);
  out.lengths2 = (s0 + s1) + s2;
  const F side = dot(a0, out.edge[0]);
  out.sure = side * side > F(0x1p-99) * ((s0 * s1) * s2);

  out.n = cross(out.e1, out.e2);
  Vec3<F> outward = out.n;
  if (lanes.group().flat || lanes.wants_leaving()) {
    const F most = lane_max(lane_max(lane_abs(out.n.x), lane_abs(out.n.y)), lane_abs(out.n.z));
    outward = normalized(Vec3<F>{out.n.x / most, out.n.y / most, out.n.z / most});
  }
  out.facing = select<F>(side < F(0), outward, -outward);
  out.facing_size = size(out.facing);
  if (lanes.wants_leaving()) out.clearance = triangle_clearance(outward, out.v0, v1, v2);
  if (lanes.group().smooth)
    out.normal = {lanes.scene_vector(3), lanes.scene_vector(4), lanes.scene_vector(5)};

  if (want_t) {
    out.a0_n = dot(a0, out.n);
    out.depth_bound = out.lengths2 * (dot(out.e1, out.e1) + dot(out.e2, out.e2));
    out.sure_depth = out.depth_bound * out.lengths2 <= F(0x1p56) * (out.a0_n * out.a0_n);
  }
  return out;
}

// N and whether it is sure. With vertex normals of zero, Nv. Of the sign of smooth . facing that of smooth . n is told
// where rounding cannot reach it: each is off by less than 8 u |smooth| |n|.
template <class F>
Vec3<F> triangle_normal(const TriangleLanes<F>& triangle, const std::array<F, 3>& barycentric,
                        const SurfaceBatch::Group& group, Mask<F>& sure) {
  if (!group.smooth) return triangle.facing;
  Vec3<F> smooth{F(0), F(0), F(0)};
  for (std::size_t k = 0; k < 3; ++k) smooth = smooth + barycentric[k] * triangle.normal[k];
  const F side = dot(smooth, triangle.facing), size_of_smooth = size(smooth);
  const Mask<F> none = size_of_smooth == F(0);
  const Mask<F> sure_side = lane_abs(side) > F(0x1p-48) * (size_of_smooth * triangle.facing_size);
  const Vec3<F> turned = select<F>(side < F(0), -smooth, smooth);
  if (!group.flat) {
    sure = sure && sure_side;
    return normalized(turned);
  }
  sure = sure && (sure_side || none);
  const Vec3<F> unit_or_x = select<F>(none, Vec3<F>{F(1), F(0), F(0)}, turned);
  return select<F>(none, triangle.facing, normalized(unit_or_x));
}

// d . weight <= |d| sum |a_i| |a_j| <= |d| S, and 6 u of it may be 2^-20 |sum|.
// Depth: |d| 4 sqrt(S T) <= 2^31 |d . n| iff |d|² S T <= 2^58 (d . n)²; 2^57 for the rounding of the bound.
template <class F>
void triangle_surfaces(const SurfaceView& view, const TriangleLanes<F>& triangle, SurfaceBatch& batch,
                       ShadingBatch& out, std::size_t i) {
  SurfaceLanes<F> lanes(batch, i);
  const Vec3<F> d = lanes.direction(view);
  std::array<F, 3> e{dot(d, triangle.edge[0]), dot(d, triangle.edge[1]), dot(d, triangle.edge[2])};
  const F all = (e[0] + e[1]) + e[2], size_of_d = size(d);
  Mask<F> sure = triangle.sure && size_of_d * triangle.lengths2 <= F(0x1p30) * lane_abs(all);
  const Mask<F> negative = all < F(0);
  for (F& each : e) each = select<F>((each < F(0)) != negative, F(0), each);
  const F sum = (e[0] + e[1]) + e[2];
  const F first = lanes.group().smooth ? e[0] / sum : F(0);  // only the normal asks for it
  const std::array<F, 3> barycentric{first, e[1] / sum, e[2] / sum};

  const Vec3<F> point = (triangle.v0 + barycentric[1] * triangle.e1) + barycentric[2] * triangle.e2;
  const Vec3<F> normal = triangle_normal(triangle, barycentric, lanes.group(), sure);
  if (batch.want_t && !batch.has_t) {
    const F d_n = dot(d, triangle.n);
    const F t = triangle.a0_n / d_n;
    sure = sure && triangle.sure_depth && t > F(0) &&
           (size_of_d * size_of_d) * triangle.depth_bound <= F(0x1p57) * (d_n * d_n);
    lanes.put_t(t);
  }
  lanes.put_doubt(sure);
  if (lanes.wants_leaving()) {
    lanes.put_leaving(point, triangle.facing, normal, triangle.clearance);
    put_rounded(triangle.facing, out.facing, i);
  }
  put_point(view, point, normal, d, lanes.group().shiny, out, i);
}

template <class F>
void surfaces_of_triangles(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out) {
  TriangleLanes<F> triangle;
  std::uint32_t last = kNone;  // the one triangle that it is set up for
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); i += kLanes<F>) {
    const SurfaceLanes<F> lanes(batch, i);
    const std::uint32_t one = lanes.group().one && !batch.own_rays ? batch.primitive[i] : kNone;
    if (one == kNone || one != last)
      triangle = triangle_lanes(lanes, lanes.origin(view), batch.want_t && !batch.has_t);
    last = one;
    triangle_surfaces(view, triangle, batch, out, i);
  }
}

// ---- Spheres ----

// sphere_roots() and locate_sphere(). What is not a plain hit is doubtful.
template <class F>
void sphere_surfaces(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out, std::size_t i) {
  SurfaceLanes<F> lanes(batch, i);
  const Vec3<F> d = lanes.direction(view), center = lanes.scene_vector(0);
  const F radius = lanes.scene_number(1, 0), r2 = radius * radius;
  const Vec3<F> f = lanes.origin(view) - center;
  const F dd = dot(d, d), b = -dot(f, d);
  const Vec3<F> nearest = f + (b / dd) * d;
  const F discriminant = r2 - dot(nearest, nearest);
  const Mask<F> meets = discriminant >= F(0);
  const F root = square_root(dd * select<F>(meets, discriminant, F(0)));
  const F q = b + select<F>(b < F(0), -root, root);
  const Mask<F> apart =
      q != F(0);  // also where b is 0 of any sign, but for its own sign: then it is doubtful
  const F t0 = (dot(f, f) - r2) / select<F>(apart, q, F(1));
  const F t1 = q / dd;
  const F low = select<F>(t0 <= t1, t0, t1), high = select<F>(t0 <= t1, t1, t0);

  const F t = batch.has_t ? lanes.given_t() : select<F>(low > F(0), low, high);
  const Vec3<F> at = f + t * d;
  const Vec3<F> outward = normalized(at);
  lanes.put_t(t);
  lanes.put_doubt(meets && apart && b != F(0) && t > F(0));
  const Vec3<F> facing = select<F>(t == low, outward, -outward);
  const Vec3<F> point = center + radius * outward;
  if (lanes.wants_leaving()) {
    lanes.put_leaving(point, facing, facing, sphere_clearance(outward, center, radius));
    put_rounded(facing, out.facing, i);
  }
  put_point(view, point, facing, d, lanes.group().shiny, out, i);
}

// ---- Planes ----

// intersect() of a plane and locate_plane().
template <class F>
void plane_surfaces(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out, std::size_t i) {
  SurfaceLanes<F> lanes(batch, i);
  const Vec3<F> d = lanes.direction(view), on_plane = lanes.scene_vector(0), outward = lanes.scene_vector(1);
  const Vec3<F> origin = lanes.origin(view);
  const F along = dot(outward, d);
  const F t = batch.has_t ? lanes.given_t() : dot(outward, on_plane - origin) / along;
  const Vec3<F> p = origin + t * d;
  const Vec3<F> point = p - dot(outward, p - on_plane) * outward;
  lanes.put_t(t);
  lanes.put_doubt(t > F(0));
  const Vec3<F> facing = select<F>(along < F(0), outward, -outward);
  if (lanes.wants_leaving()) {
    lanes.put_leaving(point, facing, facing, plane_clearance(outward, on_plane, p));
    put_rounded(facing, out.facing, i);
  }
  put_point(view, point, facing, d, lanes.group().shiny, out, i);
}

template <class F>
void surfaces_of_batch(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out) {
  if (batch.kind == ObjectKind::mesh) return surfaces_of_triangles<F>(view, batch, out);
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); i += kLanes<F>) {
    if (batch.kind == ObjectKind::sphere)
      sphere_surfaces<F>(view, batch, out, i);
    else
      plane_surfaces<F>(view, batch, out, i);
  }
}

// One for each instruction set.
void surfaces_scalar(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out);
void surfaces_avx2(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out);
void surfaces_avx512(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out);

}  // namespace sidelight
