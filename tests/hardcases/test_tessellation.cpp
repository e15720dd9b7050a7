// SPDX-License-Identifier: MIT
// A sphere against its tessellations (MET-12, RVR-4): what triangles cost in truth, and how that falls with their size.
#include <map>

#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// A subdivided icosahedron: 20 * 4^level triangles, all vertices on the unit sphere.
PolygonMesh icosphere(int level) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<glm::dvec3> positions{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                    {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                    {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  for (glm::dvec3& p : positions) p = glm::normalize(p);
  std::vector<Face> faces{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                          {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                          {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (; level > 0; --level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(positions.size()));
      if (is_new) positions.push_back(glm::normalize(positions[a] + positions[b]));
      return at->second;
    };
    std::vector<Face> finer;
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = finer;
  }
  return mesh_of(positions, faces);
}

Scene ball(int level) {  // level < 0: the sphere itself
  Scene scene = empty_scene();
  if (level < 0) {
    add_sphere(scene, {{0, 0, 0}, 1, 0}, {});
  } else {
    PolygonMesh mesh = icosphere(level);
    mesh.normals = mesh.positions;
    for (PolygonMesh::Corner& corner : mesh.corners) corner.normal = corner.position;
    add_mesh(scene, mesh, {}, {});
  }
  Light light;
  light.directional = true;
  light.direction = glm::normalize(glm::dvec3(-0.4, -0.3, -1));
  light.intensity = glm::dvec3(1);
  scene.lights = {light};
  scene.camera.eye = {0.3, 0.4, 4};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.view_height = 0.6;
  return local_only(scene);
}

struct ModelError {
  double depth = 0, color = 0;  // greatest, where the sphere's normal is less than 37 degrees from the z axis
  std::uint64_t silhouette = 0;  // pixels covered by one of them only
};

ModelError model_error(const Frame& sphere, const Frame& mesh) {
  ModelError error;
  for (std::size_t i = 0; i < sphere.pixels(); ++i) {
    error.silhouette += (sphere.object_id[i] != 0) != (mesh.object_id[i] != 0);
    if (sphere.object_id[i] == 0 || mesh.object_id[i] == 0 || sphere.normal[i].z < 0.8f) continue;
    error.depth = std::max(error.depth, std::abs(double{sphere.depth[i]} - double{mesh.depth[i]}));
    error.color = std::max(error.color, std::abs(double{sphere.color[i].x} - double{mesh.color[i].x}));
  }
  return error;
}

}  // namespace

TEST_CASE("MET-12: a sphere and its tessellations, four times finer at each level") {
  const Camera camera = make_camera(ball(-1).camera, 301, 301, 1);
  const Frame flat = rastered(ball(-1), camera), deep = traced(ball(-1), camera);
  constexpr int kFirst = 2, kLast = 6;
  std::vector<ModelError> errors;
  std::uint64_t unlike = 0;
  for (int level = kFirst; level <= kLast; ++level) {
    const Scene scene = ball(level);
    const Frame mesh = rastered(scene, camera);
    errors.push_back(model_error(flat, mesh));
    const ModelError traced_error = model_error(deep, traced(scene, camera));
    unlike += traced_error.depth != errors.back().depth || traced_error.color != errors.back().color;
  }
  const auto slope = [&](double ModelError::*what) {
    return std::log2(errors.back().*what / (errors.front().*what)) / (kLast - kFirst);
  };
  const HardCase hard("MET-12");
  hard.at_most("slope of the greatest depth error, per doubling of edges", slope(&ModelError::depth), -1.8);
  hard.at_least("the same slope", slope(&ModelError::depth), -2.2);
  hard.none("levels at which z-buffer and tracer err differently", unlike, errors.size());

  // RVR-4. At level L an edge spans N = 5 2^L parts of a great circle (63.4 degrees are 1/5.7 of it): the silhouette is
  // at most 1 - cos(pi/N) inside, a ring of that width around a disc of R pixels, and as much again for pixels that
  // the ring cuts: 2 pi R (R (1 - cos) + 1/2).
  const HardCase visibility("RVR-4");
  const double radius = 301 / (4.0 * 0.6) * 1.05;
  double worst = 0;
  for (int level = kFirst; level <= kLast; ++level) {
    const double n = 5 * std::exp2(level);
    const double ring = 2 * std::numbers::pi * radius * (radius * (1 - std::cos(std::numbers::pi / n)) + 0.5);
    worst = std::max(worst,
                     static_cast<double>(errors[static_cast<std::size_t>(level - kFirst)].silhouette) / ring);
  }
  visibility.at_most("pixels of the silhouette, in units of a ring of 1 - cos(pi/N)", worst, 1);
  visibility.at_most("slope of the greatest colour error, per level", slope(&ModelError::color), -1.8);
  visibility.at_least("the same slope", slope(&ModelError::color), -2.2);
}
