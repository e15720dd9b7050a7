// SPDX-License-Identifier: MIT
// Metamorphic relations of secondary rays: mirrors and glass that should not show, depths and cuts that should not matter
// (MET-9 to 11).
#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

// ---- MET-9 ----

namespace {

// Things before the plane z = 0, all of them behind or beside the eye, which looks at the plane; or their copies behind
// it, without the plane.
Scene before_a_mirror(bool copies) {
  Scene scene;
  scene.ambient = glm::dvec3(0.5);
  scene.background = {0.125, 0.25, 0.5};
  scene.camera.eye = {0, 1, 4};
  scene.camera.look_at = {0, 1, 0};
  scene.camera.view_height = 0.9;
  const double side = copies ? -1 : 1;
  const auto paint = [&](const glm::dvec3& color) {
    Material material;
    material.ambient = material.diffuse = color;
    return add_material(scene, material);
  };
  add_sphere(scene, {{-1, 1, side * 6}, 1, paint({0.9, 0.2, 0.1})}, {});
  add_sphere(scene, {{1.5, 1.75, side * 7.5}, 1.25, paint({0.1, 0.8, 0.3})}, {});
  Transform mirror;
  mirror.linear[2][2] = side;
  mirror.translate = {0, 0, side * 9};
  PolygonMesh mesh = star_sphere(12, 16, 0.3, 9);
  const std::uint32_t blue = paint({0.2, 0.3, 0.9});
  for (PolygonMesh::Face& face : mesh.faces) face.material = blue;
  add_mesh(scene, mesh, mirror, {});
  Light light;
  light.position = {3, 5, side * 3};
  light.intensity = glm::dvec3(0.75);
  scene.lights = {light};
  if (copies) return scene;
  Material silver;
  silver.local = glm::dvec3(0);
  silver.reflect = glm::dvec3(1);
  add_plane(scene, {{0, 0, 0}, {0, 0, 1}, add_material(scene, silver)}, {});
  return scene;
}

}  // namespace

TEST_CASE("MET-9: a mirror shows what a copy behind it would") {
  const Scene mirror = before_a_mirror(false), copy = before_a_mirror(true);
  const Camera camera = make_camera(mirror.camera, 160, 120, 1);
  const Frame reflected = traced(mirror, camera), direct = traced(copy, camera);
  std::uint64_t strays = 0, covered = 0, through = 0;
  double worst = 0;
  for (std::size_t i = 0; i < direct.pixels(); ++i) {
    through += reflected.object_id[i] == 4;  // the plane
    if (direct.object_id[i] == 0) continue;
    ++covered;
    double apart = 0;
    for (int c = 0; c < 3; ++c)
      apart = std::max(apart, std::abs(double{reflected.color[i][c]} - double{direct.color[i][c]}));
    if (apart > 1e-4) ++strays;
    if (apart <= 1e-4) worst = std::max(worst, apart);
  }
  REQUIRE(through == direct.pixels());  // nothing stands before the mirror
  const HardCase hard("MET-9");
  hard.at_least("pixels of copies", static_cast<double>(covered), 1000);
  hard.at_most("share of them off by more than 1e-4 (edges)",
               static_cast<double>(strays) / static_cast<double>(covered), 1e-3);
  hard.at_most("difference of the others", worst, 1e-4);
}

// ---- MET-10 ----

// Glass of index 1 that shows nothing of itself bends nothing: a ray through it goes on from the surface in the same
// direction, bit for bit, from a point that is rounded anew. Only where it then meets an edge may that show.
TEST_CASE("MET-10: glass of index 1 is invisible") {
  Scene plain = everything();
  plain.trace.secondary_attenuation = {};
  plain.trace.depth = 20;
  // Without other solids, in which the glass would be a hole of index 1.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < plain.objects.size(); ++i)
    if (!plain.objects[i].solid) order.push_back(i);
  plain = rebuilt(plain, order, unchanged);
  Scene glazed = plain;
  Material nothing;
  nothing.local = glm::dvec3(0);
  nothing.refract = glm::dvec3(1);
  nothing.casts_shadow = false;
  const std::uint32_t air = add_material(glazed, nothing);
  add_sphere(glazed, {{0.3, 1.0, 3.2}, 0.9, air}, {});
  PolygonMesh box = star_sphere(6, 8, 0.1, 3);
  for (glm::dvec3& p : box.positions) p = glm::dvec3(-1.2, 1.1, 3) + 0.7 * p;
  for (PolygonMesh::Face& face : box.faces) face.material = air;
  add_mesh(glazed, box, {}, {});

  const Camera camera = make_camera(plain.camera, 134, 98, 1);
  const Frame before = traced(plain, camera), after = traced(glazed, camera);
  std::uint64_t through = 0, strays = 0;
  for (std::size_t i = 0; i < before.pixels(); ++i) {
    through += after.object_id[i] > plain.objects.size();
    double apart = 0;
    for (int c = 0; c < 3; ++c)
      apart = std::max(apart, std::abs(double{before.color[i][c]} - double{after.color[i][c]}));
    strays += apart > 1e-5;
  }
  const HardCase hard("MET-10");
  hard.at_least("pixels seen through it", static_cast<double>(through), 1000);
  hard.at_most("pixels that differ by more than 1e-5 (edges)", static_cast<double>(strays), 3);
}

// ---- MET-11 ----

TEST_CASE("MET-11: a depth beyond the longest path, and a cut below every weight") {
  // Mirrors that face each other but whose rays get away in the end, and a sheet without an inside.
  Scene scene = everything();
  for (Material& material : scene.materials)
    if (material.refract != glm::dvec3(0) && material.name != "film") material.refract = glm::dvec3(0);
  std::vector<std::size_t> order(scene.objects.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  scene = rebuilt(scene, order, unchanged);
  const Camera camera = relation_camera(scene);
  const auto at_depth = [&](int depth, double cut) {
    Scene other = scene;
    other.trace.depth = depth;
    other.trace.contribution_cut = cut;
    return traced(other, camera);
  };
  int longest = 1;
  while (longest < 100 && at_depth(longest, 0).stats.cut_weight > 0) ++longest;
  REQUIRE(longest > 2);
  REQUIRE(longest < 100);
  const Frame whole = at_depth(longest, 0);
  const HardCase hard("MET-11");
  std::uint64_t unlike = 0;
  for (const int depth : {longest + 1, longest + 10, 1000})
    unlike += !differences(at_depth(depth, 0), whole).empty();
  hard.none("depths beyond the longest path that change a bit", unlike, 3);
  hard.holds("a cut of 1e-300 is no cut", differences(at_depth(longest, 1e-300), whole).empty());
  hard.holds("a depth of 2 is another picture", !differences(at_depth(2, 0), whole).empty());
}
