// SPDX-License-Identifier: MIT
// The scenes on which agreement is hardest (RVR-1, RVR-3): a Cornell box, a mesh of many triangles, needles, a scene
// far away, triangles through the eye's plane, nearly coplanar and coplanar surfaces, intersecting spheres. Surfaces
// and depths must be the same at every sample, the local colours the same bytes.
#include "common/picture/compare.h"
#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"
#include "tests/support/scenes.h"
#include "viewer/bench/hard_cases.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

std::vector<HardScene> gate_scenes() {
  std::vector<HardScene> all = hard_scenes();

  Scene mesh = lit_scene({0.2, 0.4, 3}, {0, 0, 0});
  const auto rows =
      static_cast<std::uint32_t>(std::sqrt(static_cast<double>(tier_count("exact_picture_triangles")) / 4));
  add_mesh(mesh, star_sphere(rows, 2 * rows, 0.1, 8), {}, {});
  all.push_back({"a mesh of many triangles", mesh});

  Random random(90);
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
  for (const HardScene& gate : gate_scenes()) {
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
