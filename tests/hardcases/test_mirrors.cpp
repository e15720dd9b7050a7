// SPDX-License-Identifier: MIT
// Hard cases of mirrors beside those of tests/model: a closed box of mirrors (MIR-3), trees of rays that double at each
// level (MIR-4) and mirrors with interpolated normals (MIR-6).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "common/model/optics.h"
#include "common/scene/shapes.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/support/trees.h"
#include "tests/support/worst.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Calls visit(ray) for the rays of a tree that were sent.
template <class Visit>
void for_each_ray(const RayRecord& root, const Visit& visit) {
  if (!root.sent) return;
  visit(root);
  for (const RayRecord& child : root.children) for_each_ray(child, visit);
}

// ---- MIR-3: a box of mirrors, half edge 1, around a ball and a light ----

Scene mirror_box(double k) {
  Scene scene = empty_scene();
  scene.ambient = glm::dvec3(0.25);
  Material mirror;
  mirror.ambient = glm::dvec3(0.5);
  mirror.reflect = glm::dvec3(k);
  PolygonMesh box = make_box({2, 2, 2});
  for (PolygonMesh::Face& face : box.faces) face.material = 1;
  add_material(scene, mirror);
  add_mesh(scene, box, {}, {});
  add_sphere(scene, {{0.3, -0.4, 0.2}, 0.4, 0}, {});
  scene.materials[0].ambient = glm::dvec3(0.5);
  scene.materials[0].reflect = glm::dvec3(k / 2);  // so that rays go on from it
  scene.lights.push_back(lamp({-0.5, 0.7, 0.1}, 1));
  scene.trace.depth = 100;
  return scene;
}
// ka Ia + kd I: as bright as anything in it can be.
constexpr double kBrightest = 0.5 * 0.25 + 0.5;

// ---- MIR-3: rooms of mirrors, and where their walls meet ----

struct Room {
  std::string name;
  Scene scene;
  std::function<glm::dvec3(Random&)> eye, target;
  std::function<bool(const glm::dvec3&)> contains = [](const glm::dvec3&) { return true; };
};

Scene mirrors_only() {
  Scene scene = empty_scene();
  scene.materials[0].reflect = glm::dvec3(0.99);
  scene.trace.depth = 40;
  return scene;
}

// A point of an edge, every other time its end.
std::function<glm::dvec3(Random&)> on_edges(const PolygonMesh& mesh) {
  return [mesh](Random& random) {
    const auto count = static_cast<std::uint32_t>(mesh.faces.size());
    const PolygonMesh::Face& face = mesh.faces[random.below(count)];
    const std::uint32_t k = random.below(face.count);
    const auto corner = [&](std::uint32_t i) {
      return mesh.positions[mesh.corners[face.first + i % face.count].position];
    };
    const double at = random.uniform() < 0.5 ? 0 : random.uniform();
    return (1 - at) * corner(k) + at * corner(k + 1);
  };
}

Room room_of(std::string name, const PolygonMesh& mesh, double eyes_within) {
  Room room{std::move(name), mirrors_only(), {}, on_edges(mesh)};
  add_mesh(room.scene, mesh, {}, {});
  // On a grid of eighths every other time, so that some rays meet an edge exactly.
  room.eye = [eyes_within](Random& random) {
    const glm::dvec3 eye = random.in_box(eyes_within);
    return random.uniform() < 0.5 ? eye : eyes_within / 8 * glm::floor(8 / eyes_within * eye);
  };
  return room;
}

// A prism between two walls that meet at `angle`, of length 2 and from the edge to x = 1.
PolygonMesh wedge(double angle) {
  const double y = std::tan(angle);
  return mesh_of({{0, 0, -1}, {1, 0, -1}, {1, y, -1}, {0, 0, 1}, {1, 0, 1}, {1, y, 1}},
                 {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}});
}

