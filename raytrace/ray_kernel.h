// SPDX-License-Identifier: MIT
// The questions about one ray, and about what stands near a point, for lane types F of floats (boxes) and D of doubles
// (leaves). Included only by kernels_in_lanes.h.
#pragma once

#include "raytrace/bundle_kernel.h"
#include "raytrace/bvh_kernel.h"
#include "raytrace/kernels.h"
#include "raytrace/leaf_kernel.h"
#include "raytrace/near_kernel.h"

namespace sidelight::raytrace {

// A primitive that a filter left, with its kRows numbers from the leaf.
template <int kRows>
struct Candidate {
  std::uint32_t primitive;
  const double* numbers;
  std::uint32_t stride;  // from one number to the next
  bool met;              // surely: only the depth is open

  glm::dvec3 corner(std::uint32_t k) const {
    const double* row = numbers + 3 * k * stride;
    return {row[0], row[stride], row[2 * stride]};
  }

  // A triangle at right angles to an axis, in whose plane the ray starts, as rays do that leave a floor at y = 0: a miss,
  // and one that the signs of visibility.h would find by exact arithmetic only.
  bool starts_in_flat(const glm::dvec3& origin) const {
    const auto all_at = [&](std::uint32_t axis, double o) {
      return numbers[axis * stride] == o && numbers[(3 + axis) * stride] == o &&
             numbers[(6 + axis) * stride] == o;
    };
    return all_at(0, origin.x) || all_at(1, origin.y) || all_at(2, origin.z);
  }

  [[gnu::always_inline]] Hit hit(const Scene& scene, const Ray& ray, const Hit& after,
                                 VisibilityCounts& counts) const {
    if constexpr (kRows == TriangleLeaves::kRowCount) {
      const glm::dvec3 v0 = corner(0), v1 = corner(1), v2 = corner(2);
      const bool missed = !met && (starts_in_flat(ray.origin) || plane_behind(v0, v1, v2, ray));
      if (met || missed) {
        ++counts.tests;
        counts.filtered += 4;
        return missed ? Hit{} : met_triangle(v0, v1, v2, primitive, ray, after);
      }
    }
    return intersect(scene, primitive, ray, after, counts);
  }
};

// Signs that are decided where a primitive is dropped: those of a triangle's edges.
template <int kRows>
inline constexpr std::uint32_t kSigns = kRows == TriangleLeaves::kRowCount ? 3 : 0;

// Hands every primitive that may be met at a depth from `from` to `limit`, as far as the filter can tell, to
// ask(candidate, limit), which returns the new limit.
template <class F, class Filter, int kRows, class Ask>
[[gnu::always_inline]] inline double ask_leaves(const Leaves<kRows>& leaves, const Filter& filter,
                                                const Ray& ray, double from, double limit,
                                                VisibilityCounts& counts, const Ask& ask) {
  counts.nodes +=
      walk<F>(leaves.bvh, ray, from, limit, [&](std::uint32_t first, std::uint32_t count, double current) {
        const double* leaf = leaves.leaf(first);
        const LeafVerdict verdict = filter(leaf, count, current);
        const auto dropped = count - static_cast<std::uint32_t>(std::popcount(verdict.may));
        counts.tests += dropped;  // the others are counted where they are asked
        counts.filtered += kSigns<kRows> * dropped;
        for (std::uint32_t bits = verdict.may; bits != 0 && current >= 0; bits &= bits - 1) {
          const auto i = static_cast<std::uint32_t>(std::countr_zero(bits));
          const bool met = (verdict.must >> i & 1) != 0;
          current = ask(Candidate<kRows>{leaves.bvh.items[first + i], leaf + i, count, met}, current);
        }
        return limit = current;
      });
  return limit;
}

// Of triangles and spheres, until a limit is negative.
template <class F, class D, class Ask>
[[gnu::always_inline]] inline void ask_all(const Prepared& prepared, const Ray& ray, double from,
                                           double limit, VisibilityCounts& counts, const Ask& ask) {
  const TriangleLeaves& triangles = prepared.triangles;
  const SphereLeaves& spheres = prepared.spheres;
  if (!triangles.bvh.nodes.empty())
    limit = ask_leaves<F>(triangles, TriangleFilter<D>(ray), ray, from, limit, counts, ask);
  if (limit >= 0 && !spheres.bvh.nodes.empty())
    ask_leaves<F>(spheres, SphereFilter<D>(ray, spheres.bvh.reach), ray, from, limit, counts, ask);
}

template <class F, class D>
[[gnu::flatten]] void nearest_in_lanes(const Prepared& prepared, const Ray& ray, const Hit& after,
                                       std::uint32_t except, Hit& best, VisibilityCounts& counts) {
  ask_all<F, D>(prepared, ray, after.t, best.t, counts, [&](const auto& candidate, double) {
    if (candidate.primitive == except) return best.t;
    const Hit hit = candidate.hit(prepared.scene, ray, after, counts);
    if (hit.found() && before(hit, best)) best = hit;
    return best.t;
  });
}

// Hands every primitive that a ray may meet at a depth from its start to its limit, as far as the filter can tell, to
// ask(r, candidate), which returns the new limit.
template <class F, class D, class Filter, int kRows, class Ask>
[[gnu::always_inline]] inline void ask_leaves_of(const Leaves<kRows>& leaves, const Filter* filters,
                                                 BundleRays& rays, VisibilityCounts& counts, const Ask& ask) {
  Bundle bundle;
  set_up<D>(leaves.bvh, rays, bundle);
  const auto visit = [&](std::uint32_t first, std::uint32_t count, std::uint32_t by) {
    const double* leaf = leaves.leaf(first);
    // All verdicts before anything is done about one, so that none waits for another.
    std::array<LeafVerdict, Bundle::kCapacity> verdicts;
    std::uint32_t asking = 0, dropped = 0;
    for (; by != 0; by &= by - 1) {
      const auto r = static_cast<std::size_t>(std::countr_zero(by));
      const LeafVerdict verdict = filters[r](leaf, count, rays.limit[r]);
      verdicts[r] = verdict;  // and not read back here: its halves, stored one by one, would be waited for
      asking |= std::uint32_t{verdict.may != 0} << r;
      dropped += count - static_cast<std::uint32_t>(std::popcount(verdict.may));
    }
    counts.tests += dropped;
    counts.filtered += kSigns<kRows> * dropped;
    for (; asking != 0; asking &= asking - 1) {
      const auto r = static_cast<std::size_t>(std::countr_zero(asking));
      for (std::uint32_t bits = verdicts[r].may; bits != 0 && rays.limit[r] >= 0; bits &= bits - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(bits));
        const bool met = (verdicts[r].must >> i & 1) != 0;
        rays.limit[r] = ask(r, Candidate<kRows>{leaves.bvh.items[first + i], leaf + i, count, met});
      }
      bundle.set_limit(r, rays.limit[r]);
    }
  };
  counts.nodes += walk<F, FloatLanes<D>>(leaves.bvh, bundle, (1u << rays.size) - 1, visit);
}

