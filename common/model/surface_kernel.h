// SPDX-License-Identifier: MIT
// surface_at() and shading_point() over lanes of double: the same operations in the same order, so the same bits. Included
// only by kernels_scalar.cpp, kernels_avx2.cpp and kernels_avx512.cpp, each compiled for its instruction set; the lane
// type in every name keeps them apart.
//
// Where visibility.h bounds a rounding by a permanent, component by component, the bound here is by lengths (Cauchy and
// Schwarz), which is greater and cheaper. A lane that fails it is marked, and asked again by surface_at().
#pragma once

#include "common/model/surface_triangles.h"

namespace sidelight {

// ---- Spheres ----

template <class F>
F sphere_clearance(const Vec3<F>& outward, const Vec3<F>& center, const F& radius) {
  return F(16 * 0x1p-53) * (dot(absolute(outward), absolute(center)) + radius);
}

// sphere_roots() and locate_sphere(). What is not a plain hit is doubtful.
template <class F>
void sphere_surfaces(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out, std::size_t i) {
  SurfaceLanes<F> lanes(batch, i);
  const Vec3<F> d = lanes.direction(view);
  const auto& spheres = view.scene.spheres;
  const Vec3<F> center = lanes.scene_vector([&](auto s) -> const auto& { return spheres[s].center; });
  const F radius = lanes.scene_number([&](auto s) { return spheres[s].radius; }), r2 = radius * radius;
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
    lanes.put_leaving(point, facing, sphere_clearance(outward, center, radius));
    lanes.put_normal(facing);
    store_rows(to_floats(facing), out.facing, i);
  }
  put_point(view, point, facing, d, out, i);
}

// ---- Planes ----

template <class F>
F plane_clearance(const Vec3<F>& normal, const Vec3<F>& on_plane, const Vec3<F>& p) {
  return F(0x1p-53) * dot(absolute(normal), F(10) * absolute(p - on_plane) + F(3) * absolute(p));
}

// intersect() of a plane and locate_plane().
template <class F>
void plane_surfaces(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out, std::size_t i) {
  SurfaceLanes<F> lanes(batch, i);
  const Vec3<F> d = lanes.direction(view);
  const auto& planes = view.scene.planes;
  const Vec3<F> on_plane = lanes.scene_vector([&](auto p) -> const auto& { return planes[p].point; });
  const Vec3<F> outward = lanes.scene_vector([&](auto p) -> const auto& { return planes[p].normal; });
  const Vec3<F> origin = lanes.origin(view);
  const F along = dot(outward, d);
  const F t = batch.has_t ? lanes.given_t() : dot(outward, on_plane - origin) / along;
  const Vec3<F> p = origin + t * d;
  const Vec3<F> point = p - dot(outward, p - on_plane) * outward;
  lanes.put_t(t);
  lanes.put_doubt(t > F(0));
  const Vec3<F> facing = select<F>(along < F(0), outward, -outward);
  if (lanes.wants_leaving()) {
    lanes.put_leaving(point, facing, plane_clearance(outward, on_plane, p));
    lanes.put_normal(facing);
    store_rows(to_floats(facing), out.facing, i);
  }
  put_point(view, point, facing, d, out, i);
}

template <class F>
[[gnu::flatten]] void surfaces_of_batch(const SurfaceView& view, SurfaceBatch& batch, ShadingBatch& out) {
  const auto for_each_vector = [&](const auto& find) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); i += kLanes<F>)
      find(view, batch, out, i);
  };
  if (batch.kind == ObjectKind::mesh)
    TriangleSurfaces<F>(view, batch, out).find_all();
  else if (batch.kind == ObjectKind::sphere)
    for_each_vector(sphere_surfaces<F>);
  else
    for_each_vector(plane_surfaces<F>);
  if (batch.kind != ObjectKind::mesh) make_unit<FloatLanes<F>>(out.normal, 1, batch);
  if (batch.shiny) make_unit<FloatLanes<F>>(out.to_viewer, -1, batch);
}

}  // namespace sidelight
