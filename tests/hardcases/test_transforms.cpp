// SPDX-License-Identifier: MIT
// Transforms of meshes: normals of a squashed sphere (XFM-1) and mirror images (XFM-3). That a single normal stays
// square to the surface: tests/scene/test_build.cpp.
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

PolygonMesh smooth(PolygonMesh mesh) {
  mesh.normals = mesh.positions;
  for (PolygonMesh::Corner& corner : mesh.corners) corner.normal = corner.position;
  return mesh;
}

// The greatest angle between the normal that is shown and that of the ellipsoid M (unit sphere) on the same ray, away
// from its silhouette. On the sphere's side of M the ray is M^-1 o + t M^-1 d, the normal at p is M^-T p.
double worst_angle(const glm::dmat3& m, std::uint32_t rows) {
  Scene scene = empty_scene();
  Transform transform;
  transform.linear = m;
  add_mesh(scene, smooth(star_sphere(rows, 2 * rows, 0, 1)), transform, {});
  scene.camera.eye =
      6.0 * glm::normalize(glm::transpose(glm::inverse(m)) * glm::dvec3(0.5, 0.4, 0.7));  // broadside
  scene.camera.look_at = {0, 0, 0};
  scene.camera.view_height = 0.5;
  const Camera camera = make_camera(scene.camera, 60, 60, 1);
  const Frame frame = rastered(scene, camera, keeping(kVisibilityLayers));
  const glm::dmat3 inverse = glm::inverse(m);
  double worst = 0;
  int looked_at = 0;
  for (int Y = 0; Y < 60; ++Y)
    for (int X = 0; X < 60; ++X) {
      const glm::dvec3 o = inverse * camera.eye, d = inverse * camera.direction(X, Y);
      const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1;
      if (b * b - a * c < 0.3 * a || frame.object_id[frame.index(X, Y)] == 0) continue;
      const glm::dvec3 p = o + (-b - std::sqrt(b * b - a * c)) / a * d;
      const glm::dvec3 normal = glm::normalize(glm::transpose(inverse) * p);
      const glm::dvec3 shown(frame.normal[frame.index(X, Y)]);
      worst = std::max(worst, glm::length(glm::cross(normal, shown)));
      ++looked_at;
    }
  REQUIRE(looked_at > 20);
  return worst;
}

// Not a mirror image of itself, with a smooth and a flat part.
Scene asymmetric(bool mirrored) {
  Scene scene;
  Material material;
  material.diffuse = {0.5, 0.25, 0.75};
  material.specular = glm::dvec3(0.25);
  material.shininess = 4;
  add_material(scene, material);
  Transform transform;
  if (mirrored) transform.linear = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  add_mesh(scene, smooth(star_sphere(16, 22, 0.4, 13)), transform, {});
  add_mesh(scene, mesh_of({{1, -1.5, 1}, {2.5, -1, 0}, {2, 1.5, -1}, {0.5, 1, 0.5}}, {{0, 1, 2}, {0, 2, 3}}),
           transform, {});
  const double side = mirrored ? -1 : 1;
  Light light;
  light.position = {side * 2, 3, 4};
  light.intensity = glm::dvec3(1);
  scene.lights = {light};
  scene.camera.eye = {side * 0.75, 0.5, 5};
  scene.camera.look_at = {side * 0.25, 0, 0};
  return scene;
}

}  // namespace

TEST_CASE("XFM-1: a squashed, sheared and turned sphere has an ellipsoid's normals up to its tessellation") {
  const glm::dmat3 shear(1, 0, 0, 0.5, 1, 0, 0, 0, 1);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const glm::dmat3 turn(c, 0, -s, 0, 1, 0, s, 0, c);
  double least_gain = INFINITY, worst_fine = 0;
  for (const double stretch : {1e-3, 0.1, 1.0, 10.0, 1e3}) {
    const glm::dmat3 m = turn * shear * glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, stretch);
    double coarse = worst_angle(m, 12);
    for (const std::uint32_t rows : {24u, 48u, 96u}) {
      const double fine = worst_angle(m, rows);
      least_gain = std::min(least_gain, coarse / fine);
      coarse = fine;
    }
    worst_fine = std::max(worst_fine, coarse);
  }
  const HardCase hard("XFM-1");
  hard.at_least("factor by which the greatest error of normals falls with each level", least_gain, 2);
  MESSAGE("greatest error at the finest level: " << worst_fine << " rad");
}

// A camera mirrored with the scene sees the flipped picture: right turns into left exactly, as all that mirrors is the
// sign of x. Only the order of a triangle's vertices is another, and with it the last bit of a colour.
TEST_CASE("XFM-3: a mirror image is the flipped picture of the mirrored camera") {
  const int width = 97, height = 73;
  const Scene plain = asymmetric(false), mirrored = asymmetric(true);
  const Camera left = make_camera(plain.camera, width, height, 1),
               right = make_camera(mirrored.camera, width, height, 1);
  std::uint64_t unlike = 0, pixels = 0, covered = 0, unflipped = 0;
  double worst = 0;
  for (const auto& [a, b] : {std::pair(rastered(plain, left), rastered(mirrored, right)),
                             std::pair(traced(plain, left), traced(mirrored, right))})
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::size_t i = a.index(x, y), j = b.index(width - 1 - x, y);
        ++pixels;
        covered += a.object_id[i] != 0;
        unlike += a.sample_primitive[i] != b.sample_primitive[j] || a.depth[i] != b.depth[j];
        unflipped += a.object_id[i] != b.object_id[i];
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(double{a.color[i][c]} - double{b.color[j][c]}));
      }
  REQUIRE(covered > 500);
  REQUIRE(unflipped > 100);  // or there was nothing to flip
  const HardCase hard("XFM-3");
  hard.none("pixels whose surface or float depth is not that of the flipped picture", unlike, pixels);
  // N, L and V are equal to the last bit of float but one: the kernel's error (24 s + 24) 2^-24 once for each picture.
  hard.at_most("difference of colours in units of (48 s + 48) 2^-24", worst / ((48 * 4 + 48) * 0x1p-24), 1);
}
