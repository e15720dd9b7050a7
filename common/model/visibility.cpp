// SPDX-License-Identifier: MIT
#include "common/model/visibility.h"

#include <algorithm>
#include <cmath>

#include "common/model/exact.h"

namespace sidelight {
namespace {

constexpr double kU = 0x1p-53;   // unit roundoff

glm::dvec3 absolute(const glm::dvec3& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }
double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

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
                   const glm::dvec3& c, SignCounts& counts) {
  const double value = glm::dot(x, edge);
  const double bound = kDotCrossBound * glm::dot(absolute(x), weight);
  if (std::abs(value) > bound) {
    ++counts.in_double;
    return value > 0 ? 1 : -1;
  }
  if (!std::isfinite(bound)) return 0;   // a ray that is not finite lies on no side of anything
  ++counts.exact;
  return exact::determinant_sign(x, b, c);
}

const glm::dvec3& next(const std::array<glm::dvec3, 3>& a, int k) { return a[static_cast<std::size_t>((k + 1) % 3)]; }
const glm::dvec3& after_next(const std::array<glm::dvec3, 3>& a, int k) {
  return a[static_cast<std::size_t>((k + 2) % 3)];
}

struct Corners {
  const glm::dvec3 &v0, &v1, &v2;
};

Corners corners(const Scene& scene, const Triangle& triangle) {
  return {scene.positions[triangle.vertex[0]], scene.positions[triangle.vertex[1]],
          scene.positions[triangle.vertex[2]]};
}

Hit first_after(const Hit& after, const Hit& candidate) {
  return std::isfinite(candidate.t) && before(after, candidate) ? candidate : Hit{};
}

// Both roots of |o + t d - c| = r in ascending order; empty (NaN) where the line misses.
// E. Haines, J. Guenther, T. Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
// 2019, chapter 7: the discriminant from the distance of line and centre, the roots without cancellation.
struct Roots {
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
};

Roots sphere_roots(const Sphere& sphere, const Ray& ray) {
  const glm::dvec3 f = ray.origin - sphere.center;
  const double dd = glm::dot(ray.direction, ray.direction);
  const double b = -glm::dot(f, ray.direction);
  const glm::dvec3 nearest = f + (b / dd) * ray.direction;
  const double r2 = sphere.radius * sphere.radius;
  const double discriminant = r2 - glm::dot(nearest, nearest);
  if (!(discriminant >= 0)) return {};
  const double q = b + std::copysign(std::sqrt(dd * discriminant), b);
  if (q == 0) return {0, 0};   // touching at the origin
  const double t0 = (glm::dot(f, f) - r2) / q;
  const double t1 = q / dd;
  return t0 <= t1 ? Roots{t0, t1} : Roots{t1, t0};
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
                       const Hit& after, SignCounts& counts) {
  if (triangle.degenerate) return {};
  const auto [v0, v1, v2] = corners(scene, triangle);
  const TriangleView view = view_triangle(ray.origin, v0, v1, v2);
  const int agreement = edge_agreement(view, ray.direction, counts);
  if (agreement == 0 || agreement != view_side(view, counts)) return {};
  const DepthPlane plane = depth_plane(view, v0, v1, v2);
  return first_after(after, {triangle_depth(view, plane, ray.direction), primitive});
}

double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double numerator = glm::dot(a, glm::cross(b, c));
  const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2 * std::atan2(numerator, denominator);
}

// ---- locate, by kind ----

Place locate_sphere(const Sphere& sphere, const Ray& ray, const Hit& hit) {
  Place place;
  const glm::dvec3 f = (ray.origin - sphere.center) + hit.t * ray.direction;
  place.outward = glm::normalize(f);
  place.point = sphere.center + sphere.radius * place.outward;
  place.entering = hit.t == sphere_roots(sphere, ray).low;
  // point: 3 u r + u |c + r n|; the next ray's f: u (|c| + r); its |f|² - r²: 4 u r. Along the normal, with room:
  place.clearance = 16 * kU * (glm::dot(absolute(place.outward), absolute(sphere.center)) + sphere.radius);
  return place;
}