// Of triangles and spheres. ray_of(r): the ray that rays[r] is.
template <class F, class D, class RayOf, class Ask>
[[gnu::always_inline]] inline void ask_all_of(const Prepared& prepared, BundleRays& rays, const RayOf& ray_of,
                                              VisibilityCounts& counts, const Ask& ask) {
  const TriangleLeaves& triangles = prepared.triangles;
  const SphereLeaves& spheres = prepared.spheres;
  rays.fill_up();
  if (!triangles.bvh.nodes.empty()) {
    std::array<TriangleFilter<D>, Bundle::kCapacity> filters;
    for (std::size_t r = 0; r < rays.size; ++r) filters[r] = TriangleFilter<D>(ray_of(r));
    ask_leaves_of<F, D>(triangles, filters.data(), rays, counts, ask);
  }
  if (!spheres.bvh.nodes.empty()) {
    std::array<SphereFilter<D>, Bundle::kCapacity> filters;
    for (std::size_t r = 0; r < rays.size; ++r) filters[r] = SphereFilter<D>(ray_of(r), spheres.bvh.reach);
    ask_leaves_of<F, D>(spheres, filters.data(), rays, counts, ask);
  }
}

template <class F, class D>
[[gnu::flatten]] void nearest_of_in_lanes(const Prepared& prepared, std::span<RayQuestion> questions,
                                          VisibilityCounts& counts) {
  for (std::size_t at = 0; at < questions.size(); at += Bundle::kCapacity) {
    const auto some = questions.subspan(at, std::min(Bundle::kCapacity, questions.size() - at));
    BundleRays rays;
    for (const RayQuestion& question : some) rays.add(question.ray, question.after.t, question.best.t);
    const auto ray_of = [&](std::size_t r) -> const Ray& { return some[r].ray; };
    ask_all_of<F, D>(prepared, rays, ray_of, counts, [&](std::size_t r, const auto& candidate) {
      RayQuestion& question = some[r];
      if (candidate.primitive == question.except) return question.best.t;
      const Hit hit = candidate.hit(prepared.scene, question.ray, question.after, counts);
      if (hit.found() && before(hit, question.best)) question.best = hit;
      return question.best.t;
    });
  }
}

// The hit of a candidate that casts a shadow and stands before the light.
template <int kRows>
[[gnu::always_inline]] inline Hit blocking_hit(const Prepared& prepared, const Candidate<kRows>& candidate,
                                               const Ray& ray, const glm::dvec3* light, const Hit& start,
                                               VisibilityCounts& counts) {
  const auto hit = [&]() __attribute__((always_inline)) {
    return candidate.hit(prepared.scene, ray, start, counts);
  };
  return blocking_hit(prepared, candidate.primitive, ray, light, counts, hit);
}

