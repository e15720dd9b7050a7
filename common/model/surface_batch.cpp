// SPDX-License-Identifier: MIT
#include "common/model/surface_batch.h"

#include <algorithm>

#include "common/model/surface_kernel.h"
#include "common/prefetch.h"
#include "common/scene/primitive_finder.h"

namespace sidelight {
namespace {

using Group = SurfaceBatch::Group;

Vec3<double> vec(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// What the kernel reads of one primitive, into entry i; its material.
std::uint32_t fetch(const Scene& scene, std::uint32_t index, SurfaceBatch& batch, Group& group,
                    std::size_t i) {
  if (batch.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene.spheres[index];
    put(batch.vector[0], i, sphere.center);
    batch.vector[1][0][i] = sphere.radius;
    return sphere.material;
  }
  if (batch.kind == ObjectKind::plane) {
    const Plane& plane = scene.planes[index];
    put(batch.vector[0], i, plane.point);
    put(batch.vector[1], i, plane.normal);
    return plane.material;
  }
  const Triangle& triangle = scene.triangles[index];
  const bool flat = triangle.normal[0] == kNone;
  (flat ? group.flat : group.smooth) = true;
  for (std::size_t k = 0; k < 3; ++k) {
    put(batch.vector[k], i, scene.positions[triangle.vertex[k]]);
    put(batch.vector[3 + k], i, flat ? glm::dvec3(0) : scene.normals[triangle.normal[k]]);
  }
  return triangle.material;
}

// Whether all of a group are of one primitive.
bool is_one(const SurfaceBatch& batch, std::size_t first) {
  using Numbers = stdx::native_simd<std::uint32_t>;
  Numbers unlike(0);
  for (std::size_t i = first; i < first + SurfaceBatch::kGroup; i += Numbers::size())
    unlike |= load<Numbers>(&batch.primitive[i]) ^ Numbers(batch.primitive[first]);
  return stdx::all_of(unlike == 0);
}

// Entries beyond the last, up to a whole group, repeat it, so that lanes are full of what is true somewhere.
void pad(SurfaceBatch& batch) {
  const auto size = static_cast<std::size_t>(batch.size);
  for (std::size_t i = size; i % SurfaceBatch::kGroup != 0; ++i) {
    batch.column[i] = batch.column[size - 1];
    batch.row[i] = batch.row[size - 1];
    batch.t[i] = batch.t[size - 1];
    batch.primitive[i] = batch.primitive[size - 1];
    if (!batch.own_rays) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      batch.origin[axis][i] = batch.origin[axis][size - 1];
      batch.direction[axis][i] = batch.direction[axis][size - 1];
    }
  }
}

void prefetch_group(const Scene& scene, PrimitiveFinder& find, const SurfaceBatch& batch, std::size_t first) {
  for (std::size_t i = first; i < first + SurfaceBatch::kGroup; ++i)
    if (i == first || batch.primitive[i] != batch.primitive[i - 1])
      prefetch_surface(scene, find(batch.primitive[i]));
}

// A group that goes on with the one triangle of the group before shares what was fetched for that.
void fetch_group(const Scene& scene, const ShadingTables& tables, PrimitiveFinder& find, SurfaceBatch& batch,
                 ShadingBatch& out, std::size_t first) {
  constexpr std::size_t kGroup = SurfaceBatch::kGroup;
  Group& group = batch.group[first / kGroup];
  group.first = first;
  if (group.one) {
    const Group& before = batch.group[first / kGroup - (first > 0 ? 1 : 0)];
    const bool same = first > 0 && before.one && batch.primitive[first] == batch.primitive[first - 1];
    if (same) group = before;
    const std::uint32_t material =
        same ? out.material[first - 1]
             : fetch(scene, find(batch.primitive[first]).index, batch, group, first);
    group.shiny = is_shiny(tables.materials[material]);
    std::fill_n(&out.material[first], kGroup, material);
    return;
  }
  for (std::size_t i = first; i < first + kGroup; ++i) {
    out.material[i] = fetch(scene, find(batch.primitive[i]).index, batch, group, i);
    if (i == first || out.material[i] != out.material[i - 1])
      group.shiny |= is_shiny(tables.materials[out.material[i]]);
  }
}

void fetch_all(const Scene& scene, const ShadingTables& tables, SurfaceBatch& batch, ShadingBatch& out) {
  constexpr std::size_t kGroup = SurfaceBatch::kGroup;
  const auto size = static_cast<std::size_t>(batch.size);
  for (std::size_t i = 0; i < size; i += kGroup) batch.group[i / kGroup] = {.one = is_one(batch, i)};
  PrimitiveFinder find(scene);
  const auto prefetch_next = [&](std::size_t i) {
    if (!batch.prefetched && i < size && !batch.group[i / kGroup].one) prefetch_group(scene, find, batch, i);
  };
  prefetch_next(0);
  for (std::size_t i = 0; i < size; i += kGroup) {
    prefetch_next(i + kGroup);
    fetch_group(scene, tables, find, batch, out, i);
  }
}

Ray ray_of(const Camera& camera, const SurfaceBatch& batch, std::size_t i) {
  if (!batch.own_rays)
    return {camera.eye, (batch.column[i] * camera.right + batch.row[i] * camera.up) + camera.axis_part()};
  return {get(batch.origin, i), get(batch.direction, i)};
}

// What the lanes leave undecided.
void ask_again(const Scene& scene, const Camera& camera, const ShadingTables& tables, SurfaceBatch& batch,
               std::size_t i, ShadingBatch& out, SignCounts& counts) {
  const Ray ray = ray_of(camera, batch, i);
  Hit hit{batch.t[i], batch.primitive[i]};
  SignCounts not_again;  // who found the primitive has counted this test
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
                 SurfaceBatch& batch, ShadingBatch& out, SignCounts& counts) {
  out.size = batch.size;
  if (batch.size == 0) return;
  pad(batch);
  const auto size = static_cast<std::size_t>(batch.size);
  fetch_all(scene, tables, batch, out);

  const SurfaceView view{vec(camera.eye), vec(camera.right), vec(camera.up), vec(camera.axis_part()),
                         tables.length_scale};
  batch.any_doubtful = false;
  by_isa(isa, surfaces_scalar, surfaces_avx2, surfaces_avx512)(view, batch, out);
  std::uint64_t again = 0;
  for (std::size_t i = 0; batch.any_doubtful && i < size; ++i)
    if (batch.doubtful[i] != 0) {
      ask_again(scene, camera, tables, batch, i, out, counts);
      ++again;
    }
  if (batch.kind == ObjectKind::mesh) counts.in_double += size - again;  // the sides that are seen
}

}  // namespace sidelight
