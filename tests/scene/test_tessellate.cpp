// SPDX-License-Identifier: MIT
// Spheres as meshes: closed, outward, on the sphere, and everything else of the scene as it was.
#include "common/scene/tessellate.h"

#include <doctest/doctest.h>

#include "common/error.h"
#include "common/scene/limits.h"
#include "tests/support/scenes.h"

using namespace sidelight;

TEST_CASE("tessellated: a closed mesh of N (N - 2) triangles on the sphere") {
  for (const int n : {4, 6, 16, 50}) {
    CAPTURE(n);
    Sphere sphere;
    sphere.center = {1, 2, 3};
    sphere.radius = 0.5;
    const Scene scene = tessellated(test::scene_of(sphere), n);
    REQUIRE(scene.objects.size() == 1);
    CHECK(scene.objects[0].kind == ObjectKind::mesh);
    CHECK(scene.objects[0].closed);
    CHECK(scene.spheres.empty());
    CHECK(scene.triangles.size() == static_cast<std::size_t>(n) * static_cast<std::size_t>(n - 2));
    for (const Triangle& triangle : scene.triangles) {
      CHECK_FALSE(triangle.degenerate);
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 out = (scene.positions[triangle.vertex[k]] - sphere.center) / sphere.radius;
        CHECK(glm::length(out) == doctest::Approx(1).epsilon(1e-14));
        CHECK(glm::distance(out, scene.normals[triangle.normal[k]]) < 1e-14);
      }
    }
  }
}

TEST_CASE("tessellated: objects and materials keep their numbers, primitives are counted anew") {
  Scene scene = test::scene_of(test::octahedron({0, 0, 0}, 1));
  Material glass;
  glass.refract = glm::dvec3(1);
  glass.ior = 1.5;
  Sphere ball;
  ball.material = add_material(scene, glass);
  add_sphere(scene, ball, {});
  add_plane(scene, Plane{}, {});
  add_mesh(scene, test::octahedron({5, 0, 0}, 1), {}, {});
  const Scene out = tessellated(scene, 8);
  REQUIRE(out.objects.size() == 4);
  CHECK(out.objects[1].solid);
  CHECK(out.objects[1].ior == 1.5);
  CHECK(primitive_material(out, out.objects[1].first_primitive) == ball.material);
  CHECK(out.objects[2].kind == ObjectKind::plane);
  CHECK(out.objects[2].first_primitive == 8 + 48);
  CHECK(out.objects[3].first_primitive == 8 + 48 + 1);
  CHECK(out.primitive_object.size() == 8 + 48 + 1 + 8);
  const auto last = [](const Scene& s) { return s.positions[s.triangles.back().vertex[2]]; };
  CHECK(last(out) == last(scene));
}

TEST_CASE(
    "tessellated: more primitives than a scene may have are refused at the object that is one too many") {
  const auto ball = [](Scene& scene) { add_sphere(scene, Sphere{{0, 0, 0}, 1}, {"balls.toml", 7, 1}); };
  Scene scene;
  add_material(scene, {});
  ball(scene);
  add_mesh(scene, test::octahedron({5, 0, 0}, 1), {}, {"balls.toml", 9, 1});
  CHECK(tessellated(scene, 8).primitive_object.size() == 48 + 8);
  // As if the mesh were as large as it may be: nothing of it is read before it is refused.
  scene.objects[1].count = static_cast<std::uint32_t>(kMaxPrimitives) - 47;
  try {
    tessellated(scene, 8);
    FAIL("not refused");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).find("balls.toml:9:1: ") == 0);
    CHECK(std::string(error.what()).find(std::to_string(kMaxPrimitives + 1) + " primitives") !=
          std::string::npos);
  }
}
