// SPDX-License-Identifier: MIT
// The questions about one ray, for lane types F of floats (boxes) and D of doubles (leaves). Included only by
// kernels_scalar.cpp, kernels_avx2.cpp and kernels_avx512.cpp.
#pragma once

#include "raytrace/bvh_kernel.h"
#include "raytrace/kernels.h"
#include "raytrace/leaf_kernel.h"
#include "raytrace/near_kernel.h"

namespace sidelight::raytrace {

// A primitive that a filter left, and what of it is certain.
struct Candidate {
  std::uint32_t primitive;
  const double* numbers;  // in its leaf, `stride` apart
  std::uint32_t stride;
  bool met;  // a triangle that the ray surely meets: only its depth is open

  Hit hit(const Scene& scene, const Ray& ray, const Hit& after, SignCounts& counts) const {
    if (!met) return intersect(scene, primitive, ray, after, counts);
    ++counts.tests;
    counts.filtered += 4;
    const auto corner = [&](std::uint32_t k) {
      const double* row = numbers + 3 * k * stride;
      return glm::dvec3(row[0], row[stride], row[2 * stride]);
    };
    return met_triangle(corner(0), corner(1), corner(2), primitive, ray, after);
  }
};

// Hands every primitive that the filter leaves to ask(candidate, limit), which returns the new limit.
template <class F, class Filter, int kRows, class Ask>
[[gnu::always_inline]] inline double ask_leaves(const Leaves<kRows>& leaves, const Filter& filter,
                                                const Ray& ray, double limit, SignCounts& counts,
                                                const Ask& ask) {
  counts.nodes +=
      walk<F>(leaves.bvh, ray, limit, [&](std::uint32_t first, std::uint32_t count, double current) {
        const double* leaf = leaves.leaf(first);
        const LeafVerdict verdict = filter(leaf, count, current);
        const auto dropped = count - static_cast<std::uint32_t>(std::popcount(verdict.may));
        counts.tests += dropped;  // the others are counted where they are asked
        counts.filtered += 3 * dropped;
        for (std::uint32_t bits = verdict.may; bits != 0 && current >= 0; bits &= bits - 1) {
          const auto i = static_cast<std::uint32_t>(std::countr_zero(bits));
          const bool met = (verdict.must >> i & 1) != 0;
          current = ask(Candidate{leaves.bvh.items[first + i], leaf + i, count, met}, current);
        }
        return limit = current;
      });
  return limit;
}

template <class F, class D>
[[gnu::flatten]] void nearest_in_lanes(const Prepared& prepared, const Ray& ray, const Hit& after, Hit& best,
                                       SignCounts& counts) {
  const auto ask = [&](const Candidate& candidate, double) {
    const Hit hit = candidate.hit(prepared.scene, ray, after, counts);
    if (hit.found() && before(hit, best)) best = hit;
    return best.t;
  };
  ask_leaves<F>(prepared.triangles, TriangleFilter<D>(ray), ray, best.t, counts, ask);
  ask_leaves<F>(prepared.spheres, SphereFilter<D>(ray, prepared.spheres.bvh.reach), ray, best.t, counts, ask);
}

template <class F, class D>
[[gnu::flatten]] Hit blocker_in_lanes(const Prepared& prepared, const Ray& ray, const glm::dvec3* light,
                                      const Hit& start, SignCounts& counts) {
  Hit found;
  const auto ask = [&](const Candidate& candidate, double limit) {
    if (!prepared.all_cast_shadows && !casts_shadow(prepared.scene, candidate.primitive)) return limit;
    const Hit hit = candidate.hit(prepared.scene, ray, start, counts);
    if (!hit.found() || (light && !before_light(prepared.scene, hit, ray, *light, counts))) return limit;
    found = hit;
    return -1.0;
  };
  const double limit = light ? 1 : std::numeric_limits<double>::infinity();
  if (ask_leaves<F>(prepared.triangles, TriangleFilter<D>(ray), ray, limit, counts, ask) >= 0)
    ask_leaves<F>(prepared.spheres, SphereFilter<D>(ray, prepared.spheres.bvh.reach), ray, limit, counts,
                  ask);
  return found;
}

template <class F, class D>
[[gnu::flatten]] std::uint64_t visit_leaves_in_lanes(const Bvh& bvh, const Ray& ray, double limit,
                                                     const LeafVisitor& visitor) {
  return walk<F>(bvh, ray, limit, [&](std::uint32_t first, std::uint32_t count, double current) {
    return visitor.visit(visitor.context, first, count, current);
  });
}

template <class F, class D, int kRows>
[[gnu::always_inline]] inline void ask_leaves_near(const Leaves<kRows>& leaves, const glm::dvec3& point,
                                                   double distance, const PrimitiveVisitor& visitor) {
  walk_near<F>(leaves.bvh, point, distance, [&](std::uint32_t first, std::uint32_t count) {
    std::uint32_t bits = 0;
    for (std::uint32_t lane = 0; lane < count; lane += kLanes<D>)
      bits |= near_bits<D>(leaves, leaves.leaf(first) + lane, count, point, distance) << lane;
    for (bits &= (1u << count) - 1; bits != 0; bits &= bits - 1)
      visitor.visit(visitor.context,
                    leaves.bvh.items[first + static_cast<std::uint32_t>(std::countr_zero(bits))]);
  });
}

template <class F, class D>
[[gnu::flatten]] void near_triangles_in_lanes(const TriangleLeaves& leaves, const glm::dvec3& point,
                                              double distance, const PrimitiveVisitor& visitor) {
  ask_leaves_near<F, D>(leaves, point, distance, visitor);
}

template <class F, class D>
[[gnu::flatten]] void near_spheres_in_lanes(const SphereLeaves& leaves, const glm::dvec3& point,
                                            double distance, const PrimitiveVisitor& visitor) {
  ask_leaves_near<F, D>(leaves, point, distance, visitor);
}

template <class F, class D>
inline constexpr Kernels kKernels{nearest_in_lanes<F, D>, blocker_in_lanes<F, D>, visit_leaves_in_lanes<F, D>,
                                  near_triangles_in_lanes<F, D>, near_spheres_in_lanes<F, D>};

}  // namespace sidelight::raytrace
