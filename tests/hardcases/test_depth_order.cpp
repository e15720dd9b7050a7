// SPDX-License-Identifier: MIT
// Which of several surfaces the z-buffer shows: order at a depth ratio of 1e7 (RAS-7), coplanar surfaces (RAS-9).
#include "common/model/visibility.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// A quadrilateral that fills the view of plain_camera, tilted (by less than 1/8 in x and y, so that all of it stays in
// front): its depth on the view's axis is `depth`.
PolygonMesh tilted_quad(double depth, double tilt_x, double tilt_y) {
  std::vector<glm::dvec3> corners;
  for (const glm::dvec3& d :
       {glm::dvec3(-4, -4, -1), glm::dvec3(4, -4, -1), glm::dvec3(4, 4, -1), glm::dvec3(-4, 4, -1)})
    corners.push_back(depth / (1 + tilt_x * d.x + tilt_y * d.y) * d);
  return mesh_of(corners, {{0, 1, 2}, {0, 2, 3}});
}

}  // namespace

// ---- RAS-7: surfaces at z and z (1 + g), z from near to far; by distance alone the first is seen ----

TEST_CASE("RAS-7: of two planes the nearer one is found, from 1e-3 to 1e4 and to 1e7") {
  Random random(7);
  VisibilityCounts counts;
  std::uint64_t wrong = 0, pairs = 0;
  for (const double far : {1e4, 1e7})
    for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
      const double z = random.log_uniform(1e-3, far), g = random.log_uniform(3e-7, 1e-2);
      const double near_z = z, far_z = z * (1 + g);
      const Ray ray = make_ray({0, 0, 0}, {random.uniform(-1, 1), random.uniform(-1, 1), -1});
      // One a plane, one a triangle across the view, in either order of the file.
      const bool plane_is_near = random.bits() & 1;
      Scene scene = empty_scene();
      const auto plane = [&] {
        add_plane(scene, {{0, 0, -(plane_is_near ? near_z : far_z)}, {0, 0, 1}, 0}, {});
      };
      const auto triangle = [&] {
        const double at = plane_is_near ? far_z : near_z;
        add_mesh(scene,
                 mesh_of({{-9 * at, -9 * at, -at}, {9 * at, -9 * at, -at}, {0, 9 * at, -at}}, {{0, 1, 2}}),
                 {}, {});
      };
      const bool plane_first = random.bits() & 1;
      if (plane_first) plane();
      triangle();
      if (!plane_first) plane();
      const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
      ++pairs;
      wrong +=
          !hit.found() || (primitive_ref(scene, hit.primitive).kind == ObjectKind::plane) != plane_is_near;
    }
  HardCase("RAS-7").none("pairs of planes, g from 3e-7 to 1e-2, in the wrong order or tied", wrong, pairs);
}

// The farther quadrilateral is the nearer one scaled about the eye by 1 + g, so it is farther on every ray.
TEST_CASE("RAS-7: of two tilted quads the nearer one is shown at every sample") {
  const int edge = tier() == "sanitized" ? 64 : 512;
  const Camera camera = plain_camera(edge, edge);
  Random random(71);
  std::uint64_t wrong = 0, samples = 0;
  for (const double far : {1e4, 1e7})
    for (const double g : {1e-2, 1e-4, 1e-5, 1e-6, 3e-7}) {
      const double z = random.log_uniform(1e-3, far), x = random.uniform(-0.1, 0.1),
                   y = random.uniform(-0.1, 0.1);
      const bool near_first = random.bits() & 1;
      Scene scene = empty_scene();
      add_mesh(scene, tilted_quad(near_first ? z : z * (1 + g), x, y), {}, {});
      add_mesh(scene, tilted_quad(near_first ? z * (1 + g) : z, x, y), {}, {});
      for (const Frame& frame : {rastered(scene, camera), traced(scene, camera)})
        for (const std::uint32_t id : frame.object_id) {
          ++samples;
          wrong += id != (near_first ? 1u : 2u);
        }
    }
  HardCase("RAS-7").none("samples of tilted quads that show the farther one or none", wrong, samples);
}

// ---- RAS-9 ----

