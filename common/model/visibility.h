// SPDX-License-Identifier: MIT
// Which surface does a ray meet first? The one answer: the z-buffer, the tracer and both references ask these
// functions, so they agree on object, primitive and depth bit for bit (README "The idea").
//
// A hit is exact: exact for the doubles of the ray's direction d and of a_k = v_k - o, the triangle's vertices
// relative to the ray's origin, each rounded once. All triangles at a vertex see the same a_k, so closed meshes stay
// closed. With E_k = d . (a_i x a_j) and s the sign of a_0 . (a_1 x a_2), the ray meets the triangle iff
// s E_k >= 0 for all three edges and not all are zero; s = 0 (the origin in the triangle's plane) is a miss. Signs
// are computed in double with an error bound and, where that cannot decide, exactly (exact.h).
// Edges are closed and there is no fill rule: of surfaces at equal depth the lower primitive number wins.
//
// E_k is at once the clipless homogeneous edge function of M. Olano and T. Greer, "Triangle Scan Conversion using 2D
// Homogeneous Coordinates", 1997, section 3, and the signed volume of T. Davidovic et al., "3D Rasterization: A Bridge
// between Rasterization and Ray Casting", 2012, section 3.
#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "common/picture/frame.h"
#include "common/scene/scene.h"

namespace sidelight {

// direction is finite and not zero, of any length; its non-zero components are at least 1e-100 in magnitude.
struct Ray {
  glm::dvec3 origin{0}, direction{0};
};

// A ray whose tiny direction components (below 1e-100) are zeroed, so that exact.h is exact.
Ray make_ray(const glm::dvec3& origin, const glm::dvec3& direction);

// origin + t direction lies on `primitive`.
struct Hit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t primitive = kNone;

  bool found() const { return primitive != kNone; }
  bool operator==(const Hit&) const = default;
};

// The total order of surfaces along a ray: by depth, then by number.
inline bool before(const Hit& a, const Hit& b) {
  return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
}

// Every hit with t > 0 comes after it.
inline constexpr Hit kRayStart{0.0, kNone};

// ---- One triangle, seen from one origin ----

struct Corners {
  const glm::dvec3 &v0, &v1, &v2;
};

inline Corners corners(const Scene& scene, const Triangle& triangle) {
  return {scene.positions[triangle.vertex[0]], scene.positions[triangle.vertex[1]],
          scene.positions[triangle.vertex[2]]};
}

struct TriangleView {
  std::array<glm::dvec3, 3> a;       // vertices relative to the origin
  std::array<glm::dvec3, 3> edge;    // edge[k] = a[k+1] x a[k+2], in double
  std::array<glm::dvec3, 3> weight;  // |.||.| + |.||.| of the same: the permanent, which bounds the rounding
};

TriangleView view_triangle(const glm::dvec3& origin, const glm::dvec3& v0, const glm::dvec3& v1,
                           const glm::dvec3& v2);

// The exact sign of a_0 . (a_1 x a_2): negative where the origin sees the front (outward) side.
int view_side(const TriangleView& view, VisibilityCounts& counts);

// 1 where all three E_k >= 0, -1 where all are <= 0, 0 where both signs occur or all are zero. The ray meets the
// triangle iff this equals view_side() and that is not 0.
int edge_agreement(const TriangleView& view, const glm::dvec3& direction, VisibilityCounts& counts);

// E_0, E_1, E_2 of a hit with the sign of the side and a relative error of their sum below 2^-20: in double, or exact and
// rounded once where the triangle is seen nearly edge-on.
std::array<double, 3> edge_values(const TriangleView& view, const glm::dvec3& direction);

// What depth needs of a triangle, once per origin.
struct DepthPlane {
  glm::dvec3 n;       // (v1 - v0) x (v2 - v0)
  glm::dvec3 weight;  // bounds the distance of n from the exact normal of the rounded a_k
  double a0_n = 0;
  bool sure = false;  // whether a0_n is good to 2^-20
};

DepthPlane depth_plane(const TriangleView& view, const glm::dvec3& v0, const glm::dvec3& v1,
                       const glm::dvec3& v2);

// The depth t of a ray that meets the triangle: (a_0 . n)/(d . n); where rounding may leave one of them with a relative
// error above 2^-20 (nearly edge-on), the exact quotient rounded once. Positive. Within 2^-18 of the exact quotient.
double triangle_depth(const TriangleView& view, const DepthPlane& plane, const glm::dvec3& direction);

// ---- One sphere ----

// Both roots of |o + t d - c| = r in ascending order; NaN where the line misses.
struct Roots {
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
};

Roots sphere_roots(const Sphere& sphere, const Ray& ray);

// ---- Any primitive ----

// The nearest hit of one primitive that comes after `after`; not found() if there is none. Spheres: tangent is a hit,
// from inside one sees the inside. Planes: a parallel or contained ray is a miss. A ray that is not finite, against the
// contract, meets nothing. One of counts.tests.
Hit intersect(const Scene& scene, std::uint32_t primitive, const Ray& ray, const Hit& after,
              VisibilityCounts& counts);

// What intersect() finds of a triangle with these corners, for a ray that is known to meet it: only the depth is open.
Hit met_triangle(const glm::dvec3& v0, const glm::dvec3& v1, const glm::dvec3& v2, std::uint32_t primitive,
                 const Ray& ray, const Hit& after);

// Whether the ray surely has the triangle's plane behind its origin, so that intersect() finds nothing: a quick question
// for rays that leave a triangle.
bool plane_behind(const glm::dvec3& v0, const glm::dvec3& v1, const glm::dvec3& v2, const Ray& ray);

// The nearest hit of all primitives, by looking at every one of them.
Hit nearest_of_all(const Scene& scene, const Ray& ray, const Hit& after, VisibilityCounts& counts);

// On which side of the surface a point lies, as intersect() tells it of a ray's origin: 1 on the outward one, -1 on the
// other, 0 where it cannot be told from the surface. Of a triangle it is that of its plane, and exact.
int side_of(const Scene& scene, std::uint32_t primitive, const glm::dvec3& point, VisibilityCounts& counts);

// Whether `hit`, found along `ray` from P with direction light - P, lies strictly between P and the light. Decided by
// t where that is clear and, next to the light, by the sides on which the two ends lie (exactly, for a triangle).
bool before_light(const Scene& scene, const Hit& hit, const Ray& ray, const glm::dvec3& light,
                  VisibilityCounts& counts);

}  // namespace sidelight
