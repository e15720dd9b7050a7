// SPDX-License-Identifier: MIT
// Triangles around and behind the eye (RAS-4), which no near plane cuts, judged in 128-bit integers.
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/exact_picture.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Both renderers against 128-bit integers.
struct Verdict {
  std::uint64_t samples = 0, covered = 0, unlike = 0;

  void judge(const Scene& scene, const Camera& camera) {
    const ExactPicture exact(scene, camera);
    const Frame flat = rastered(scene, camera);
    unlike += exact.mismatches(flat) + exact.mismatches(traced(local_only(scene), camera));
    samples += 2 * flat.sample_primitive.size();
    for (const std::uint32_t shown : flat.sample_primitive) covered += shown != kNone;
  }
};

}  // namespace

TEST_CASE("RAS-4: triangles around and behind the eye") {
  const HardCase hard("RAS-4");
  const Camera camera = plain_camera(512, 512, 2);
  Verdict ground;
  std::uint64_t ghosts = 0, above = 0;
  for (const double e : {10.0, 1e3, 1e6}) {
    const Scene scene = scene_of_triangle({-e, -1, e}, {e, -1, e}, {0, -1, -e});
    ground.judge(scene, camera);
    const Frame frame = rastered(scene, camera);
    for (int y = 0; y < 256; ++y)  // above the horizon, where a mirrored ghost would stand
      for (int x = 0; x < 512; ++x) {
        ++above;
        ghosts += frame.object_id[frame.index(x, y)] != 0;
      }
  }
  hard.none("ground that reaches behind the eye: samples unlike 128-bit integers", ground.unlike,
            ground.samples);
  hard.none("ghosts above the horizon", ghosts, above);
  // 104806, 130802 and 131072 of 262144 pixels by the catalogue's own measurements, up to the pixels on an edge
  hard.at_least("pixels of ground", static_cast<double>(ground.covered), 366'000);

  // Corners anywhere around the eye: in its plane exactly (z = 0), at the eye itself, behind it; walls through it.
  Random random(41);
  Verdict any;
  const Camera small = plain_camera(48, 40, 2);
  for (std::uint64_t left = 16 + tier_count("rays_per_case") / 2000; left > 0; --left) {
    const auto corner = [&] {
      glm::dvec3 p = random.on_grid(random.uniform() < 0.5 ? 3 : 40);
      if (random.uniform() < 0.3) p.z = 0;
      return p;
    };
    any.judge(scene_of_triangle(corner(), corner(), corner()), small);
  }
  hard.none("corners on a grid around the eye: samples unlike 128-bit integers", any.unlike, any.samples);
  hard.at_least("pixels that they cover", static_cast<double>(any.covered), 1000);
  std::uint64_t walls = 0;
  for (const glm::dvec3& far : {glm::dvec3(0, 9, -9), glm::dvec3(5, 0, -20), glm::dvec3(-3, -2, 1)})
    for (const std::uint32_t id : rastered(scene_of_triangle({0, 0, 0}, far, {1, 2, -3}), small).object_id)
      walls += id != 0;
  hard.none("pixels of triangles in whose plane the eye lies", walls, 3 * 48 * 40);
}
