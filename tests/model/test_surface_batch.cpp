// SPDX-License-Identifier: MIT
// surfaces_at() says what surface_at() and shading_point() say, bit for bit, on every instruction set: of triangles with
// and without vertex normals, spheres and planes, seen plainly, from within, nearly edge-on and from far away.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "common/model/surface_batch.h"
#include "common/scene/build.h"
#include "tests/support/random.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Corners and, of every second one, normals, the same at all corners of half of these; slivers, triangles seen edge-on by
// an eye at the origin, tiny ones.
void add_triangles(Scene& scene, Random& random, std::uint32_t material) {
  PolygonMesh mesh;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const glm::dvec3 v0 = random.in_box(3) - glm::dvec3(0, 0, 4);
    const double size = i % 3 == 0 ? random.log_uniform(1e-7, 1) : 2;
    const glm::dvec3 v1 = v0 + size * random.in_box(1);
    glm::dvec3 v2 = v0 + size * random.in_box(1);
    if (i % 5 == 1)
      v2 = 1.5 * v0 + random.log_uniform(1e-15, 1e-3) * random.in_box(1);  // the eye near its plane
    if (i % 5 == 2) v2 = 0.5 * (v0 + v1) + random.log_uniform(1e-12, 1e-3) * random.in_box(1);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::dvec3& v : {v0, v1, v2}) {
      mesh.positions.push_back(v);
      mesh.normals.push_back(i % 4 == 1 && v != v0 ? mesh.normals.back() : random.direction());
    }
    for (std::uint32_t k = 0; k < 3; ++k) mesh.corners.push_back({first + k, i % 2 == 0 ? kNone : first + k});
    mesh.faces.push_back({first, 3, material, 0, 0});
  }
  add_mesh(scene, mesh, {}, {});
}

Scene scene_of_surfaces(Random& random) {
  Scene scene;
  for (int i = 0; i < 3; ++i) {
    Material material;
    material.diffuse = glm::dvec3(0.5);
    material.specular = glm::dvec3(i == 0 ? 0 : 0.5);
    add_material(scene, material);
  }
  add_triangles(scene, random, 0);
  add_triangles(scene, random, 1);
  for (std::uint32_t i = 0; i < 8; ++i)  // the eye within some, or on them
    add_sphere(scene, {random.in_box(2), i == 3 ? 1e-4 : random.log_uniform(0.1, 4), i % 3}, {});
  add_sphere(scene, {{0, 0, -1}, 1, 2}, {});
  for (std::uint32_t i = 0; i < 6; ++i) add_plane(scene, {random.in_box(2), random.direction(), i % 3}, {});
  return scene;
}

bool same(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same(const ShadingBatch::Rgb& batch, std::size_t i, const Vec3<float>& v) {
  return same(batch[0][i], v.x) && same(batch[1][i], v.y) && same(batch[2][i], v.z);
}

bool same(const SurfaceBatch::Vectors& batch, std::size_t i, const glm::dvec3& v) {
  const glm::dvec3 of_batch{batch[0][i], batch[1][i], batch[2][i]};
  return std::memcmp(&of_batch, &v, sizeof v) == 0;
}

// How rays come and what is asked for.
struct Mode {
  bool has_t = false, own_rays = false, want_leaving = false;
  bool by_rows = false;   // row by row, each primitive in turn: short runs, several to a vector
  bool in_pieces = true;  // batches of all sizes, not as large as can be
};

struct Outcome {
  std::uint64_t entries = 0, unlike = 0, exact = 0;
};

// Compares a batch with the twin, and empties it.
void check(Isa isa, const Scene& scene, const Camera& camera, const ShadingTables& tables,
           SurfaceBatch& batch, const std::vector<Ray>& rays, const std::vector<Hit>& hits,
           Outcome& outcome) {
  ShadingBatch out;
  VisibilityCounts counts, twin_counts;
  static const Camera elsewhere = make_camera({.eye = {0, 0, 1}, .look_at = {0, 0, 0}}, 1, 1, 1);
  surfaces_at(isa, scene, batch.own_rays ? elsewhere : camera, tables, batch, out, counts);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Surface surface = surface_at(scene, rays[i], hits[i], twin_counts);
    const ShadingPoint<float> point = shading_point(tables, surface, rays[i]);
    const Vec3<double> ks = {point.specular.x, point.specular.y, point.specular.z};
    const bool shiny = ks.x != 0 || ks.y != 0 || ks.z != 0;
    outcome.unlike +=
        !(same(out.high, i, point.high) && same(out.low, i, point.low) && same(out.normal, i, point.normal) &&
          out.material[i] == surface.material && (!shiny || same(out.to_viewer, i, point.to_viewer)) &&
          (!batch.want_leaving ||
           (same(batch.point, i, surface.point) && same(batch.facing, i, surface.facing) &&
            same(batch.normal, i, surface.normal) && same(out.facing, i, point.facing) &&
            std::memcmp(&batch.clearance[i], &surface.clearance, sizeof(double)) == 0)) &&
          (!batch.want_t || std::memcmp(&batch.t[i], &hits[i].t, sizeof(double)) == 0));
  }
  outcome.entries += hits.size();
  outcome.unlike += counts.in_double != twin_counts.in_double || counts.exact != twin_counts.exact;
  outcome.exact += counts.exact;
  batch.clear();
}

