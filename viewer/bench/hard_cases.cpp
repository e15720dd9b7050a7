// SPDX-License-Identifier: MIT
#include "viewer/bench/hard_cases.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/scene/build.h"
#include "common/scene/shapes.h"

namespace sidelight {
namespace {

// The i-th of numbers in [-1, 1] that fill it evenly, another such sequence for each k: Kronecker's, with the square
// roots of primes for steps.
double spread(int i, int k) {
  constexpr std::array<double, 9> kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23};
  const double at = (i + 1) * std::sqrt(kPrimes[static_cast<std::size_t>(k)]);
  return 2 * (at - std::floor(at)) - 1;
}
glm::dvec3 spread_point(int i, int k, double half_edge) {
  return half_edge * glm::dvec3(spread(i, k), spread(i, k + 1), spread(i, k + 2));
}

void add_triangle(Scene& scene, const std::array<glm::dvec3, 3>& vertices) {
  PolygonMesh mesh;
  mesh.positions.assign(vertices.begin(), vertices.end());
  mesh.corners = {{0, kNone}, {1, kNone}, {2, kNone}};
  PolygonMesh::Face face;
  face.count = 3;
  mesh.faces = {face};
  add_mesh(scene, mesh, {}, {});
}

Transform at(const glm::dvec3& p) {
  Transform transform;
  transform.translate = p;
  return transform;
}

// Seen from within: walls all around, boxes on the floor, a ball on one of them.
Scene room() {
  Scene scene = lit_scene({0, 0, 0.99}, {0, -0.1, 0});
  scene.camera.view_height = 1.6;
  add_mesh(scene, make_box({2, 2, 2}), {}, {});
  add_mesh(scene, make_box({0.6, 1.2, 0.6}), at({-0.4, -0.4, -0.4}), {});
  add_mesh(scene, make_box({0.6, 0.6, 0.6}), at({0.4, -0.7, 0.1}), {});
  add_sphere(scene, {{0.4, -0.15, 0.1}, 0.25, 0}, {});
  return scene;
}

// Thin as a millionth of their length, or a thousandth.
Scene needles() {
  Scene scene = lit_scene({0, 0, 4}, {0, 0, 0});
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 from = spread_point(i, 0, 2), along = glm::normalize(spread_point(i, 3, 1));
    const double width = std::pow(10.0, 2 * spread(i, 6) - 4);
    add_triangle(scene, {from, from + 4.0 * along,
                         from + 2.0 * along + width * glm::normalize(spread_point(i, 5, 1))});
  }
  return scene;
}

// A float has steps of 1/128 there.
Scene far_away() {
  const glm::dvec3 middle(1e5);
  Scene scene = lit_scene(middle + glm::dvec3(0, 0, 4), middle);
  add_mesh(scene, make_torus(1, 0.4, 40, 20), at(middle), {});
  add_mesh(scene, make_box({0.9, 0.9, 0.9}), at(middle + glm::dvec3(-0.6, 0.7, 0.3)), {});
  add_sphere(scene, {middle + glm::dvec3(0.7, 0, 0.9), 0.5, 0}, {});
  add_plane(scene, {middle - glm::dvec3(0, 1.2, 0), glm::normalize(glm::dvec3(0.1, 1, 0.2)), 0}, {});
  return scene;
}

// With a vertex in the plane through the eye that is square to the view, and others before and behind it.
Scene around_the_eye() {
  Scene scene = lit_scene({0, 0, 0}, {0, 0, -1});
  for (int i = 0; i < 40; ++i)
    add_triangle(scene, {spread_point(i, 0, 5), spread_point(i, 3, 5),
                         glm::dvec3(5 * spread(i, 6), 5 * spread(i, 7), 0)});
  return scene;
}

// Sheets behind one another, the farther first, by a gap of 3e-7 to 1e-3 of their distance: 2/1000 to 700 units away, no
// two pairs at one distance.
Scene layers() {
  Scene scene = lit_scene({0, 0, 0}, {0, 0, -1});
  int i = 0;
  for (const double gap : {3e-7, 1e-5, 1e-3})
    for (const double about : {2e-3, 1.0, 500.0}) {
      const double z = (1 + 0.05 * i) * about, r = 0.2 * z;
      const glm::dvec3 to = 0.4 * z * glm::dvec3(spread(i, 0), spread(i, 1), 0);
      ++i;
      for (const double depth : {z * (1 + gap), z})
        add_triangle(scene, {to + glm::dvec3(-r, -r, -depth), to + glm::dvec3(r, -r, -depth),
                             to + glm::dvec3(0, r, -depth)});
    }
  return scene;
}

// On one as large as a planet.
Scene balls() {
  Scene scene = lit_scene({0, 0, 5}, {0, 0, 0});
  for (int i = 0; i < 30; ++i)
    add_sphere(scene, {spread_point(i, 0, 1.5), 0.65 + 0.35 * spread(i, 3), 0}, {});
  add_sphere(scene, {{0, -1e6, 0}, 1e6 - 1, 0}, {});
  return scene;
}

}  // namespace

Scene lit_scene(const glm::dvec3& eye, const glm::dvec3& look_at) {
  Scene scene;
  Material grey;
  grey.name = "grey";
  grey.diffuse = glm::dvec3(0.5);
  grey.specular = glm::dvec3(0.25);
  grey.shininess = 30;
  add_material(scene, grey);
  Light light;
  light.position = eye + glm::dvec3(1, 2, 0.5);
  light.intensity = glm::dvec3(1);
  scene.lights = {light};
  scene.camera.eye = eye;
  scene.camera.look_at = look_at;
  return scene;
}

std::vector<HardScene> hard_scenes() {
  return {{"room", room()},
          {"needles", needles()},
          {"far from the origin", far_away()},
          {"triangles around the eye", around_the_eye()},
          {"layers a hair apart", layers()},
          {"balls in balls", balls()}};
}

HardCases::HardCases(std::atomic<bool>* cancel) {
  for (HardScene& hard : hard_scenes()) {
    hard.scene.width = kHardWidth;
    hard.scene.height = kHardHeight;
    cases_.push_back(std::make_unique<Case>(std::move(hard.name), std::move(hard.scene), cancel));
  }
}

std::string HardCases::failures(const Setting& setting) {
  Setting eye_rays = setting;
  eye_rays.n = 1;
  eye_rays.depth = 1;
  std::string out;
  for (const std::unique_ptr<Case>& each : cases_) {
    const Frame frame = each->stage.render(eye_rays, true);
    const std::uint64_t wrong = each->judge.compare(eye_rays, frame).mismatches;
    if (wrong > 0) out += fmt::format("{} {} {}", out.empty() ? "hard cases:" : ",", each->name, wrong);
  }
  return out;
}

}  // namespace sidelight
