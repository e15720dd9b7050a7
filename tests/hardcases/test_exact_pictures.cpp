// SPDX-License-Identifier: MIT
// RVR-2: on dyadic scenes both renderers show, at every sample, the triangle that 128-bit integers find. Ten
// tessellated spheres, some of which intersect, stand on a ground that reaches behind the eye; most of their
// triangles are smaller than a pixel. Seen once by a camera whose rays are small integers, so that many run exactly
// through edges and vertices, and once by one that looks any way.
#include "common/scene/build.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/exact_picture.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;
using namespace sidelight::testing;

namespace {

PolygonMesh placed(PolygonMesh mesh, const glm::dvec3& center, double radius) {
  for (glm::dvec3& p : mesh.positions) p = snapped(center + radius * p);
  return mesh;
}

Scene spheres_on_ground(std::uint64_t triangles) {
  Random random(20);
  Scene scene = empty_scene();
  // rows of `rows` cells, twice as many columns: about 4 rows² triangles a sphere
  const auto rows = static_cast<std::uint32_t>(std::max(4.0, std::sqrt(static_cast<double>(triangles) / 40)));
  for (int i = 0; i < 10; ++i) {
    const double radius = snapped(random.uniform(0.4, 1.1));
    const glm::dvec3 center{random.uniform(-3, 3), radius, random.uniform(-3, 2)};
    add_mesh(scene,
             placed(star_sphere(rows, 2 * rows, 0.05, 100 + static_cast<std::uint64_t>(i)), center, radius),
             {}, {});
  }
  add_mesh(scene, mesh_of({{-12, 0, 12}, {12, 0, 12}, {12, 0, -12}, {-12, 0, -12}}, {{0, 1, 2}, {0, 2, 3}}),
           {}, {});
  return scene;
}

// Rays d = (i/2, j/2, -2H), i and j odd, from a height of 1 meet the ground where x = i/|j| and z = 7 - 4H/|j|: on its
// diagonal x = -z for every i = 4H - 7|j|.
CameraSettings straight_ahead() {
  CameraSettings settings;
  settings.eye = {0, 1, 7};
  settings.look_at = {0, 1, 0};
  settings.view_height = 0.5;
  return settings;
}

CameraSettings any_way() {
  CameraSettings settings;
  settings.eye = snapped(glm::dvec3(0.7, 2.6, 7.9));
  settings.look_at = {0.1, 0.6, 0.2};
  settings.view_height = 0.68;
  return settings;
}

}  // namespace

TEST_CASE("RVR-2: both renderers show what 128-bit integers find") {
  std::uint64_t samples = 0, covered = 0, exactly_on_edges = 0, z_buffer = 0, tracer = 0;
  const Scene scene = local_only(spheres_on_ground(tier_count("exact_picture_triangles")));
  for (const std::string& text : tier_list("exact_picture_sizes"))
    for (const CameraSettings& settings : {straight_ahead(), any_way()}) {
      const PictureSize size = parse_size(text);
      const Camera camera = make_camera(settings, size.width, size.height, 1);
      const ExactPicture exact(scene, camera);
      z_buffer += exact.mismatches(rastered(scene, camera));
      tracer += exact.mismatches(traced(scene, camera));
      for (int Y = 0; Y < camera.rows(); ++Y)
        for (int X = 0; X < camera.columns(); ++X) {
          ++samples;
          covered += exact.at(X, Y).met > 0;
          exactly_on_edges += exact.at(X, Y).met > exact.at(X, Y).strictly;
        }
    }
  const HardCase hard("RVR-2");
  hard.none("samples where the z-buffer shows another surface than 128-bit integers", z_buffer, samples);
  hard.none("samples where the tracer shows another surface than 128-bit integers", tracer, samples);
  hard.at_least("share of samples that meet a triangle",
                static_cast<double>(covered) / static_cast<double>(samples), 0.5);
  hard.at_least("rays exactly through an edge or a vertex", static_cast<double>(exactly_on_edges), 1);
}