namespace {

// Frames by one and more threads, tiles of 8 to 64, and by the tracer: do they differ in ids or depths?
std::uint64_t unlike_each_other(const Scene& scene, const Camera& camera) {
  std::uint64_t unlike = 0;
  const Frame first = rastered(scene, camera, keeping(kVisibilityLayers));
  for (const int threads : {1, 2, 4, 8})
    for (const int tile : {8, 16, 32, 64}) {
      RenderOptions options = keeping(kVisibilityLayers);
      options.threads = threads;
      options.tile = tile;
      unlike += !differences(rastered(scene, camera, options), first).empty();
    }
  return unlike + !differences(traced(scene, camera, keeping(kVisibilityLayers)), first).empty();
}

// In the plane z = -8 + x/4 + y/2, dyadic.
glm::dvec3 in_plane(double x, double y) { return {x, y, -8 + 0.25 * x + 0.5 * y}; }

}  // namespace

TEST_CASE("RAS-9: coplanar surfaces and ties") {
  const HardCase hard("RAS-9");
  const Camera camera = plain_camera(90, 70, 0.9);  // rays of 53 bits, so that depths are rounded
  Random random(9);
  std::uint64_t unlike = 0, scenes = 0;

  // Twice the same mesh: the lower number everywhere.
  const PolygonMesh ball = star_sphere(12, 18, 0.3, 3);
  Scene twice = empty_scene();
  Transform away;
  away.translate = {0, 0, -4};
  add_mesh(twice, ball, away, {});
  add_mesh(twice, ball, away, {});
  std::uint64_t higher = 0, covered = 0;
  for (const Frame& frame : {rastered(twice, camera), traced(local_only(twice), camera)})
    for (const std::uint32_t id : frame.object_id) {
      covered += id != 0;
      higher += id > 1;
    }
  hard.none("samples of a duplicate that show the higher number", higher, covered);
  unlike += unlike_each_other(twice, camera);
  ++scenes;

  // One square cut in two ways.
  Scene square = empty_scene();
  const std::vector<glm::dvec3> corners{in_plane(-2, -2), in_plane(2, -2), in_plane(2, 2), in_plane(-2, 2),
                                        in_plane(snapped(0.3), snapped(-0.7))};
  add_mesh(square, mesh_of(corners, {{0, 1, 2}, {0, 2, 3}}), {}, {});
  add_mesh(square, mesh_of(corners, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}), {}, {});
  unlike += unlike_each_other(square, camera);
  ++scenes;
  double most_ulps = 0;
  std::uint64_t two_depths = 0;
  VisibilityCounts counts;
  for (int Y = 0; Y < camera.rows(); ++Y)
    for (int X = 0; X < camera.columns(); ++X) {
      const Ray ray{camera.eye, camera.direction(X, Y)};
      double low = INFINITY, high = 0;
      for (std::uint32_t i = 0; i < 6; ++i) {
        const Hit hit = intersect(square, i, ray, kRayStart, counts);
        if (!hit.found()) continue;
        low = std::min(low, hit.t);
        high = std::max(high, hit.t);
      }
      if (high == 0) continue;
      ++two_depths;
      most_ulps = std::max(most_ulps, (high - low) / (std::nextafter(low, INFINITY) - low));
    }
  REQUIRE(two_depths > 100);
  hard.at_most("depths of one square cut in two ways, ulp apart", most_ulps, 4);

  // Many overlapping triangles of one plane, and again in another order of the file.
  const std::uint32_t many = tier() == "sanitized" ? 250 : 1000;
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < many; ++i) {
    for (int k = 0; k < 3; ++k)
      positions.push_back(in_plane(snapped(random.uniform(-3, 3)), snapped(random.uniform(-3, 3))));
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const PolygonMesh pile = mesh_of(positions, faces);
  PolygonMesh shuffled = pile;
  for (std::size_t i = shuffled.faces.size() - 1; i > 0; --i)
    std::swap(shuffled.faces[i], shuffled.faces[random.below(static_cast<std::uint32_t>(i + 1))]);
  for (const PolygonMesh& mesh : {pile, shuffled}) {
    unlike += unlike_each_other(scene_of(mesh), camera);
    ++scenes;
  }
  hard.none("frames that change with threads, tiles or renderer", unlike, 17 * scenes);
}
