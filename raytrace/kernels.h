// SPDX-License-Identifier: MIT
// The tracer's kernels, each written once over lanes (ray_kernel.h, packet_kernel.h) and instantiated for each instruction
// set. Every set gives the same answers and, but for those of packets, the same counts.
#pragma once

#include <span>

#include "raytrace/prepared.h"
#include "raytrace/ray_batches.h"

namespace sidelight::raytrace {

struct PrimitiveVisitor {
  void* context;
  void (*visit)(void* context, std::uint32_t primitive);
};
// One that calls visit(primitive), which must outlive it.
template <class Visit>
PrimitiveVisitor visitor_of(Visit& visit) {
  return {&visit, [](void* to, std::uint32_t primitive) { (*static_cast<Visit*>(to))(primitive); }};
}

// What a traversal does with an item of the tree: returns the new limit, negative to stop.
struct ItemVisitor {
  void* context;
  double (*visit)(void* context, std::uint32_t item, double limit);
};

// Of which primitives but `except` may stands_near() be true at the point, where nearness() is at most `distance`?
// Those and some others are visited.
struct NearQuestion {
  glm::dvec3 point;
  double distance;
  std::uint32_t except;
  PrimitiveVisitor visitor;
  const bool* enough = nullptr;  // where there is one, nothing more is asked once it is true
};

// How far from its edges is a triangle free of others? At points with barycentric weights of at least the answer, or more,
// no triangle but `except` is within `room`, along each axis; 1: nowhere.
struct InsetQuestion {
  Corners corners;
  double room;
  std::uint32_t except;
};

// For the nearest hit of a ray after `after`, but not that of `except`: `best` is replaced by what is nearer.
struct RayQuestion {
  Ray ray;
  Hit after;
  std::uint32_t except = kNone;
  Hit best;
};

// Whether something blocks a ray to a light, after kRayStart; nothing is asked where that is known already.
struct ShadowQuestion {
  Ray ray;
  bool blocked = false;
};

struct RayPacket;
class ShadowQueries;
struct CubeFace;
struct ShadowPlaces;

// Rays are finite; planes are left to the caller.
struct Kernels {
  // Replaces `best` by what is nearer, of that which comes after `after` and is not `except`.
  void (*nearest)(const Prepared& prepared, const Ray& ray, const Hit& after, std::uint32_t except, Hit& best,
                  VisibilityCounts& counts);
  // The same for many rays, finite or not: neighbours should have much the same way.
  void (*nearest_of)(const Prepared& prepared, std::span<RayQuestion> questions, VisibilityCounts& counts);
  // blocker() of prepared.h.
  Hit (*blocker)(const Prepared& prepared, const Ray& ray, const glm::dvec3* light, const Hit& start,
                 VisibilityCounts& counts);
  // Whether it finds something, for many rays to one light: likewise.
  void (*blocked_of)(const Prepared& prepared, std::span<ShadowQuestion> questions, const glm::dvec3* light,
                     VisibilityCounts& counts);
  // Visits all primitives that may be met at a depth from `from` to `limit`.
  void (*candidates)(const Prepared& prepared, const Ray& ray, double from, double limit,
                     VisibilityCounts& counts, const PrimitiveVisitor& visitor);
  // Visits every item whose leaf's box the ray may meet at a depth <= limit, nearer leaves first as far as nodes are sorted
  // by it. No hit that visibility.h would report at a depth <= limit is lost: boxes are padded for the rounding of v - o and
  // of sphere roots (64 u of all coordinates involved), the limit for that of a depth (2^-18). Returns the number of nodes
  // entered. Neither it nor the order depends on the instruction set.
  std::uint64_t (*traverse)(const Bvh& bvh, const Ray& ray, double limit, const ItemVisitor& visitor);
  void (*near_triangles)(const TriangleLeaves& leaves, const NearQuestion& question);
  void (*near_spheres)(const SphereLeaves& leaves, const NearQuestion& question);
  double (*inset)(const TriangleLeaves& leaves, const InsetQuestion& question);
  // Each fills the batch's results.
  void (*directions)(OpticsBatch& batch);
  void (*own_hits)(BallBatch& batch);
  // Meets everything in the scene that casts shadows (RayPacket::any_hit), or simply everything, as far as the budget goes;
  // planes, too.
  void (*trace_packet)(const Prepared& prepared, RayPacket& packet, VisibilityCounts& counts);
  // Of all queries that ask, or only of those behind the face; `places` has room for all. How many they are, or kNotSeen.
  std::size_t (*find_places)(const ShadowQueries& queries, const CubeFace& face, bool all,
                             ShadowPlaces& places);
};

const Kernels& kernels_scalar();
const Kernels& kernels_avx2();
const Kernels& kernels_avx512();

inline const Kernels& kernels_for(Isa isa) {
  return by_isa(isa, kernels_scalar, kernels_avx2, kernels_avx512)();
}

// Kernels::traverse with visit(item, limit).
template <class Visit>
std::uint64_t traverse(const Bvh& bvh, const Ray& ray, double limit, const Visit& visit,
                       Isa isa = best_isa()) {
  const auto call = [](void* to, std::uint32_t item, double current) {
    return (**static_cast<const Visit**>(to))(item, current);
  };
  const Visit* context = &visit;
  return kernels_for(isa).traverse(bvh, ray, limit, {&context, call});
}

}  // namespace sidelight::raytrace
