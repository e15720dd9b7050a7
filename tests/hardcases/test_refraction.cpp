// SPDX-License-Identifier: MIT
// Hard cases of refraction beside those of tests/model: invisible glass (REF-2), interfaces that coincide (REF-4) and
// absurd indices (REF-8). Those inside glass are in test_inside_glass.cpp.
#include <doctest/doctest.h>

#include <cmath>

#include "common/model/optics.h"
#include "common/scene/shapes.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/scene/toml_text.h"
#include "tests/support/approx.h"
#include "tests/support/lit.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/support/worst.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Squares of two materials on y = -1, from -8 to 8.
void add_checkers(Scene& scene) {
  Material dark;
  dark.diffuse = glm::dvec3(0.05);
  const std::uint32_t black = add_material(scene, dark);
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  for (int x = -8; x < 8; ++x)
    for (int z = -8; z < 8; ++z) {
      const auto first = static_cast<std::uint32_t>(positions.size());
      for (const glm::dvec3& p : {glm::dvec3(x, -1, z), glm::dvec3(x, -1, z + 1),
                                  glm::dvec3(x + 1, -1, z + 1), glm::dvec3(x + 1, -1, z)})
        positions.push_back(p);
      faces.push_back({first, first + 1, first + 2});
      faces.push_back({first, first + 2, first + 3});
    }
  PolygonMesh mesh = mesh_of(positions, faces);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    if ((i / 2 + i / 32) % 2 == 1) mesh.faces[i].material = black;
  add_mesh(scene, mesh, {}, {});
}

// ---- REF-4 ----

// Glass around a cavity around water, last; the other objects before or after them. Smooth surroundings, so that a
// ray that is bent a little otherwise comes back with a little other colour.
enum class Order { others_first, others_last };
Scene drink(double cavity, double water, Order order) {
  Scene scene = empty_scene();
  scene.background = {0.3, 0.4, 0.5};
  scene.ambient = glm::dvec3(0.2);
  scene.materials[0].ambient = glm::dvec3(1);
  const std::uint32_t glass = add_material(scene, clear(1.5)), air = add_material(scene, clear(1)),
                      wet = add_material(scene, clear(1.33));
  const auto add_others = [&] { add_plane(scene, {{0, -1.2, 0}, {0, 1, 0}, 0}, {}); };
  if (order == Order::others_first) add_others();
  add_sphere(scene, {{0, 0, 0}, 1, glass}, {});
  if (cavity > 0) add_sphere(scene, {{0, 0, 0}, cavity, air}, {});
  add_sphere(scene, {{0, 0, 0}, water, wet}, {});
  if (order == Order::others_last) add_others();
  scene.lights.push_back(lamp({2, 5, 3}, 1));
  scene.camera.eye = {0, 1, 4};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.view_height = 0.6;
  scene.trace.depth = 20;
  return scene;
}
// The same with meshes of the same vertices for cavity and water.
Scene faceted_drink(Order order) {
  Scene scene = drink(0, 1e-3, order);
  Scene out = scene;
  PolygonMesh mesh = star_sphere(16, 16, 0, 1);
  for (glm::dvec3& p : mesh.positions) p *= 0.9;
  for (const std::uint32_t material : {2u, 3u}) {
    for (PolygonMesh::Face& face : mesh.faces) face.material = material;
    add_mesh(out, mesh, {}, {});
  }
  return out;
}

Camera camera_at(const Scene& scene) {
  return square_camera(scene, tier() == "long" ? 256 : std::min(tier_edge() / 3, 160));
}

struct Apart {
  double mean = 0;        // of the absolute differences over that of the colours
  double share_over = 0;  // of pixels that differ by more than 5 %
};
Apart apart(const Scene& a, const Scene& b) {
  const Frame p = test::traced(a, camera_at(a)), q = test::traced(b, camera_at(b));
  double difference = 0, sum = 0;
  std::uint64_t over = 0;
  for (std::size_t i = 0; i < p.pixels(); ++i) {
    const double off = std::abs(double{p.color[i].y} - double{q.color[i].y});
    difference += off;
    sum += p.color[i].y;
    over += !(off <= 0.05 * std::max(p.color[i].y, q.color[i].y));
  }
  return {difference / sum, static_cast<double>(over) / static_cast<double>(p.pixels())};
}

}  // namespace

