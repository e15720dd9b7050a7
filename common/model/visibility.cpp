// SPDX-License-Identifier: MIT
#include "common/model/visibility.h"

#include <algorithm>
#include <cmath>

#include "common/math/norms.h"
#include "common/math/vec.h"
#include "common/model/exact.h"

namespace sidelight {
namespace {

constexpr double kU = 0x1p-53;  // unit roundoff

// |a_j||b_k| + |a_k||b_j| for each component i.
glm::dvec3 permanent(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 p = absolute(a), q = absolute(b);
  return {p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
}

// Bound on the rounding of x . fl(a x b), relative to sum |x_i| permanent_i: each product 1 u, their difference 1 u,
// times x_i 1 u, the two sums 2 u; 6 instead of 5 pays for the second-order terms and for the bound's own rounding.
constexpr double kDotCrossBound = 6 * kU;

// The sign of x . (b x c), given edge = fl(b x c) and its permanent.
int dot_cross_sign(const glm::dvec3& x, const glm::dvec3& edge, const glm::dvec3& weight, const glm::dvec3& b,
                   const glm::dvec3& c, VisibilityCounts& counts) {
  const double value = glm::dot(x, edge);
  const double bound = kDotCrossBound * glm::dot(absolute(x), weight);
  if (std::abs(value) > bound) {
    ++counts.in_double;
    return value > 0 ? 1 : -1;
  }
  if (!std::isfinite(bound)) return 0;  // a ray that is not finite lies on no side of anything
  ++counts.exact;
  return exact::determinant_sign(x, b, c);
}

const glm::dvec3& next(const std::array<glm::dvec3, 3>& a, int k) {
  return a[static_cast<std::size_t>((k + 1) % 3)];
}
const glm::dvec3& after_next(const std::array<glm::dvec3, 3>& a, int k) {
  return a[static_cast<std::size_t>((k + 2) % 3)];
}

Hit first_after(const Hit& after, const Hit& candidate) {
  return std::isfinite(candidate.t) && before(after, candidate) ? candidate : Hit{};
}

Hit intersect_sphere(const Sphere& sphere, std::uint32_t primitive, const Ray& ray, const Hit& after) {
  const Roots roots = sphere_roots(sphere, ray);
  const Hit near = first_after(after, {roots.low, primitive});
  return near.found() ? near : first_after(after, {roots.high, primitive});
}

Hit intersect_plane(const Plane& plane, std::uint32_t primitive, const Ray& ray, const Hit& after) {
  const double along = glm::dot(plane.normal, ray.direction);
  if (along == 0) return {};
  return first_after(after, {glm::dot(plane.normal, plane.point - ray.origin) / along, primitive});
}

Hit intersect_triangle(const Scene& scene, const Triangle& triangle, std::uint32_t primitive, const Ray& ray,
                       const Hit& after, VisibilityCounts& counts) {
  if (triangle.degenerate) return {};
  const auto [v0, v1, v2] = corners(scene, triangle);
  const TriangleView view = view_triangle(ray.origin, v0, v1, v2);
  const int agreement = edge_agreement(view, ray.direction, counts);
  if (agreement == 0 || agreement != view_side(view, counts)) return {};
  const DepthPlane plane = depth_plane(view, v0, v1, v2);
  return first_after(after, {triangle_depth(view, plane, ray.direction), primitive});
}

}  // namespace

Ray make_ray(const glm::dvec3& origin, const glm::dvec3& direction) {
  Ray ray{origin, direction};
  for (int i = 0; i < 3; ++i)
    if (std::abs(ray.direction[i]) < 1e-100) ray.direction[i] = 0;
  return ray;
}

TriangleView view_triangle(const glm::dvec3& origin, const glm::dvec3& v0, const glm::dvec3& v1,
                           const glm::dvec3& v2) {
  TriangleView view;
  view.a = {v0 - origin, v1 - origin, v2 - origin};
  // Both products of a component are rounded before they are subtracted, so edge(a, b) = -edge(b, a) in every bit:
  // neighbours see their common edge alike. (-ffp-contract=off is needed for this.)
  for (int k = 0; k < 3; ++k) {
    view.edge[static_cast<std::size_t>(k)] = glm::cross(next(view.a, k), after_next(view.a, k));
    view.weight[static_cast<std::size_t>(k)] = permanent(next(view.a, k), after_next(view.a, k));
  }
  return view;
}

int view_side(const TriangleView& view, VisibilityCounts& counts) {
  return dot_cross_sign(view.a[0], view.edge[0], view.weight[0], view.a[1], view.a[2], counts);
}

int edge_agreement(const TriangleView& view, const glm::dvec3& direction, VisibilityCounts& counts) {
  int agreed = 0;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const int sign = dot_cross_sign(direction, view.edge[i], view.weight[i], next(view.a, k),
                                    after_next(view.a, k), counts);
    if (sign * agreed < 0) return 0;
    if (sign != 0) agreed = sign;
  }
  return agreed;
}

std::array<double, 3> edge_values(const TriangleView& view, const glm::dvec3& direction) {
  std::array<double, 3> e{};
  double bound = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = fused_dot(wide<double>(direction), wide<double>(view.edge[k]));
    bound += glm::dot(absolute(direction), view.weight[k]);
  }
  const double sum = e[0] + e[1] + e[2];
  if (kDotCrossBound * bound <= 0x1p-20 * std::abs(sum)) {
    // The exact values of a hit share one sign: one that rounding gave the other is as good as 0, and on an edge.
    for (double& each : e)
      if ((each < 0) != (sum < 0)) each = 0;
    return e;
  }
  for (int k = 0; k < 3; ++k)
    e[static_cast<std::size_t>(k)] =
        exact::rounded(exact::determinant(direction, next(view.a, k), after_next(view.a, k)));
  return e;
}