std::vector<Room> rooms() {
  std::vector<Room> all;
  all.push_back(room_of("a box of mirrors", make_box({2, 2, 2}), 1));
  all.back().scene = mirror_box(0.99);
  all.push_back(room_of("an octahedron", octahedron({0, 0, 0}, 1), 0.3));
  all.push_back(room_of("a far octahedron", octahedron({1e3, 1e3, 1e3}, 1), 0.3));
  all.back().eye = [](Random& random) { return glm::dvec3(1e3) + random.in_box(0.3); };
  all.push_back(room_of("a star", star_sphere(16, 16, 5, 12111), 0.3));
  for (const double angle : {0.5, 0.1}) {
    all.push_back(room_of("a wedge of " + std::to_string(angle) + " rad", wedge(angle), 1));
    all.back().eye = [angle](Random& random) {
      const double x = random.uniform(0.1, 0.9);
      return glm::dvec3(x, x * std::tan(angle * random.uniform(0.2, 0.8)), random.uniform(-0.9, 0.9));
    };
  }

  // The same box, as six planes: unlike triangles, they are met in double.
  Room planes = room_of("six planes", make_box({2, 2, 2}), 1);
  planes.scene = mirrors_only();
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 point(0);
      point[axis] = side;
      add_plane(planes.scene, {point, -point, 0}, {});
    }
  all.push_back(planes);

  // A ball with a floor, and one with a box that stands in it: walls that cross where neither has an edge.
  Room ball{"a ball with a floor", mirrors_only(), {}, {}};
  add_sphere(ball.scene, {{0, 0, 0}, 1, 0}, {});
  add_plane(ball.scene, {{0, -0.5, 0}, {0, 1, 0}, 0}, {});
  ball.eye = [](Random& random) { return random.in_box(0.45); };
  ball.target = [](Random& random) {
    const double phi = random.uniform(0, 6.3), r = std::sqrt(0.75);
    return glm::dvec3(r * std::cos(phi), -0.5, r * std::sin(phi));
  };
  ball.contains = [](const glm::dvec3& p) { return p.y > -0.5 && glm::dot(p, p) < 1; };
  all.push_back(ball);
  Room pillar = ball;
  pillar.name = "a ball with a floor that is a block";
  pillar.scene = mirrors_only();
  add_sphere(pillar.scene, {{0, 0, 0}, 1, 0}, {});
  PolygonMesh block = make_box({4, 1, 4});
  for (glm::dvec3& p : block.positions) p.y -= 1;
  add_mesh(pillar.scene, block, {}, {});
  all.push_back(pillar);
  return all;
}

// ---- MIR-4: balls within balls, each a mirror to one half and glass to the other ----

// Denser inwards: no ray that came from outside is reflected totally, since index times distance from the centre, which
// a ray keeps, was small enough for it to come in. All light is that of the background: 1.
Scene onion(int shells, int depth, double cut) {
  Scene scene = empty_scene();
  scene.background = glm::dvec3(1);
  for (int i = 0; i < shells; ++i) {
    Material half;
    half.local = glm::dvec3(0);
    half.reflect = half.refract = glm::dvec3(0.5);
    half.ior = 1.05 + 0.05 * i;
    add_sphere(scene, {{0, 0, 0}, 1 - 0.04 * i, add_material(scene, half)}, {});
  }
  scene.camera.eye = {0, 0, 3};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.view_height = 0.6;
  scene.trace.depth = depth;
  scene.trace.contribution_cut = cut;
  return scene;
}

// ---- MIR-6: an icosahedron cut once, with the normals of its sphere ----

