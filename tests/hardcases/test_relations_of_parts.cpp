// SPDX-License-Identifier: MIT
// Metamorphic relations of parts: scenes in another order or cut finer, and the pictures that must not care (MET-3, 4).
#include <map>
#include <numeric>

#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

// ---- MET-3 ----

TEST_CASE("MET-3: the order of lights, objects, triangles and vertices") {
  const HardCase hard("MET-3");
  Scene scene = everything();
  // Without the carpet's duplicate: which of two equal surfaces is seen is a matter of order.
  std::vector<std::size_t> order(scene.objects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) {
    return scene.materials[primitive_material(scene, scene.objects[i].first_primitive)].name == "same_place";
  });
  scene = rebuilt(scene, order, unchanged);
  order.resize(scene.objects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});

  // Sums of light terms, in another order: 1 u each, of the partial sums, once for each picture.
  Scene swapped = scene;
  std::reverse(swapped.lights.begin(), swapped.lights.end());
  const Likeness lights = likeness(scene, swapped);
  hard.none("lights: pixels with another surface or depth", lights.surfaces + lights.depths,
            2 * lights.pixels);
  const double reach = static_cast<double>(2 * scene.lights.size() * scene.trace.depth) * 0x1p-24;
  hard.at_most("lights: colours, in units of 2 lights 2^-24 for each ray of a path", lights.color / reach, 1);

  // Objects that are no solids in reverse, solids in their places.
  std::vector<std::size_t> opaque;
  for (const std::size_t i : order)
    if (!scene.objects[i].solid) opaque.push_back(i);
  std::vector<std::size_t> reversed = order;
  std::size_t last = opaque.size();
  for (std::size_t& i : reversed)
    if (!scene.objects[i].solid) i = opaque[--last];
  const Scene other = rebuilt(scene, reversed, unchanged);
  std::uint64_t moved_surfaces = 0, pixels = 0;
  double color = 0;
  for (const auto& [a, b] :
       {std::pair(rastered(scene, relation_camera(scene)), rastered(other, relation_camera(other))),
        std::pair(traced(scene, relation_camera(scene)), traced(other, relation_camera(other)))}) {
    Likeness each;
    each.add(a, b);
    color = std::max(color, each.color);
    for (std::size_t i = 0; i < a.pixels(); ++i) {
      ++pixels;
      const std::uint32_t id = b.object_id[i];
      moved_surfaces += a.object_id[i] != (id == 0 ? 0 : 1 + static_cast<std::uint32_t>(reversed[id - 1])) ||
                        a.sample_depth[i] != b.sample_depth[i];
    }
  }
  hard.none("objects: pixels with another surface or depth", moved_surfaces, pixels);
  hard.at_most("objects: colours, in units of eps", color / kFloatEps, 0);

  // Triangles backwards, corners rotated.
  const auto change = [](std::vector<Triangle>& triangles, std::vector<glm::dvec3>&) {
    std::reverse(triangles.begin(), triangles.end());
    for (Triangle& t : triangles) {
      std::rotate(t.vertex.begin(), t.vertex.begin() + 1, t.vertex.end());
      std::rotate(t.normal.begin(), t.normal.begin() + 1, t.normal.end());
    }
  };
  const Scene dull = matte(scene), turned_round = rebuilt(dull, order, change);
  std::uint64_t other_surface = 0;
  double matte_color = 0;
  pixels = 0;
  for (const auto& [a, b] :
       {std::pair(rastered(dull, relation_camera(dull)), rastered(turned_round, relation_camera(dull))),
        std::pair(traced(dull, relation_camera(dull)), traced(turned_round, relation_camera(dull)))}) {
    Likeness each;
    each.add(a, b);
    matte_color = std::max(matte_color, each.color);
    for (std::size_t i = 0; i < a.pixels(); ++i) {
      ++pixels;
      if (a.object_id[i] != b.object_id[i]) {
        ++other_surface;
        continue;
      }
      if (a.object_id[i] == 0) continue;
      const Object& object = dull.objects[a.object_id[i] - 1];
      const std::uint32_t before = a.primitive_id[i] - 1 - object.first_primitive;
      const std::uint32_t after = b.primitive_id[i] - 1 - object.first_primitive;
      other_surface += before + after != object.count - 1;
    }
  }
  hard.none("triangles and corners: pixels with another surface", other_surface, pixels);
  hard.at_most("triangles and corners: matte colours, in units of eps", matte_color / kFloatEps, 4);
}

