// SPDX-License-Identifier: MIT
// What the runs of a SurfaceBatch need of their triangles, found once a run (surface_triangles.h), and kept from batch to
// batch: on large triangles many batches in a row have the same runs.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "common/model/shading.h"

namespace sidelight {

// Of each run: visibility.h's TriangleView and DepthPlane, place.cpp's outward normal, surface.cpp's vertex normals.
struct alignas(64) TriangleRuns {
  // Whole vectors are read from any entry on; of a length that does not bring all channels to the same lines of a cache.
  static constexpr std::size_t kSize = static_cast<std::size_t>(ShadingBatch::kCapacity) + 8;
  using Channel = std::array<double, kSize>;
  using Vectors = std::array<Channel, 3>;

  // Which triangle an entry is of, where it is kept: seen from there, with t and leaving rays asked for or not.
  std::array<std::uint32_t, kSize> seen;
  glm::dvec3 eye{0};
  bool with_t = false, with_leaving = false, kept = false;
  // What is kept stays only for the same question; of other rays than the eye's, nothing is.
  void begin(bool keep, const glm::dvec3& from, bool want_t, bool want_leaving) {
    const bool stays = kept && from == eye && want_t == with_t && want_leaving == with_leaving;
    if (keep && !stays) seen.fill(kNone);
    kept = keep;
    eye = from;
    with_t = want_t;
    with_leaving = want_leaving;
  }

  std::array<Vectors, 3> edge;  // turned so that where a ray meets the triangle their sum is positive
  Vectors v0, e1, e2;           // in units of the shading tables
  Channel least_sum;            // of the edge values, a unit of |d|; infinite where nothing is sure
  // On the side of Nv: the normal of vertex 0, and the ways from it to those of the others.
  Vectors normal, to_normal1, to_normal2;
  // By the first entry of a vector: false where no triangle is there in which N changes. Then N, of unit length as floats.
  std::array<bool, kSize> smooth;
  Vectors unit_rounded;
  // If t is asked for.
  Vectors n;
  Channel a0_n, depth_bound;  // lengths2 (|e1|² + |e2|²); infinite where nothing is sure
  // If rays leave.
  Vectors facing, unit;  // Nv; N if it does not change
  Channel clearance;
};

}  // namespace sidelight
