// SPDX-License-Identifier: MIT
// Hard cases of closed rooms whose walls are mirrors (MIR-3): at random, and aimed at where the walls meet.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "common/scene/shapes.h"
#include "tests/hardcases/result.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/support/trees.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// ---- A box of mirrors, half edge 1, around a ball and a light ----

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

// ---- Rooms of mirrors, and where their walls meet ----

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

}  // namespace

TEST_CASE("MIR-3: no ray escapes from a closed box of mirrors, and none brings back more than a series") {
  Random random(91);
  std::uint64_t escaped = 0, rays = 0, over = 0, trees = 0;
  for (const double k : {0.5, 0.99}) {
    const Scene scene = mirror_box(k);
    const raytrace::Prepared prepared(scene);
    for (std::uint64_t left = 1 + tier_count("rays_per_gate") / 200; left > 0; --left) {
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
    for (std::uint64_t left = 1 + tier_count("rays_per_gate") / 1000; left > 0; --left) {
      const glm::dvec3 eye = room.eye(random), target = room.target(random);
      if (eye == target) continue;   // both in one corner: no ray
      for_each_ray(tree_of(prepared, eye, target), [&](const RayRecord& ray) {
        ++rays;
        escaped += ray.background || !room.contains(ray.origin);
      });
    }
    corners.none("rays that escape from " + room.name + " through edges and corners", escaped, rays);
  };
  for (const Room& room : rooms()) closed(room);
}