// The samples of a picture, every primitive of the batch's kind that the ray meets.
void compare_picture(Isa isa, const Mode& mode, const Scene& scene, const Camera& camera, SurfaceBatch& batch,
                     Random& random, Outcome& outcome) {
  const ShadingTables tables = make_shading_tables(scene, needs_of(scene));
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  VisibilityCounts counts;
  const auto see = [&](std::uint32_t primitive, int X, int Y) {
    const Ray ray{camera.eye, camera.direction(X, Y)};
    const Hit hit = intersect(scene, primitive, ray, kRayStart, counts);
    if (!hit.found()) return;
    const auto i = static_cast<std::size_t>(batch.size);
    batch.t[i] = hit.t;
    for (int axis = 0; axis < 3 && mode.own_rays; ++axis) {
      batch.origin[static_cast<std::size_t>(axis)][i] = ray.origin[axis];
      batch.direction[static_cast<std::size_t>(axis)][i] = ray.direction[axis];
    }
    batch.column[i] = camera.column_factor(X);
    batch.row[i] = camera.row_factor(Y);
    if (mode.own_rays || i == 0 || primitive != hits.back().primitive) {
      batch.add(primitive);
    } else {
      batch.run[i] = batch.run[i - 1];
      ++batch.size;
    }
    rays.push_back(ray);
    hits.push_back(hit);
    if (batch.room() > 0 && !(mode.in_pieces && random.below(80) == 0)) return;
    check(isa, scene, camera, tables, batch, rays, hits, outcome);
    rays.clear();
    hits.clear();
  };
  const int all = camera.rows(), together = mode.by_rows ? 1 : all;
  for (int first = 0; first < all; first += together)
    for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive) {
      if (primitive_ref(scene, primitive).kind != batch.kind) continue;
      for (int Y = first; Y < first + together; ++Y)
        for (int X = 0; X < camera.columns(); ++X) see(primitive, X, Y);
    }
  check(isa, scene, camera, tables, batch, rays, hits, outcome);
}

// Pictures from several eyes.
Outcome compared(Isa isa, const Mode& mode) {
  Random random(70);
  Outcome outcome;
  for (std::uint64_t round = 0; round < 1 + tier_count("rays_per_case") / 4000; ++round) {
    const Scene scene = scene_of_surfaces(random);
    CameraSettings settings;
    settings.eye = round % 2 == 0 ? glm::dvec3(0) : random.in_box(round % 4 == 1 ? 2 : 1e5);
    settings.look_at = settings.eye + random.direction();
    if (round % 4 == 3) settings.look_at = glm::dvec3(0);
    settings.view_height = round % 4 == 3 ? 1e-4 : 2;
    for (std::size_t kind = 0; kind < 3; ++kind) {
      SurfaceBatch batch;
      batch.kind = static_cast<ObjectKind>(kind);
      batch.has_t = mode.has_t;
      batch.own_rays = mode.own_rays;
      batch.want_leaving = mode.want_leaving;
      batch.want_t = true;
      compare_picture(isa, mode, scene, make_camera(settings, 12, 9, 2), batch, random, outcome);
    }
  }
  return outcome;
}

