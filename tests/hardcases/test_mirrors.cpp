// SPDX-License-Identifier: MIT
// Hard cases of mirrors beside those of tests/model: trees of rays that double at each level (MIR-4) and mirrors with
// interpolated normals (MIR-6). Rooms of mirrors are in test_rooms_of_mirrors.cpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
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

TEST_CASE("MIR-4: rays double at each level, and what is cut off is what is missing") {
  const HardCase doubling("MIR-4");
  // 32 x 32 pixels where the tier has rays for as many trees of this size, else fewer.
  const auto edge_for = [](double rays) {
    return std::clamp(
        static_cast<int>(std::sqrt(2 * static_cast<double>(tier_count("rays_per_case")) / rays)), 2, 32);
  };
  // Without a cut: depth D, at most 2^D - 1 rays a pixel.
  constexpr int kDepth = 10;
  const Scene whole = onion(20, kDepth, 0);
  const Frame all = test::traced(whole, square_camera(whole, edge_for(1 << kDepth)));
  const double rays = static_cast<double>(all.stats.rays.reflection + all.stats.rays.refraction) /
                      static_cast<double>(all.pixels());
  doubling.at_most("rays a pixel at depth 10", 1 + rays, (1 << kDepth) - 1);
  CHECK(rays > 1 << (kDepth - 3));  // and they do double

  // What a picture lacks of the background's 1 is the weight of the rays that were not sent, by depth or by cut. Sums of
  // floats: up to 20 levels of a product and a sum, 2^-24 each.
  constexpr double kRounding = 20 * 2 * 0x1p-24;
  Worst lacking, levels_over, error;
  const auto add_lack = [&](const Frame& frame) {
    double sum = 0;
    for (const glm::vec3& c : frame.color) sum += c.x;
    lacking.add(std::abs(sum / static_cast<double>(frame.pixels()) + frame.stats.cut_weight - 1));
  };
  add_lack(all);
  for (const double cut : {1e-2, 1e-3, 1e-4}) {
    const Scene scene = onion(20, 20, cut);
    const double most = std::floor(std::log(cut) / std::log(0.5));  // 0.5^levels >= cut
    add_lack(test::traced(scene, square_camera(scene, edge_for(std::exp2(most + 1)))));
    // In single trees, too, through the middle and at the outline: no level beyond, and what is missing of the 1 that
    // comes back without a cut is at most the weight `cut` of each branch that was cut.
    const auto prepared = raytrace::Prepared(scene);
    for (const double aside : {0.0, 0.3, 0.8, 0.95}) {
      const RayRecord root = tree_of(prepared, scene.camera.eye, {aside, aside / 8, 0});
      std::uint64_t branches = 0;
      for_each_ray(root, [&](const RayRecord& ray) {
        levels_over.add(ray.depth - 1 - most);
        for (const RayRecord& child : ray.children) branches += !child.sent;
      });
      error.add((1 - double{root.color.x} - kRounding) / (static_cast<double>(branches) * cut));
      CHECK(branches > 0);
    }
  }
  doubling.at_most("what a picture lacks, off the weight of rays not sent", lacking, kRounding);
  doubling.at_most("levels beyond log(cut)/log(weight)", levels_over, 0);
  doubling.at_most("what a tree lacks, in units of cut branches times the cut", error, 1);
}

// At random and at the outline, where interpolated normals send rays below the facet.
TEST_CASE("MIR-6: no mirror ray of a smooth-shaded icosphere starts below its facet") {
  const Scene scene = smooth_icosphere();
  const raytrace::Prepared prepared(scene);
  Random random(97);
  std::uint64_t below = 0, again = 0, folded = 0, mirrored = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
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
