// SPDX-License-Identifier: MIT
// RVR-2: on dyadic scenes both renderers show, at every sample, the triangle that 128-bit integers find. Ten
// tessellated spheres, some of which intersect, stand on a ground that reaches behind the eye; most of their
// triangles are smaller than a pixel. Seen once by a camera whose rays are small integers, so that many run exactly
// through edges and vertices, and once by one that looks any way. The same for a scanned mesh: a made one, and that of
// the OBJ file that the environment variable SIDELIGHT_SCAN names.
#include <cstdlib>

#include "common/scene/build.h"
#include "common/scene/obj.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/dyadic_scenes.h"
#include "tests/support/exact_picture.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Rows and columns of a star sphere of about so many triangles: twice as many columns as rows, two triangles a cell.
std::uint32_t rows_for(double triangles) {
  return static_cast<std::uint32_t>(std::max(4.0, std::sqrt(triangles / 4)));
}

Scene scene_of_all(const std::vector<PolygonMesh>& meshes) {
  Scene scene = empty_scene();
  for (const PolygonMesh& mesh : meshes) add_mesh(scene, mesh, {}, {});
  return scene;
}

Scene spheres_on_ground(std::uint64_t triangles) {
  const std::uint32_t rows = rows_for(static_cast<double>(triangles) / 10);
  std::vector<PolygonMesh> meshes = ten_spheres(rows, 2 * rows);
  meshes.push_back(ground());
  return scene_of_all(meshes);
}

Scene scan_on_ground(const PolygonMesh& scan) { return scene_of_all({fitted(scan), ground()}); }

// Rays d = (i/2, j/2, -2H), i and j odd, from a height of 1 meet the ground where x = i/|j| and z = 7 - 4H/|j|: on its
// diagonal x = -z for every i = 4H - 7|j|.
CameraSettings straight_ahead() {
  CameraSettings settings;
  settings.eye = {0, 1, 7};
  settings.look_at = {0, 1, 0};
  settings.view_height = 0.5;
  return settings;
}

// At every size and by both cameras, as rows that begin with `what`.
void check_exact(const std::string& what, const Scene& lit) {
  std::uint64_t samples = 0, covered = 0, exactly_on_edges = 0, z_buffer = 0, tracer = 0, depths = 0;
  const Scene scene = local_only(lit);
  for (const std::string& text : tier_list("exact_picture_sizes"))
    for (const CameraSettings& settings : {straight_ahead(), any_way()}) {
      const PictureSize size = parse_size(text);
      const Camera camera = make_camera(settings, size.width, size.height, 1);
      const ExactPicture exact(scene, camera);
      const Frame flat = rastered(scene, camera), deep = traced(scene, camera);
      z_buffer += exact.mismatches(flat);
      tracer += exact.mismatches(deep);
      depths += exact.wrong_depths(flat) + exact.wrong_depths(deep);
      for (int Y = 0; Y < camera.rows(); ++Y)
        for (int X = 0; X < camera.columns(); ++X) {
          ++samples;
          covered += exact.at(X, Y).met > 0;
          exactly_on_edges += exact.at(X, Y).met > exact.at(X, Y).strictly;
        }
    }
  const HardCase hard("RVR-2");
  const std::string of = what + " of " + std::to_string(scene.triangles.size()) + " triangles: ";
  hard.none(of + "samples where the z-buffer shows another surface than 128-bit integers", z_buffer, samples);
  hard.none(of + "samples where the tracer shows another surface than 128-bit integers", tracer, samples);
  hard.none(of + "depths of both beyond the bound of their condition number", depths, 2 * samples);
  hard.at_least(of + "share of samples that meet a triangle",
                static_cast<double>(covered) / static_cast<double>(samples), 0.5);
  hard.at_least(of + "rays exactly through an edge or a vertex", static_cast<double>(exactly_on_edges), 1);
}

}  // namespace

TEST_CASE("RVR-2: both renderers show what 128-bit integers find") {
  check_exact("ten spheres", spheres_on_ground(tier_count("exact_picture_triangles")));
}

TEST_CASE("RVR-2: both renderers show of a scan what 128-bit integers find") {
  const double triangles = std::min(7e4, static_cast<double>(tier_count("exact_picture_triangles")));
  const std::uint32_t rows = rows_for(triangles);
  check_exact("a made scan", scan_on_ground(star_sphere(rows, 2 * rows, 0.02, 7)));
}

TEST_CASE("RVR-2: the same of a scan from a file") {
  const char* file = std::getenv("SIDELIGHT_SCAN");
  if (!file || !*file) {
    HardCase("RVR-2").skipped("a scan from a file", "SIDELIGHT_SCAN names no OBJ file");
    return skip_test("SIDELIGHT_SCAN names no OBJ file");
  }
  PolygonMesh scan = read_obj(file, false).mesh;
  for (PolygonMesh::Face& face : scan.faces) face.material = 0;
  check_exact(std::filesystem::path(file).filename().string(), scan_on_ground(scan));
}

// One edge of each triangle runs exactly through a sample's ray, or 2^-20 beside it: its ends are s d + t w and
// s' d - t' w for that ray's d and any w. Their products have some 70 bits, so double alone sees a sign of rounding.
TEST_CASE("RVR-2: edges exactly through rays and 2^-20 beside them") {
  const Camera camera = plain_camera(64, 48);
  Random random(202);
  std::uint64_t samples = 0, z_buffer = 0, tracer = 0, exactly_on_edges = 0;
  const auto dyadic = [&](double low, double high) {
    return std::round(random.uniform(low, high) * 1024) / 1024;
  };
  for (std::uint64_t left = 2 + tier_count("rays_per_case") / 20'000; left > 0; --left) {
    std::vector<glm::dvec3> positions;
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < 200; ++i) {
      const glm::dvec3 d =
          camera.direction(static_cast<int>(random.below(64)), static_cast<int>(random.below(48)));
      const glm::dvec3 w = 0x1p-10 * random.on_grid(1 << 17), c = 0x1p-10 * random.on_grid(1 << 17);
      glm::dvec3 a = dyadic(1, 40) * d + dyadic(0.1, 9) * w, b = dyadic(1, 40) * d - dyadic(0.1, 9) * w;
      a[static_cast<int>(random.below(3))] += 0x1p-20 * static_cast<double>(random.integer(1));
      positions.insert(positions.end(), {a, b, dyadic(1, 40) * d + c});
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Scene scene = local_only(scene_of(mesh_of(positions, faces)));
    const ExactPicture exact(scene, camera);
    z_buffer += exact.mismatches(rastered(scene, camera));
    tracer += exact.mismatches(traced(scene, camera));
    for (int Y = 0; Y < camera.rows(); ++Y)
      for (int X = 0; X < camera.columns(); ++X) {
        ++samples;
        exactly_on_edges += exact.at(X, Y).met > exact.at(X, Y).strictly;
      }
  }
  const HardCase hard("RVR-2");
  hard.none("edges through rays: samples where the z-buffer shows another surface", z_buffer, samples);
  hard.none("edges through rays: samples where the tracer shows another surface", tracer, samples);
  hard.at_least("edges through rays: those that are met exactly", static_cast<double>(exactly_on_edges), 10);
}
