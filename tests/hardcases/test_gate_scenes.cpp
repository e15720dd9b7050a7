// SPDX-License-Identifier: MIT
// The scenes on which agreement is hardest (RVR-1, RVR-3): a Cornell box, a mesh of many triangles, needles, a scene
// far away, triangles through the eye's plane, nearly coplanar and coplanar surfaces, intersecting spheres. Surfaces
// and depths must be the same at every sample, the local colours the same bytes.
#include "common/picture/compare.h"
#include "common/scene/shapes.h"
#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;
using namespace sidelight::testing;

namespace {

struct GateScene {
  std::string name;
  Scene scene;
};

Scene lit_scene(const glm::dvec3& eye, const glm::dvec3& look_at) {
  Scene scene = empty_scene();
  scene.materials[0].specular = glm::dvec3(0.25);
  scene.materials[0].shininess = 30;
  Light light;
  light.position = eye + glm::dvec3(1, 2, 0.5);
  light.intensity = glm::dvec3(1);
  scene.lights = {light};
  scene.camera.eye = eye;
  scene.camera.look_at = look_at;
  return scene;
}

Transform at(const glm::dvec3& p) {
  Transform transform;
  transform.translate = p;
  return transform;
}

std::vector<GateScene> gate_scenes() {
  std::vector<GateScene> all;
  Random random(90);

  Scene box = lit_scene({0, 0, 0.99}, {0, -0.1, 0});  // inside a box, with two boxes and a sphere in it
  box.camera.view_height = 1.6;
  add_mesh(box, make_box({2, 2, 2}), {}, {});
  add_mesh(box, make_box({0.6, 1.2, 0.6}), at({-0.4, -0.4, -0.4}), {});
  add_mesh(box, make_box({0.6, 0.6, 0.6}), at({0.4, -0.7, 0.1}), {});
  add_sphere(box, {{0.4, -0.15, 0.1}, 0.25, 0}, {});
  all.push_back({"Cornell box", box});

  Scene mesh = lit_scene({0.2, 0.4, 3}, {0, 0, 0});
  const auto rows =
      static_cast<std::uint32_t>(std::sqrt(static_cast<double>(tier_count("exact_picture_triangles")) / 4));
  add_mesh(mesh, star_sphere(rows, 2 * rows, 0.1, 8), {}, {});
  all.push_back({"a mesh of many triangles", mesh});

  Scene needles = lit_scene({0, 0, 4}, {0, 0, 0});
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 from = random.in_box(2), along = random.direction();
    add_mesh(needles,
             mesh_of({from, from + 4.0 * along,
                      from + 2.0 * along + random.log_uniform(1e-6, 1e-2) * random.direction()},
                     {{0, 1, 2}}),
             {}, {});
  }
  all.push_back({"needles", needles});

  Scene far = lit_scene({1e4, 1e4, 1e4 + 4}, {1e4, 1e4, 1e4});
  add_mesh(far, star_sphere(20, 30, 0.3, 4), at(glm::dvec3(1e4)), {});
  add_sphere(far, {{1e4 + 0.7, 1e4, 1e4 + 0.9}, 0.5, 0}, {});
  add_plane(far, {{1e4, 1e4 - 1.2, 1e4}, {0.1, 1, 0.2}, 0}, {});
  all.push_back({"far from the origin", far});

  Scene through = lit_scene({0, 0, 0}, {0, 0, -1});
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 a = random.in_box(5), b = random.in_box(5), c = random.in_box(5);
    add_mesh(through, mesh_of({a, b, {c.x, c.y, 0}}, {{0, 1, 2}}), {}, {});
  }
  all.push_back({"triangles through the eye's plane", through});

  Scene layers = lit_scene({0, 0, 0}, {0, 0, -1});
  for (const double g : {3e-7, 1e-5, 1e-3})
    for (const double z : {1e-3, 1.0, 1e3}) {
      const double r = 0.2 * z;
      const glm::dvec3 to{random.uniform(-0.5, 0.5) * z, random.uniform(-0.5, 0.5) * z, 0};
      for (const double depth : {z * (1 + g), z})
        add_mesh(layers,
                 mesh_of({to + glm::dvec3(-r, -r, -depth), to + glm::dvec3(r, -r, -depth),
                          to + glm::dvec3(0, r, -depth)},
                         {{0, 1, 2}}),
                 {}, {});
    }
  all.push_back({"layers at depths in a ratio of 1e6", layers});

  Scene spheres = lit_scene({0, 0, 5}, {0, 0, 0});
  for (int i = 0; i < 30; ++i) add_sphere(spheres, {random.in_box(1.5), random.uniform(0.3, 1), 0}, {});
  add_sphere(spheres, {{0, -1e6, 0}, 1e6 - 1, 0}, {});
  all.push_back({"intersecting spheres", spheres});

  Scene coplanar = lit_scene({0.3, 2, 4}, {0, 0, 0});
  for (int i = 0; i < 40; ++i) {
    const auto corner = [&] { return glm::dvec3(random.uniform(-2, 2), 0, random.uniform(-2, 2)); };
    add_mesh(coplanar, mesh_of({corner(), corner(), corner(), corner()}, {{0, 1, 2}, {0, 2, 3}}), {}, {});
  }
  add_plane(coplanar, {{0, 0, 0}, {0, 1, 0}, 0}, {});
  all.push_back({"coplanar quads on a plane", coplanar});
  return all;
}

}  // namespace

TEST_CASE("RVR-1: the gate scenes") {
  std::uint64_t mismatches = 0, samples = 0, unlike = 0, pictures = 0;
  for (const GateScene& gate : gate_scenes()) {
    CAPTURE(gate.name);
    const Scene scene = local_only(gate.scene);
    const PictureSize size = parse_size(tier_list("agreement_sizes").front());
    for (const int n : {1, 2}) {
      const Camera camera = make_camera(scene.camera, size.width, size.height, n);
      const Frame flat = rastered(scene, camera), deep = traced(scene, camera);
      const Comparison result = compare(flat, deep, scene.lights.size());
      CHECK(result.covered > 10);
      mismatches += result.visibility_mismatches;
      samples += flat.sample_primitive.size();
      unlike += !differences(flat, deep).empty();
      ++pictures;
    }
  }
  HardCase("RVR-1").none("gate scenes: samples whose primitive or depth differ", mismatches, samples);
  HardCase("RVR-3").none("gate scenes: local pictures that differ in any bit", unlike, pictures);
}