// Whether there is one. Of a sphere that is surely met before the light no root is needed.
template <int kRows>
[[gnu::always_inline]] inline bool blocks(const Prepared& prepared, const Candidate<kRows>& candidate,
                                          const Ray& ray, const glm::dvec3* light, VisibilityCounts& counts) {
  if (kRows == SphereLeaves::kRowCount && candidate.met && prepared.all_cast_shadows) {
    ++counts.tests;
    return true;
  }
  return blocking_hit(prepared, candidate, ray, light, kRayStart, counts).found();
}

template <class F, class D>
[[gnu::flatten]] Hit blocker_in_lanes(const Prepared& prepared, const Ray& ray, const glm::dvec3* light,
                                      const Hit& start, VisibilityCounts& counts) {
  Hit found;
  const double limit = light_depth(light);
  ask_all<F, D>(prepared, ray, start.t, limit, counts, [&](const auto& candidate, double current) {
    found = blocking_hit(prepared, candidate, ray, light, start, counts);
    return found.found() ? -1.0 : current;
  });
  return found;
}

template <class F, class D>
[[gnu::flatten]] void blocked_of_in_lanes(const Prepared& prepared, std::span<ShadowQuestion> questions,
                                          const glm::dvec3* light, VisibilityCounts& counts) {
  const double limit = light_depth(light);
  for (std::size_t at = 0; at < questions.size(); at += Bundle::kCapacity) {
    const auto some = questions.subspan(at, std::min(Bundle::kCapacity, questions.size() - at));
    BundleRays rays;
    for (const ShadowQuestion& question : some)
      rays.add(question.ray, kRayStart.t, question.blocked ? -1 : limit);
    const auto ray_of = [&](std::size_t r) -> const Ray& { return some[r].ray; };
    ask_all_of<F, D>(prepared, rays, ray_of, counts, [&](std::size_t r, const auto& candidate) {
      ShadowQuestion& question = some[r];
      question.blocked = blocks(prepared, candidate, question.ray, light, counts);
      return question.blocked ? -1.0 : limit;
    });
  }
}

template <class F, class D>
[[gnu::flatten]] void candidates_in_lanes(const Prepared& prepared, const Ray& ray, double from, double limit,
                                          VisibilityCounts& counts, const PrimitiveVisitor& visitor) {
  ask_all<F, D>(prepared, ray, from, limit, counts, [&](const auto& candidate, double current) {
    visitor.visit(visitor.context, candidate.primitive);
    return current;
  });
}

// D, in the name only, keeps apart what is compiled for several instruction sets (tests/test_arrows.cpp).
template <class F, class D>
[[gnu::flatten]] std::uint64_t traverse_in_lanes(const Bvh& bvh, const Ray& ray, double limit,
                                                 const ItemVisitor& visitor) {
  return walk<F>(bvh, ray, 0, limit, [&](std::uint32_t first, std::uint32_t count, double current) {
    for (std::uint32_t i = first; i < first + count && current >= 0; ++i)
      current = visitor.visit(visitor.context, bvh.items[i], current);
    return current;
  });
}

template <class F, class D, int kRows>
[[gnu::flatten]] void near_in_lanes(const Leaves<kRows>& leaves, const NearQuestion& question) {
  const glm::dvec3 low = question.point - question.distance, high = question.point + question.distance;
  walk_near<F>(leaves.bvh, low, high, [&](std::uint32_t first, std::uint32_t count) {
    const std::uint32_t* items = leaves.bvh.items.data() + first;
    std::uint32_t others = 0, bits = 0;
    for (std::uint32_t i = 0; i < count; ++i) others |= std::uint32_t{items[i] != question.except} << i;
    for (std::uint32_t lane = 0; lane < count; lane += kLanes<D>)
      bits |= near_bits<D>(leaves, leaves.leaf(first) + lane, count, others >> lane, question.point,
                           question.distance)
              << lane;
    for (bits &= others; bits != 0; bits &= bits - 1)
      question.visitor.visit(question.visitor.context,
                             items[static_cast<std::uint32_t>(std::countr_zero(bits))]);
    return !question.enough || !*question.enough;
  });
}

template <class F, class D>
[[gnu::flatten]] double inset_in_lanes(const TriangleLeaves& leaves, const InsetQuestion& question) {
  const InsetFilter<D> filter(question.corners, question.room);
  double inset = 0;
  walk_near<F>(leaves.bvh, filter.low(), filter.high(), [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t lane = 0; lane < count; lane += kLanes<D>) {
      alignas(64) std::array<double, kLanes<D>> beside;
      store<D>(filter(leaves.leaf(first) + lane, count), beside.data());
      for (std::uint32_t i = lane; i < std::min<std::uint32_t>(count, lane + kLanes<D>); ++i)
        if (leaves.bvh.items[first + i] != question.except) inset = lane_max(inset, beside[i - lane]);
    }
    return inset < 1;
  });
  return inset;
}

}  // namespace sidelight::raytrace