// Derivation of the weight. Exact for the rounded a_k: n* = (a1 - a0) x (a2 - a0). The edge e1 = fl(v1 - v0) is off
// a1 - a0 by at most u w1, w1 = |e1| + |a0| + |a1| per component, and e2 likewise by u w2. A component of n, a
// difference of two products, is then off by at most
//   u (w1_j |e2_k| + |e1_j| w2_k + w1_k |e2_j| + |e1_k| w2_j) + 2 u (|e1_j e2_k| + |e1_k e2_j|)  <=  2 u m_i,
// m_i the first bracket (w >= |e|), and x . n by at most 2 u + 3 u / 2 < 4 u times sum |x_i| m_i.
DepthPlane depth_plane(const TriangleView& view, const glm::dvec3& v0, const glm::dvec3& v1,
                       const glm::dvec3& v2) {
  const glm::dvec3 e1 = v1 - v0, e2 = v2 - v0;
  const glm::dvec3 w1 = absolute(e1) + absolute(view.a[0]) + absolute(view.a[1]);
  const glm::dvec3 w2 = absolute(e2) + absolute(view.a[0]) + absolute(view.a[2]);
  DepthPlane plane;
  plane.n = glm::cross(e1, e2);
  plane.weight = permanent(w1, e2) + permanent(e1, w2);
  plane.a0_n = glm::dot(view.a[0], plane.n);
  // 4 u sum <= 2^-20 |x . n|
  plane.sure = glm::dot(absolute(view.a[0]), plane.weight) <= 0x1p31 * std::abs(plane.a0_n);
  return plane;
}

double triangle_depth(const TriangleView& view, const DepthPlane& plane, const glm::dvec3& direction) {
  const double d_n = glm::dot(direction, plane.n);
  const bool sure = plane.sure && glm::dot(absolute(direction), plane.weight) <= 0x1p31 * std::abs(d_n);
  const double t = plane.a0_n / d_n;
  if (sure && t > 0) return t;
  const auto& [a0, a1, a2] = view.a;
  return exact::rounded_quotient(exact::determinant(a0, a1, a2), exact::determinant(direction, a1, a2),
                                 exact::determinant(direction, a2, a0),
                                 exact::determinant(direction, a0, a1));
}

// E. Haines, J. Guenther, T. Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
// 2019, chapter 7: the discriminant from the distance of line and centre, the roots without cancellation.
Roots sphere_roots(const Sphere& sphere, const Ray& ray) {
  const glm::dvec3 f = ray.origin - sphere.center;
  const double dd = glm::dot(ray.direction, ray.direction);
  const double b = -glm::dot(f, ray.direction);
  const glm::dvec3 nearest = f + (b / dd) * ray.direction;
  const double r2 = sphere.radius * sphere.radius;
  const double discriminant = r2 - glm::dot(nearest, nearest);
  if (!(discriminant >= 0)) return {};
  const double q = b + std::copysign(std::sqrt(dd * discriminant), b);
  if (q == 0) return {0, 0};  // touching at the origin
  const double t0 = (glm::dot(f, f) - r2) / q;
  const double t1 = q / dd;
  return t0 <= t1 ? Roots{t0, t1} : Roots{t1, t0};
}

Hit intersect(const Scene& scene, std::uint32_t primitive, const Ray& ray, const Hit& after,
              VisibilityCounts& counts) {
  ++counts.tests;
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  switch (ref.kind) {
    case ObjectKind::sphere:
      return intersect_sphere(scene.spheres[ref.index], primitive, ray, after);
    case ObjectKind::plane:
      return intersect_plane(scene.planes[ref.index], primitive, ray, after);
    case ObjectKind::mesh:
      break;
  }
  return intersect_triangle(scene, scene.triangles[ref.index], primitive, ray, after, counts);
}