// ---- MET-4: midpoints of dyadic vertices are exact, so the four cover exactly what the one did ----

namespace {

// How far apart two depths t = (a0 . n)/(d . n) of one plane may be, relatively: n is exact on this grid, so each of the
// two dot products is off by 3 u |a0||n| and 3 u |d||n|, the quotient by 1 u; and that for each of the two triangles.
double depth_bound(const Scene& scene, const Triangle& triangle, const Ray& ray) {
  const glm::dvec3& v0 = scene.positions[triangle.vertex[0]];
  const glm::dvec3 n =
      glm::cross(scene.positions[triangle.vertex[1]] - v0, scene.positions[triangle.vertex[2]] - v0);
  const glm::dvec3 a0 = v0 - ray.origin;
  double farthest = 0;  // the smaller triangle's first vertex may be any point of the edges
  for (const std::uint32_t v : triangle.vertex)
    farthest = std::max(farthest, glm::length(scene.positions[v] - ray.origin));
  const double condition = farthest * glm::length(n) / std::abs(glm::dot(a0, n)) +
                           glm::length(ray.direction) * glm::length(n) / std::abs(glm::dot(ray.direction, n));
  return (6 * condition + 2) * 0x1p-53;
}

}  // namespace

TEST_CASE("MET-4: a triangle cut into four at the middles of its edges") {
  Random random(4);
  std::uint64_t unlike = 0, pixels = 0, hits = 0;
  double depth = 0, color = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 25'000; left > 0; --left) {
    Scene scene = empty_scene();
    PolygonMesh ball = star_sphere(10, 12, 0.5, left);
    for (glm::dvec3& p : ball.positions) p = snapped(p);
    add_mesh(scene, ball, {}, {});
    Light light;
    light.position = {3, 4, 5};
    light.intensity = glm::dvec3(1);
    scene.lights = {light};
    scene.camera.eye = snapped(4.0 * random.direction());
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = random.direction();

    const auto four = [](std::vector<Triangle>& triangles, std::vector<glm::dvec3>& positions) {
      std::vector<Triangle> cut;
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
      const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(positions.size()));
        if (is_new) positions.push_back(0.5 * (positions[a] + positions[b]));
        return at->second;
      };
      for (const Triangle& t : triangles) {
        const auto [a, b, c] = t.vertex;
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const std::array<std::uint32_t, 3>& v :
             {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
          cut.push_back(t);
          cut.back().vertex = v;
        }
      }
      triangles = cut;
    };
    const Scene fine = rebuilt(scene, {0}, four);
    const Camera camera = relation_camera(scene);
    for (const auto& [a, b] : {std::pair(rastered(scene, camera), rastered(fine, camera)),
                               std::pair(traced(scene, camera), traced(fine, camera))})
      for (std::size_t i = 0; i < a.pixels(); ++i) {
        ++pixels;
        unlike += a.primitive_id[i] == 0
                      ? b.primitive_id[i] != 0
                      : b.primitive_id[i] == 0 || (b.primitive_id[i] - 1) / 4 != a.primitive_id[i] - 1;
        if (a.primitive_id[i] == 0 || b.primitive_id[i] == 0) continue;
        ++hits;
        const Ray ray{camera.eye, camera.direction(static_cast<int>(i % 67), static_cast<int>(i / 67))};
        const double bound = depth_bound(scene, scene.triangles[a.primitive_id[i] - 1], ray);
        depth = std::max(depth, std::abs(a.sample_depth[i] / b.sample_depth[i] - 1) / bound);
        for (int c = 0; c < 3; ++c)
          color = std::max(color, std::abs(double{a.color[i][c]} - double{b.color[i][c]}));
      }
  }
  REQUIRE(hits > 100);
  const HardCase hard("MET-4");
  hard.none("pixels that show another triangle than the one cut, or none", unlike, pixels);
  hard.at_most("difference of depths, in units of its bound", depth, 1);
  hard.at_most("difference of flat colours", color, 1e-6);
}