void check_isa(Isa isa) {
  if (!machine_has(isa)) return skip_test(std::string("no ") + std::string(isa_name(isa)));
  for (const Mode& mode :
       {Mode{}, Mode{.by_rows = true}, Mode{.has_t = true}, Mode{.want_leaving = true, .by_rows = true},
        Mode{.want_leaving = true}, Mode{.has_t = true, .own_rays = true, .want_leaving = true}}) {
    const Outcome outcome = compared(isa, mode);
    CHECK(outcome.entries > 1000);
    CHECK(outcome.unlike == 0);
  }
}

// One batch, asked in turn from three eyes, with more and less to find, and of rays of their own: what is kept of triangles
// from batch to batch may answer no other question.
void check_what_is_kept(Isa isa) {
  if (!machine_has(isa)) return skip_test(std::string("no ") + std::string(isa_name(isa)));
  Random random(71);
  Scene scene;
  add_material(scene, Material{});
  PolygonMesh quad;
  quad.positions = {{-9, -9, -3}, {9, -9, -4}, {9, 9, -5}, {-9, 9, -4}};
  for (std::uint32_t k = 0; k < 4; ++k) quad.corners.push_back({k, kNone});
  quad.faces.push_back({0, 4, 0, 0, 0});
  add_mesh(scene, quad, {}, {});
  SurfaceBatch batch;
  batch.want_t = true;
  Outcome outcome;
  constexpr std::uint64_t kPictures = 1000;  // so each question follows each other one
  for (std::uint64_t picture = 0; picture < kPictures; ++picture) {
    batch.own_rays = random.below(2) == 0;
    batch.want_leaving = random.below(2) == 0;
    batch.has_t = batch.own_rays || random.below(2) == 0;
    constexpr std::array<glm::dvec3, 3> kEyes{{{0, 0, 1}, {1, 0, 1}, {0, 0, -9}}};  // before it and behind it
    CameraSettings settings;
    settings.eye = kEyes[random.below(3)];
    settings.look_at = {0, 0, -4};
    const Mode mode{.own_rays = batch.own_rays, .in_pieces = false};
    compare_picture(isa, mode, scene, make_camera(settings, 12, 9, 1), batch, random, outcome);
  }
  CHECK(outcome.entries == kPictures * 12 * 9);
  CHECK(outcome.unlike == 0);
}

using Numbers = std::vector<std::uint32_t>;

// The primitive of each entry, as its run says.
Numbers primitives_of(const SurfaceBatch& batch) {
  Numbers primitives;
  for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); ++i)
    primitives.push_back(batch.primitive[batch.run[i]]);
  return primitives;
}

}  // namespace

TEST_CASE("surfaces: neighbours keep their primitives, whatever their runs were numbered") {
  const Numbers shown{70, 71, 71, 71, 72, 70, 70, 73};
  const Numbers run_of{4, 5, 5, 5, 6, 7, 7, 8};
  const auto primitive_of = [&](std::uint32_t run) {
    return shown[static_cast<std::size_t>(std::find(run_of.begin(), run_of.end(), run) - run_of.begin())];
  };
  SurfaceBatch batch;
  // In two pieces, cut within a run, after an entry that comes alone; and again after clear().
  for (int round = 0; round < 2; ++round) {
    batch.add(99);
    batch.add(-7, 3, &run_of[0], 3, primitive_of);
    batch.add(-1, 3, &run_of[3], 5, primitive_of);
    CHECK(primitives_of(batch) == Numbers{99, 70, 71, 71, 71, 72, 70, 70, 73});
    CHECK(batch.runs == 1 + 2 + 4);
    for (std::size_t k = 0; k < shown.size(); ++k) {
      CHECK(batch.column[1 + k] == -7 + 2 * static_cast<double>(k));
      CHECK(batch.row[1 + k] == 3);
    }
    batch.clear();
  }
}

TEST_CASE("surfaces in lanes: scalar") {
  check_isa(Isa::scalar);
  check_what_is_kept(Isa::scalar);
}
TEST_CASE("surfaces in lanes: AVX2") {
  check_isa(Isa::avx2);
  check_what_is_kept(Isa::avx2);
}
TEST_CASE("surfaces in lanes: AVX-512") {
  check_isa(Isa::avx512);
  check_what_is_kept(Isa::avx512);
}