Scene smooth_icosphere() {
  const double phi = (1 + std::sqrt(5.0)) / 2;
  std::vector<glm::dvec3> positions;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-phi, phi})
      for (const glm::dvec3& p : {glm::dvec3(0, a, b), glm::dvec3(a, b, 0), glm::dvec3(b, 0, a)})
        positions.push_back(glm::normalize(p));
  // Corners are neighbours where they are nearest: 1.05 apart.
  const auto near_each_other = [&](std::uint32_t i, std::uint32_t j) {
    return glm::length(positions[i] - positions[j]) < 1.1;
  };
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = i + 1; j < 12; ++j)
      for (std::uint32_t k = j + 1; k < 12; ++k)
        if (near_each_other(i, j) && near_each_other(j, k) && near_each_other(k, i)) {
          const bool outward = glm::dot(positions[i], glm::cross(positions[j], positions[k])) > 0;
          faces.push_back(outward ? Face{i, j, k} : Face{i, k, j});
        }
  REQUIRE(faces.size() == 20);
  std::vector<Face> cut;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t i, std::uint32_t j) {
    const auto [at, added] =
        middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(positions.size()));
    if (added) positions.push_back(glm::normalize(positions[i] + positions[j]));
    return at->second;
  };
  for (const auto& [a, b, c] : faces) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Face& face : {Face{a, ab, ca}, Face{b, bc, ab}, Face{c, ca, bc}, Face{ab, bc, ca}})
      cut.push_back(face);
  }
  PolygonMesh mesh = mesh_of(positions, cut);
  mesh.normals = positions;
  for (PolygonMesh::Corner& corner : mesh.corners) corner.normal = corner.position;
  Scene scene = empty_scene();
  scene.materials[0].reflect = glm::dvec3(0.9);
  scene.trace.depth = 2;
  add_mesh(scene, mesh, {}, {});
  return scene;
}

}  // namespace

TEST_CASE("MIR-3: no ray escapes from a closed box of mirrors, and none brings back more than a series") {
  Random random(91);
  std::uint64_t escaped = 0, rays = 0, over = 0, trees = 0;
  for (const double k : {0.5, 0.99}) {
    const Scene scene = mirror_box(k);
    const raytrace::Prepared prepared(scene);
    for (std::uint64_t left = 1 + tier_count("rays_per_case") / 200; left > 0; --left) {
      const RayRecord root = tree_of(prepared, random.in_box(1), random.in_box(1));
      for_each_ray(root, [&](const RayRecord& ray) {
        ++rays;
        escaped += ray.background;
      });
      over += !(root.color.x <= kBrightest / (1 - k));
      ++trees;
    }
  }
  const HardCase box("MIR-3");
  box.none("rays that escape from a closed box", escaped, rays);
  box.none("colours above the brightest local light over 1 - k", over, trees);
}

// Chains of mirrors in closed rooms, aimed at where the walls meet. Not one ray of them may start or see outside.
TEST_CASE("MIR-3: no ray escapes through the edges and corners of a closed room at which it is aimed") {
  const HardCase corners("MIR-3");
  const auto closed = [&](const Room& room) {
    CAPTURE(room.name);
    const raytrace::Prepared prepared(room.scene);
    Random random(92);
    std::uint64_t escaped = 0, rays = 0;
    for (std::uint64_t left = 1 + tier_count("rays_per_case") / 1000; left > 0; --left) {
      const glm::dvec3 eye = room.eye(random);
      for_each_ray(tree_of(prepared, eye, room.target(random)), [&](const RayRecord& ray) {
        ++rays;
        escaped += ray.background || !room.contains(ray.origin);
      });
    }
    corners.none("rays that escape from " + room.name + " through edges and corners", escaped, rays);
  };
  for (const Room& room : rooms()) closed(room);
}

