// SPDX-License-Identifier: MIT
// The tracer's kernels, each written once over lanes (bvh_kernel.h, leaf_kernel.h) and instantiated for each instruction
// set. Every set gives the same answers and counts.
#pragma once

#include "raytrace/prepared.h"

namespace sidelight::raytrace {

// Of which primitives but `except` may stands_near() be true at the point, where nearness() is at most `distance`?
// Those and some others are visited.
struct NearQuestion {
  glm::dvec3 point;
  double distance;
  std::uint32_t except;
  void* context;
  void (*visit)(void* context, std::uint32_t primitive);
};

// Rays are finite; planes are left to the caller.
struct Kernels {
  // Replaces `best` by what is nearer, of that which comes after `after`.
  void (*nearest)(const Prepared& prepared, const Ray& ray, const Hit& after, Hit& best, SignCounts& counts);
  // blocker() of prepared.h.
  Hit (*blocker)(const Prepared& prepared, const Ray& ray, const glm::dvec3* light, const Hit& start,
                 SignCounts& counts);
  std::uint64_t (*visit_leaves)(const Bvh& bvh, const Ray& ray, double limit, const LeafVisitor& visitor);
  void (*near_triangles)(const TriangleLeaves& leaves, const NearQuestion& question);
  void (*near_spheres)(const SphereLeaves& leaves, const NearQuestion& question);
};

const Kernels& kernels_scalar();
const Kernels& kernels_avx2();
const Kernels& kernels_avx512();

inline const Kernels& kernels_for(Isa isa) {
  if (isa == Isa::avx512) return kernels_avx512();
  return isa == Isa::avx2 ? kernels_avx2() : kernels_scalar();
}

}  // namespace sidelight::raytrace