Place locate_plane(const Plane& plane, const Ray& ray, const Hit& hit) {
  Place place;
  place.outward = plane.normal;
  const glm::dvec3 p = ray.origin + hit.t * ray.direction;
  place.point = p - glm::dot(plane.normal, p - plane.point) * plane.normal;
  place.entering = glm::dot(plane.normal, ray.direction) < 0;
  // With q = |p - P0|, per component seen along the normal: n . (p - P0) is off by 4 u q when the point is put on the
  // plane and when it is left again, the point by u |p| when it is put there and when it is moved off. With room:
  place.clearance = kU * glm::dot(absolute(plane.normal), 10.0 * absolute(p - plane.point) + 3.0 * absolute(p));
  return place;
}

// E_0, E_1, E_2 with the sign of the side and a relative error of their sum below 2^-20: in double, or exact and
// rounded once where a triangle is seen nearly edge-on.
std::array<double, 3> edge_values(const TriangleView& view, const glm::dvec3& direction) {
  std::array<double, 3> e{};
  double bound = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = glm::dot(direction, view.edge[k]);
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

Place locate_triangle(const Scene& scene, const Triangle& triangle, const Ray& ray, SignCounts& counts) {
  const auto [v0, v1, v2] = corners(scene, triangle);
  const TriangleView view = view_triangle(ray.origin, v0, v1, v2);
  const std::array<double, 3> e = edge_values(view, ray.direction);
  const double sum = e[0] + e[1] + e[2];

  Place place;
  place.barycentric = {e[0] / sum, e[1] / sum, e[2] / sum};
  const glm::dvec3 e1 = v1 - v0, e2 = v2 - v0;
  place.point = v0 + place.barycentric[1] * e1 + place.barycentric[2] * e2;
  const glm::dvec3 n = glm::cross(e1, e2);
  place.outward = glm::normalize(n / largest(absolute(n)));
  place.entering = view_side(view, counts) < 0;
  // With V the largest vertex component: point 12 u V off its plane (edges 3 u of 2 V, sums 2 u of 3 V), moving it u V,
  // the next ray's a_k 2 u V. Per component, seen along the normal:
  const glm::dvec3 reach{std::max({std::abs(v0.x), std::abs(v1.x), std::abs(v2.x)}),
                         std::max({std::abs(v0.y), std::abs(v1.y), std::abs(v2.y)}),
                         std::max({std::abs(v0.z), std::abs(v1.z), std::abs(v2.z)})};
  place.clearance = 16 * kU * glm::dot(absolute(place.outward), reach);
  return place;
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

int view_side(const TriangleView& view, SignCounts& counts) {
  return dot_cross_sign(view.a[0], view.edge[0], view.weight[0], view.a[1], view.a[2], counts);
}

int edge_agreement(const TriangleView& view, const glm::dvec3& direction, SignCounts& counts) {
  int agreed = 0;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const int sign =
        dot_cross_sign(direction, view.edge[i], view.weight[i], next(view.a, k), after_next(view.a, k), counts);
    if (sign * agreed < 0) return 0;
    if (sign != 0) agreed = sign;
  }
  return agreed;
}

// Derivation of the weight. Exact for the rounded a_k: n* = (a1 - a0) x (a2 - a0). The edge e1 = fl(v1 - v0) is off
// a1 - a0 by at most u w1, w1 = |e1| + |a0| + |a1| per component, and e2 likewise by u w2. A component of n, a
// difference of two products, is then off by at most
//   u (w1_j |e2_k| + |e1_j| w2_k + w1_k |e2_j| + |e1_k| w2_j) + 2 u (|e1_j e2_k| + |e1_k e2_j|)  <=  2 u m_i,
// m_i the first bracket (w >= |e|), and x . n by at most 2 u + 3 u / 2 < 4 u times sum |x_i| m_i.
DepthPlane depth_plane(const TriangleView& view, const glm::dvec3& v0, const glm::dvec3& v1, const glm::dvec3& v2) {
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
                                 exact::determinant(direction, a2, a0), exact::determinant(direction, a0, a1));
}