TEST_CASE("MIR-4: rays double at each level, and what is cut off is what is missing") {
  const HardCase doubling("MIR-4");
  const int edge = std::min(32, tier_edge() / 40);
  // Without a cut: depth D, at most 2^D - 1 rays a pixel.
  constexpr int kDepth = 10;
  const Scene whole = onion(20, kDepth, 0);
  const Frame all = testing::traced(whole, make_camera(whole.camera, edge, edge, 1));
  const auto secondary = [](const Frame& frame) {
    return frame.stats.rays.reflection + frame.stats.rays.refraction;
  };
  const auto pixels = static_cast<double>(all.pixels());
  doubling.at_most("rays a pixel at depth 10", 1 + static_cast<double>(secondary(all)) / pixels,
                   (1 << kDepth) - 1);
  CHECK(static_cast<double>(secondary(all)) / pixels > 1 << (kDepth - 3));  // and they do double

  // What a picture lacks of the background's 1 is the weight of the rays that were not sent, by depth or by cut. Sums of
  // floats: up to 20 levels of a product and a sum, 2^-24 each.
  Worst lacking, levels_over;
  const auto add_lack = [&](const Frame& frame) {
    double sum = 0;
    for (const glm::vec3& c : frame.color) sum += c.x;
    lacking.add(std::abs(sum / pixels + frame.stats.cut_weight - 1));
  };
  add_lack(all);
  for (const double cut : {1e-2, 1e-3}) {
    const Scene scene = onion(20, 20, cut);
    add_lack(testing::traced(scene, make_camera(scene.camera, edge, edge, 1)));
    // 0.5^levels >= cut
    const auto prepared = raytrace::Prepared(scene);
    const double most = std::floor(std::log(cut) / std::log(0.5));
    for_each_ray(tree_of(prepared, scene.camera.eye, {0.2, 0.3, 0}),
                 [&](const RayRecord& ray) { levels_over.add(ray.depth - 1 - most); });
  }
  doubling.at_most("what a picture lacks, off the weight of rays not sent", lacking, 20 * 2 * 0x1p-24);
  doubling.at_most("levels beyond log(cut)/log(weight)", levels_over, 0);
}

// At random and at the outline, where interpolated normals send rays below the facet.
TEST_CASE("MIR-6: no mirror ray of a smooth-shaded icosphere starts below its facet") {
  const Scene scene = smooth_icosphere();
  const raytrace::Prepared prepared(scene);
  Random random(97);
  std::uint64_t below = 0, again = 0, folded = 0, mirrored = 0;
  for (std::uint64_t left = tier_count("rays_per_case") / 2; left > 0; --left) {
    const glm::dvec3 eye = 4.0 * random.direction();
    const glm::dvec3 target = (left % 2 ? random.uniform(0.9, 1) : random.uniform()) * across(eye, random);
    const RayRecord root = tree_of(prepared, eye, target);
    if (root.background || !root.local.surface.entering) continue;
    const Surface& surface = root.local.surface;
    const RayRecord& child = root.children.at(0);
    const glm::dvec3 d = glm::normalize(root.direction);
    folded += glm::dot(d - 2 * glm::dot(d, surface.normal) * surface.normal, surface.facing) < 0;
    ++mirrored;
    below += !(glm::dot(child.direction, surface.facing) > 0);
    again += !child.background;  // the body is convex
  }
  const HardCase smooth("MIR-6");
  smooth.none("mirror rays of a smooth-shaded icosphere that start below their facet", below, mirrored);
  smooth.none("mirror rays that meet the convex body again", again, mirrored);
  CHECK(folded > mirrored / 1000);
}

// Across the fold R.Nv changes its sign, and its magnitude is kept: what the fold returns moves no farther than what it
// is given.
TEST_CASE("MIR-6: the fold is continuous") {
  Random random(101);
  std::uint64_t jumps = 0, across_fold = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 nv = random.direction();
    glm::dvec3 d = random.direction(), n = random.direction();
    if (glm::dot(d, nv) > 0) d = -d;
    if (glm::dot(n, nv) < 0) n = -n;
    const glm::dvec3 other = glm::normalize(n + 0.03 * random.direction());
    const auto plain = [&](const glm::dvec3& m) { return d - 2 * glm::dot(d, m) * m; };
    if (glm::dot(plain(n), nv) * glm::dot(plain(other), nv) > 0) continue;
    ++across_fold;
    const double jump = glm::length(reflect_direction(d, n, nv) - reflect_direction(d, other, nv));
    jumps += !(jump <= 2 * glm::length(plain(n) - plain(other)));
  }
  HardCase("MIR-6").none("jumps at the fold over twice those without it", jumps, across_fold);
}
