// SPDX-License-Identifier: MIT
#include "common/scene/primitive_finder.h"

#include <doctest/doctest.h>

#include "common/scene/build.h"
#include "tests/support/random.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// A sphere, a mesh of three triangles, a plane, a mesh of one, two spheres.
Scene mixed_scene() {
  Scene scene;
  add_material(scene, {});
  const auto mesh = [](std::uint32_t triangles) {
    PolygonMesh polygons;
    for (std::uint32_t i = 0; i < triangles; ++i) {
      for (const glm::dvec3& v : {glm::dvec3(0, 0, i), glm::dvec3(1, 0, i), glm::dvec3(0, 1, i)}) {
        polygons.corners.push_back({static_cast<std::uint32_t>(polygons.positions.size()), kNone});
        polygons.positions.push_back(v);
      }
      polygons.faces.push_back({3 * i, 3, 0, 0, 0});
    }
    return polygons;
  };
  add_sphere(scene, {{0, 0, 0}, 1, 0}, {});
  add_mesh(scene, mesh(3), {}, {});
  add_plane(scene, {{0, 0, 0}, {0, 1, 0}, 0}, {});
  add_mesh(scene, mesh(1), {}, {});
  add_sphere(scene, {{2, 0, 0}, 1, 0}, {});
  add_sphere(scene, {{4, 0, 0}, 1, 0}, {});
  return scene;
}

}  // namespace

TEST_CASE("build: primitives found in turn are those found one by one") {
  const Scene scene = mixed_scene();
  const auto count = static_cast<std::uint32_t>(scene.primitive_object.size());
  REQUIRE(count == 8);
  Random random(3);
  PrimitiveFinder find(scene);
  for (int i = 0; i < 200; ++i) {
    const auto primitive = static_cast<std::uint32_t>(random.below(count));
    const PrimitiveRef found = find(primitive), expected = primitive_ref(scene, primitive);
    CHECK(found.kind == expected.kind);
    CHECK(found.index == expected.index);
  }
}
