// SPDX-License-Identifier: MIT
// The questions about one ray, for lane types F of floats (boxes) and D of doubles (leaves). Included only by
// kernels_scalar.cpp, kernels_avx2.cpp and kernels_avx512.cpp.
#pragma once

#include "raytrace/bvh_kernel.h"
#include "raytrace/kernels.h"
#include "raytrace/leaf_kernel.h"

namespace sidelight::raytrace {

// Hands every primitive that the filter leaves to ask(primitive, limit), which returns the new limit.
template <class F, class Filter, int kRows, class Ask>
[[gnu::always_inline]] inline double ask_leaves(const Leaves<kRows>& leaves, const Ray& ray, double limit,
                                                SignCounts& counts, const Ask& ask) {
  if (leaves.bvh.nodes.empty()) return limit;
  const Filter filter(ray, leaves.bvh.reach);
  counts.nodes +=
      walk<F>(leaves.bvh, ray, limit, [&](std::uint32_t first, std::uint32_t count, double current) {
        std::uint32_t bits = filter(leaves.leaf(first), count, current);
        const auto dropped = count - static_cast<std::uint32_t>(std::popcount(bits));
        counts.tests += dropped;  // the others are counted where they are asked
        counts.filtered += 3 * dropped;
        for (; bits != 0 && current >= 0; bits &= bits - 1)
          current =
              ask(leaves.bvh.items[first + static_cast<std::uint32_t>(std::countr_zero(bits))], current);
        return limit = current;
      });
  return limit;
}

template <class F, class D>
[[gnu::flatten]] void nearest_in_lanes(const Prepared& prepared, const Ray& ray, const Hit& after, Hit& best,
                                       SignCounts& counts) {
  const auto ask = [&](std::uint32_t primitive, double) {
    const Hit hit = intersect(prepared.scene, primitive, ray, after, counts);
    if (hit.found() && before(hit, best)) best = hit;
    return best.t;
  };
  ask_leaves<F, TriangleFilter<D>>(prepared.triangles, ray, best.t, counts, ask);
  ask_leaves<F, SphereFilter<D>>(prepared.spheres, ray, best.t, counts, ask);
}

template <class F, class D>
[[gnu::flatten]] Hit blocker_in_lanes(const Prepared& prepared, const Ray& ray, const glm::dvec3* light,
                                      const Hit& start, SignCounts& counts) {
  Hit found;
  const auto ask = [&](std::uint32_t primitive, double limit) {
    found = blocking_hit(prepared, primitive, ray, light, start, counts);
    return found.found() ? -1.0 : limit;
  };
  const double limit = light ? 1 : std::numeric_limits<double>::infinity();
  if (ask_leaves<F, TriangleFilter<D>>(prepared.triangles, ray, limit, counts, ask) >= 0)
    ask_leaves<F, SphereFilter<D>>(prepared.spheres, ray, limit, counts, ask);
  return found;
}

template <class F, class D>
[[gnu::flatten]] std::uint64_t visit_leaves_in_lanes(const Bvh& bvh, const Ray& ray, double limit,
                                                     const LeafVisitor& visitor) {
  return walk<F>(bvh, ray, limit, [&](std::uint32_t first, std::uint32_t count, double current) {
    return visitor.visit(visitor.context, first, count, current);
  });
}

template <class F, class D>
[[gnu::flatten]] void visit_leaves_near_in_lanes(const Bvh& bvh, const glm::dvec3& point, double distance,
                                                 const LeafVisitor& visitor) {
  walk_near<F>(bvh, point, distance, [&](std::uint32_t first, std::uint32_t count) {
    visitor.visit(visitor.context, first, count, 0);
  });
}

template <class F, class D>
inline constexpr Kernels kKernels{nearest_in_lanes<F, D>, blocker_in_lanes<F, D>, visit_leaves_in_lanes<F, D>,
                                  visit_leaves_near_in_lanes<F, D>};

}  // namespace sidelight::raytrace
