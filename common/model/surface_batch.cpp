// SPDX-License-Identifier: MIT
#include "common/model/surface_batch.h"

#include <algorithm>

#include "common/math/norms.h"
#include "common/model/kernels.h"
#include "common/model/surface_lanes.h"
#include "common/prefetch.h"
#include "common/scene/primitive_finder.h"

namespace sidelight {
namespace {

constexpr std::size_t kGroup = SurfaceBatch::kGroup;

std::size_t whole_groups(int size) { return (static_cast<std::size_t>(size) + kGroup - 1) / kGroup * kGroup; }

// Entries beyond the last, up to a whole group, repeat it, so that lanes are full of what is true somewhere.
void pad(SurfaceBatch& batch) {
  const auto size = static_cast<std::size_t>(batch.size);
  for (std::size_t i = size; i < whole_groups(batch.size); ++i) {
    batch.column[i] = batch.column[size - 1];
    batch.row[i] = batch.row[size - 1];
    batch.t[i] = batch.t[size - 1];
    batch.run[i] = batch.run[size - 1];
    if (!batch.own_rays) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      batch.origin[axis][i] = batch.origin[axis][size - 1];
      batch.direction[axis][i] = batch.direction[axis][size - 1];
    }
  }
}

std::uint32_t material_of(const Scene& scene, ObjectKind kind, std::uint32_t index) {
  if (kind == ObjectKind::sphere) return scene.spheres[index].material;
  if (kind == ObjectKind::plane) return scene.planes[index].material;
  return scene.triangles[index].material;
}

// What the kernel has to know of the primitives, and what shading has to.
void fetch(const Scene& scene, const ShadingTables& tables, SurfaceBatch& batch, ShadingBatch& out) {
  batch.shiny = false;
  PrimitiveFinder find(scene);
  const auto runs = static_cast<std::size_t>(batch.runs);
  for (std::size_t r = 0; r < runs; ++r) {
    batch.index[r] = find(batch.primitive[r]).index;
    if (!batch.prefetched && batch.kind == ObjectKind::mesh) prefetch(&scene.triangles[batch.index[r]]);
  }
  for (std::size_t r = 0; r < runs && !batch.prefetched; ++r)
    prefetch_surface(scene, {batch.kind, batch.index[r]});
  std::array<std::uint32_t, SurfaceBatch::kCapacity> material;
  std::uint32_t unlike = 0;
  for (std::size_t r = 0; r < runs; ++r) {
    material[r] = material_of(scene, batch.kind, batch.index[r]);
    unlike |= material[r] ^ material[0];
    batch.shiny |= is_shiny(tables.materials[material[r]]);
  }
  const std::size_t size = whole_groups(batch.size);
  if (unlike == 0)
    std::fill_n(out.material.begin(), size, material[0]);
  else
    for (std::size_t i = 0; i < size; ++i) out.material[i] = material[batch.run[i]];
  for (std::size_t r = runs; r < whole_groups(batch.runs); ++r) batch.index[r] = batch.index[runs - 1];
}

double longest_direction(const Camera& camera) {
  return (1 + 0x1p-40) * (camera.columns() * l1_norm(camera.right) + camera.rows() * l1_norm(camera.up) +
                          l1_norm(camera.axis_part()));
}

Ray ray_of(const Camera& camera, const SurfaceBatch& batch, std::size_t i) {
  if (!batch.own_rays)
    return {camera.eye, (batch.column[i] * camera.right + batch.row[i] * camera.up) + camera.axis_part()};
  return {get(batch.origin, i), get(batch.direction, i)};
}

// What the lanes leave undecided.
void ask_again(const Scene& scene, const Camera& camera, const ShadingTables& tables, SurfaceBatch& batch,
               std::size_t i, ShadingBatch& out, VisibilityCounts& counts) {
  const Ray ray = ray_of(camera, batch, i);
  Hit hit{batch.t[i], batch.primitive[batch.run[i]]};
  VisibilityCounts not_again;  // who found the primitive has counted this test
  if (!batch.has_t) hit = intersect(scene, hit.primitive, ray, kRayStart, not_again);
  batch.t[i] = hit.t;
  const Surface surface = surface_at(scene, ray, hit, counts);
  out.set(i, shading_point(tables, surface, ray), surface.material);
  if (!batch.want_leaving) return;
  put(batch.point, i, surface.point);
  put(batch.facing, i, surface.facing);
  put(batch.normal, i, surface.normal);
  batch.clearance[i] = surface.clearance;
}

}  // namespace

void prefetch_surface(const Scene& scene, const PrimitiveRef& ref) {
  if (ref.kind != ObjectKind::mesh) return;
  const Triangle& triangle = scene.triangles[ref.index];
  for (std::size_t k = 0; k < 3; ++k) {
    prefetch(&scene.positions[triangle.vertex[k]]);
    if (triangle.normal[k] != kNone) prefetch(&scene.normals[triangle.normal[k]]);
  }
}

void surfaces_at(Isa isa, const Scene& scene, const Camera& camera, const ShadingTables& tables,
                 SurfaceBatch& batch, ShadingBatch& out, VisibilityCounts& counts) {
  out.size = batch.size;
  if (batch.size == 0) return;
  pad(batch);
  const auto size = static_cast<std::size_t>(batch.size);
  fetch(scene, tables, batch, out);

  const SurfaceView view{scene,
                         wide<double>(camera.eye),
                         wide<double>(camera.right),
                         wide<double>(camera.up),
                         wide<double>(camera.axis_part()),
                         longest_direction(camera),
                         tables.length_scale};
  batch.any_doubtful = false;
  if (batch.kind == ObjectKind::mesh) {
    if (!batch.triangle_runs) batch.triangle_runs = std::make_unique_for_overwrite<TriangleRuns>();
    batch.triangle_runs->begin(!batch.own_rays, camera.eye, batch.want_t && !batch.has_t, batch.want_leaving);
  }
  model_kernels(isa).surfaces(view, batch, out);
  std::uint64_t again = 0;
  for (std::size_t i = 0; batch.any_doubtful && i < size; ++i)
    if (batch.doubtful[i] != 0) {
      ask_again(scene, camera, tables, batch, i, out, counts);
      ++again;
    }
  if (batch.kind == ObjectKind::mesh) counts.in_double += size - again;  // the sides that are seen
}

}  // namespace sidelight