// Nearly always no bound on the weight of each component is needed to see that depth_plane() and triangle_depth() are
// sure: m_i <= 4 w e, with w and e at least the components of w1, w2 and of e1, e2 (depth_plane above); 8 pays for the
// rounding of either bound.
Hit met_triangle(const glm::dvec3& v0, const glm::dvec3& v1, const glm::dvec3& v2, std::uint32_t primitive,
                 const Ray& ray, const Hit& after) {
  const glm::dvec3 a0 = v0 - ray.origin, a1 = v1 - ray.origin, a2 = v2 - ray.origin, e1 = v1 - v0,
                   e2 = v2 - v0;
  const glm::dvec3 n = glm::cross(e1, e2), edges = absolute(e1) + absolute(e2);
  const glm::dvec3 ends = absolute(a0) + absolute(a1) + absolute(a2);
  const double a0_n = glm::dot(a0, n), d_n = glm::dot(ray.direction, n), t = a0_n / d_n;
  const double e = edges.x + edges.y + edges.z, w = ends.x + ends.y + ends.z + e;
  const glm::dvec3 d = absolute(ray.direction);
  if (8 * w * e * w <= 0x1p31 * std::abs(a0_n) && 8 * w * e * (d.x + d.y + d.z) <= 0x1p31 * std::abs(d_n) &&
      t > 0)
    return first_after(after, {t, primitive});
  const TriangleView view = view_triangle(ray.origin, v0, v1, v2);
  return first_after(after, {triangle_depth(view, depth_plane(view, v0, v1, v2), ray.direction), primitive});
}

bool plane_behind(const glm::dvec3& v0, const glm::dvec3& v1, const glm::dvec3& v2, const Ray& ray) {
  TriangleView view;
  view.a = {v0 - ray.origin, v1 - ray.origin, v2 - ray.origin};
  const DepthPlane plane = depth_plane(view, v0, v1, v2);
  const double d_n = glm::dot(ray.direction, plane.n);
  const double a0_doubt = 4 * kU * glm::dot(absolute(view.a[0]), plane.weight);
  const double d_doubt = 4 * kU * glm::dot(absolute(ray.direction), plane.weight);
  return plane.a0_n > a0_doubt ? d_n < -d_doubt : plane.a0_n < -a0_doubt && d_n > d_doubt;
}

Hit nearest_of_all(const Scene& scene, const Ray& ray, const Hit& after, VisibilityCounts& counts) {
  Hit nearest;
  for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive) {
    const Hit hit = intersect(scene, primitive, ray, after, counts);
    if (hit.found() && before(hit, nearest)) nearest = hit;
  }
  return nearest;
}

int side_of(const Scene& scene, std::uint32_t primitive, const glm::dvec3& point, VisibilityCounts& counts) {
  const auto sign = [](double x) { return (x > 0) - (x < 0); };
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  switch (ref.kind) {
    case ObjectKind::sphere: {
      const Sphere& sphere = scene.spheres[ref.index];
      const glm::dvec3 f = point - sphere.center;
      return sign(glm::dot(f, f) - sphere.radius * sphere.radius);
    }
    case ObjectKind::plane: {
      const Plane& plane = scene.planes[ref.index];
      return -sign(glm::dot(plane.normal, plane.point - point));
    }
    case ObjectKind::mesh:
      break;
  }
  const auto [v0, v1, v2] = corners(scene, scene.triangles[ref.index]);
  return -view_side(view_triangle(point, v0, v1, v2), counts);
}

bool before_light(const Scene& scene, const Hit& hit, const Ray& ray, const glm::dvec3& light,
                  VisibilityCounts& counts) {
  // Depth is good to 2^-18 at worst (triangle_depth): outside this margin it decides.
  constexpr double kMargin = 0x1p-16;
  if (hit.t < 1 - kMargin) return true;
  if (hit.t > 1 + kMargin) return false;

  const PrimitiveRef ref = primitive_ref(scene, hit.primitive);
  if (ref.kind == ObjectKind::mesh) {
    // In between iff the two ends lie strictly on opposite sides.
    return side_of(scene, hit.primitive, light, counts) * side_of(scene, hit.primitive, ray.origin, counts) <
           0;
  }
  // A light that touches the plane or sphere, as far as rounding lets one tell, is not behind that point of it.
  if (ref.kind == ObjectKind::plane) {
    const Plane& plane = scene.planes[ref.index];
    const double height = glm::dot(plane.normal, light - plane.point);
    const double bound = 4 * kU * glm::dot(absolute(plane.normal), absolute(plane.point) + absolute(light));
    return std::abs(height) > bound && hit.t < 1;
  }
  const Sphere& sphere = scene.spheres[ref.index];
  const glm::dvec3 f = light - sphere.center;
  const double r2 = sphere.radius * sphere.radius;
  const double height = glm::dot(f, f) - r2;
  const double bound = 8 * kU * (r2 + glm::dot(absolute(f), absolute(light) + absolute(sphere.center)));
  if (std::abs(height) > bound) return hit.t < 1;
  // The light ends a chord, whose middle is at t = 1 - f.d/d.d: the hit is its other end if it lies before that.
  const double half_chord = glm::dot(f, ray.direction) / glm::dot(ray.direction, ray.direction);
  return half_chord > 0 && hit.t < 1 - half_chord;
}

}  // namespace sidelight