Hit intersect(const Scene& scene, std::uint32_t primitive, const Ray& ray, const Hit& after, SignCounts& counts) {
  ++counts.tests;
  const PrimitiveRef ref = primitive_ref(scene, primitive);
  switch (ref.kind) {
    case ObjectKind::sphere: return intersect_sphere(scene.spheres[ref.index], primitive, ray, after);
    case ObjectKind::plane: return intersect_plane(scene.planes[ref.index], primitive, ray, after);
    case ObjectKind::mesh: break;
  }
  return intersect_triangle(scene, scene.triangles[ref.index], primitive, ray, after, counts);
}

Hit nearest_of_all(const Scene& scene, const Ray& ray, const Hit& after, SignCounts& counts) {
  Hit nearest;
  for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive) {
    const Hit hit = intersect(scene, primitive, ray, after, counts);
    if (hit.found() && before(hit, nearest)) nearest = hit;
  }
  return nearest;
}

bool before_light(const Scene& scene, const Hit& hit, const Ray& ray, const glm::dvec3& light,
                  SignCounts& counts) {
  // Depth is good to 2^-18 at worst (triangle_depth): outside this margin it decides.
  constexpr double kMargin = 0x1p-16;
  if (hit.t < 1 - kMargin) return true;
  if (hit.t > 1 + kMargin) return false;

  const PrimitiveRef ref = primitive_ref(scene, hit.primitive);
  if (ref.kind == ObjectKind::mesh) {
    // In between iff the two ends lie strictly on opposite sides.
    const auto [v0, v1, v2] = corners(scene, scene.triangles[ref.index]);
    return view_side(view_triangle(light, v0, v1, v2), counts) *
               view_side(view_triangle(ray.origin, v0, v1, v2), counts) < 0;
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

Place locate(const Scene& scene, const Ray& ray, const Hit& hit, SignCounts& counts) {
  const PrimitiveRef ref = primitive_ref(scene, hit.primitive);
  Place place;
  switch (ref.kind) {
    case ObjectKind::sphere: place = locate_sphere(scene.spheres[ref.index], ray, hit); break;
    case ObjectKind::plane: place = locate_plane(scene.planes[ref.index], ray, hit); break;
    case ObjectKind::mesh: place = locate_triangle(scene, scene.triangles[ref.index], ray, counts); break;
  }
  // Two surfaces whose points cannot be told apart: 2 clearances, seen along the ray, and the rounding of two depths.
  const double along = std::abs(glm::dot(ray.direction, place.outward));
  place.together = hit.t + 0x1p-46 * hit.t + (along > 0 ? 4 * place.clearance / along : 0);
  return place;
}

bool contains(const Scene& scene, const Object& solid, const glm::dvec3& point) {
  if (solid.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene.spheres[solid.first];
    const glm::dvec3 f = point - sphere.center;
    return glm::dot(f, f) < sphere.radius * sphere.radius;
  }
  if (solid.kind == ObjectKind::plane) {
    const Plane& plane = scene.planes[solid.first];
    return glm::dot(plane.normal, point - plane.point) < 0;
  }
  double angle = 0;
  for (std::uint32_t i = solid.first; i < solid.first + solid.count; ++i) {
    const auto [v0, v1, v2] = corners(scene, scene.triangles[i]);
    angle += solid_angle(v0 - point, v1 - point, v2 - point);
  }
  return angle > 6.283185307179586;   // half of the full 4 pi: inside a mesh wound outward
}

}  // namespace sidelight
