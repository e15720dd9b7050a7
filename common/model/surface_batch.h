// SPDX-License-Identifier: MIT
// The surfaces at many hits at once, of eye rays or of any rays, in structure-of-arrays form: what surface_at() and
// shading_point() say of one hit, bit for bit, computed in lanes. Whoever collects hits of one kind of primitive in a
// SurfaceBatch gets a ShadingBatch, ready to be shaded. surface_at() is the readable twin, and what decides wherever the
// lanes' own, coarser certificates do not (a triangle seen nearly edge-on).
#pragma once

#include <algorithm>
#include <memory>

#include "common/model/shading.h"
#include "common/model/triangle_runs.h"
#include "common/scene/camera.h"

namespace sidelight {

// Rays that meet primitives of one kind: eye rays of the lattice, or each with an origin and a direction of its own.
struct SurfaceBatch {
  static constexpr int kCapacity = ShadingBatch::kCapacity, kGroup = ShadingBatch::kGroup;
  template <class T>
  using Channel = std::array<T, static_cast<std::size_t>(kCapacity)>;
  using Vectors = std::array<Channel<double>, 3>;
  // 0, 2, 4, ...: column factors of neighbours.
  static constexpr Channel<double> kTwice = [] {
    Channel<double> twice{};
    for (int k = 0; k < kCapacity; ++k) twice[static_cast<std::size_t>(k)] = 2 * k;
    return twice;
  }();

  ObjectKind kind = ObjectKind::mesh;
  int size = 0;
  alignas(64) Channel<double> column, row;  // Camera::column_factor, row_factor
  alignas(64) Channel<double> t;            // depth, where it is known; else a result, where it is asked for
  // Entries in a row that share a primitive, and the place from which they see it, are a run: which run each entry is of,
  // numbered from 0 without gaps, and of each run which primitive. (Two runs in a row may share it, too.)
  alignas(64) Channel<std::uint32_t> run, primitive;
  int runs = 0;
  alignas(64) Channel<std::uint32_t> sample;  // the caller's own number of an entry, if it has one
  bool has_t = false;                         // t is given
  bool want_t = false;
  bool prefetched = false;  // by whoever collects the batch
  bool own_rays = false;    // origin and direction are given, in place of column and row; has_t goes with it
  alignas(64) Vectors origin, direction;

  int room() const { return kCapacity - size; }
  void clear() { size = runs = 0; }
  // `count` <= room() neighbours in a row, from the one with this column factor: the run that each is of, by any numbers that
  // ascend by 0 or 1, and primitive_of(such a number).
  template <class PrimitiveOf>
  void add(double first_column, double row_factor, const std::uint32_t* run_of, int count,
           const PrimitiveOf& primitive_of) {
    const auto to = static_cast<std::size_t>(size), added = static_cast<std::size_t>(count);
    const std::uint32_t shift = static_cast<std::uint32_t>(runs) - run_of[0];
    for (std::size_t k = 0; k < added; ++k) column[to + k] = first_column + kTwice[k];
    std::fill_n(&row[to], added, row_factor);
    for (std::size_t k = 0; k < added; ++k) run[to + k] = run_of[k] + shift;
    for (std::uint32_t r = run_of[0]; r <= run_of[added - 1]; ++r)
      primitive[static_cast<std::size_t>(runs++)] = primitive_of(r);
    size += count;
  }
  // For rows one below the other that show one primitive: sets what all of them share, which stays from batch to batch.
  // As many of them as there is room for may then be added, and nothing else.
  void begin_rows(double first_column, int width) {
    for (int from = 0; from + width <= kCapacity; from += width)
      for (int k = 0; k < width; ++k)
        column[static_cast<std::size_t>(from + k)] = first_column + kTwice[static_cast<std::size_t>(k)];
    run.fill(0);
  }
  void add_row(double row_factor, int width, std::uint32_t of_primitive) {
    std::fill_n(&row[static_cast<std::size_t>(size)], static_cast<std::size_t>(width), row_factor);
    size += width;
    primitive[0] = of_primitive;
    runs = 1;
  }
  // An entry that is a run of its own.
  void add(std::uint32_t of_primitive) {
    primitive[static_cast<std::size_t>(runs)] = of_primitive;
    run[static_cast<std::size_t>(size++)] = static_cast<std::uint32_t>(runs++);
  }

  // Set by surfaces_at(): of each run which triangle, sphere or plane (of all vectors' lanes beyond the last: some).
  alignas(64) Channel<std::uint32_t> index;
  bool shiny = false;  // V is asked for
  // Results, if asked for: Place::point, facing and clearance, and Surface::normal. ShadingBatch::facing goes with them.
  bool want_leaving = false;
  alignas(64) Vectors point, facing, normal;
  alignas(64) Channel<double> clearance;
  // Not 0 where the lanes cannot be sure; and whether that is so anywhere.
  alignas(64) Channel<double> doubtful;
  bool any_doubtful = false;
  // Of triangles, its own from batch to batch, all of one scene and for one instruction set.
  std::unique_ptr<TriangleRuns> triangle_runs;
};

// Entry i.
inline glm::dvec3 get(const SurfaceBatch::Vectors& from, std::size_t i) {
  return {from[0][i], from[1][i], from[2][i]};
}
inline void put(SurfaceBatch::Vectors& to, std::size_t i, const glm::dvec3& v) {
  to[0][i] = v.x;
  to[1][i] = v.y;
  to[2][i] = v.z;
}

// Brings near what surfaces_at() reads of a primitive of this kind and index; its own record is read for it.
void prefetch_surface(const Scene& scene, const PrimitiveRef& ref);

// Fills entries [0, size) of `out`, and of what batch asks for. The same bytes for every isa.
void surfaces_at(Isa isa, const Scene& scene, const Camera& camera, const ShadingTables& tables,
                 SurfaceBatch& batch, ShadingBatch& out, VisibilityCounts& counts);

}  // namespace sidelight