TEST_CASE("REF-2: glass of index 1 is not seen, before checkers and mirrors") {
  Scene without = empty_scene();
  without.background = {0.1, 0.2, 0.3};
  without.trace.depth = 24;
  without.lights.push_back(lamp({2, 5, 3}, 1));
  add_checkers(without);
  Material mirror;
  mirror.reflect = glm::dvec3(0.8);
  add_sphere(without, {{1.5, 0, -2}, 1, add_material(without, mirror)}, {});
  without.camera.eye = {0, 2, 6};
  without.camera.look_at = {0, -0.3, 0};
  Scene with = without;
  const std::uint32_t nothing = add_material(with, clear(1));
  PolygonMesh box = make_box({1, 1, 1}), star = star_sphere(12, 12, 0.3, 3);
  for (PolygonMesh* mesh : {&box, &star})
    for (PolygonMesh::Face& face : mesh->faces) face.material = nothing;
  add_sphere(with, {{-1, 0, 1}, 0.8, nothing}, {});
  add_mesh(with, box, {.translate = {0.2, -0.3, 2}}, {});
  add_mesh(with, star, {.translate = {1.2, 0.2, 1}}, {});
  const Frame a = test::traced(without, square_camera(without)), b = test::traced(with, square_camera(with));
  Worst error;
  std::uint64_t over = 0, through = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    const double off = std::abs(double{a.color[i].x} - double{b.color[i].x});
    error.add(off);
    over += !(off <= 1e-6);
    through += b.sample_primitive[i] != a.sample_primitive[i];
  }
  CHECK(through > a.pixels() / 20);
  const HardCase invisible("REF-2");
  invisible.at_most("greatest difference of a pixel with and without glass of index 1", error, 1e-5);
  invisible.at_most("share of pixels that differ by more than 1e-6",
                    static_cast<double>(over) / static_cast<double>(a.pixels()), 1e-3);
}

// Policy: of solids that contain a point the last in the file is the medium, and surfaces at one depth are crossed
// together. So a cavity filled to the brim is glass against water, as where the water overlaps the glass.
// A gap is another matter: its film of air reflects all light beyond the critical angle of glass and air (42 degrees;
// of glass and water 62), however thin it is, so the catalogue's limit "gap to 0 is the overlap" holds for waves and
// not for rays. For rays the limit is that the film's thickness ceases to matter.
TEST_CASE("REF-4: glass that touches water, overlaps it, and leaves a gap") {
  const HardCase nested("REF-4");
  const Scene touching = drink(0.9, 0.9, Order::others_first);
  const Apart overlap = apart(touching, drink(0.9, 0.901, Order::others_first));
  nested.at_most("share of pixels over 5 % apart, touching against overlapping by 1e-3", overlap.share_over,
                 1e-3);
  nested.at_most("mean difference, touching against overlapping by 1e-3", overlap.mean, 0.01);
  // A hundredth of that overlap changes a hundredth.
  const Apart barely = apart(touching, drink(0.9, 0.9 + 1e-5, Order::others_first));
  nested.at_most("share of pixels over 5 % apart, touching against overlapping by 1e-5", barely.share_over,
                 1e-3);
  nested.at_most("mean difference, touching against overlapping by 1e-5", barely.mean, 1e-4);
  const Apart last_wins = apart(touching, drink(0, 0.9, Order::others_first));
  nested.at_most("mean difference, touching against water that displaces glass", last_wins.mean, 1e-6);
  const Apart thin =
      apart(drink(0.9, 0.9 - 1e-5, Order::others_first), drink(0.9, 0.9 - 1e-4, Order::others_first));
  nested.at_most("mean difference of a film of air 1e-5 thick and one of 1e-4", thin.mean, 0.01);
  const Apart film = apart(touching, drink(0.9, 0.9 - 1e-5, Order::others_first));
  nested.at_least("mean difference that such a film makes", film.mean, 0.02);

  std::uint64_t permuted = 0;
  const auto colors = [](const Scene& scene) { return test::traced(scene, camera_at(scene)).color; };
  permuted += colors(touching) != colors(drink(0.9, 0.9, Order::others_last));
  permuted += colors(faceted_drink(Order::others_first)) != colors(faceted_drink(Order::others_last));
  nested.none("touching pictures that the order of the other objects changes in any bit", permuted, 2);
}

// Between D and T lie i - t, tan i (n - 1) to first order: 1e-7 at 45 degrees, a float's eps.
TEST_CASE("REF-8: absurd indices are refused, and one next to 1 is Snell's law") {
  std::uint64_t accepted = 0, all = 0;
  for (const char* ior : {"0", "-1.5", "nan", "inf", "1e-10", "1e10", "0.2499", "4.001"}) {
    ++all;
    accepted += error_of(std::string("material.x.ior = ") + ior + kCamera).find("ior") == std::string::npos;
  }
  Random random(83);
  Worst against_snell, against_straight;
  constexpr double kIndex = 1 + 1e-7;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 n = random.direction();
    const double sine = random.uniform(0, std::sqrt(0.5));
    const glm::dvec3 d = glm::normalize(sine * across(n, random) - std::sqrt(1 - sine * sine) * n);
    const std::optional<glm::dvec3> t = refract_direction(d, n, n, 1 / kIndex);
    REQUIRE(t);
    const QuadVec tangential = quad(d) - dot(quad(d), quad(n)) * quad(n);
    const Quad eta = 1 / Quad(kIndex);
    const QuadVec snell =
        eta * tangential - square_root(1 - eta * eta * dot(tangential, tangential)) * quad(n);
    against_snell.add(length(quad(*t) - snell) / kEps);
    against_straight.add(glm::length(*t - d) / 0x1p-23);
  }
  const HardCase absurd("REF-8");
  absurd.none("indices outside 0.25 to 4 that are let in", accepted, all);
  absurd.at_most("error of T for n = 1 + 1e-7, in eps", against_snell, 16);
  absurd.at_most("distance of T and D, up to 45 degrees, in float eps", against_straight, 2);
}
