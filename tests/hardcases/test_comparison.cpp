// SPDX-License-Identifier: MIT
// What a comparison of two pictures must see: values that are not finite (IMG-1), and a crack of one pixel among
// thousands of differences that are right (IMG-4). Metrics: tests/picture/test_metrics.cpp.
#include "common/picture/compare.h"
#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"

using namespace sidelight;
using namespace sidelight::test;

TEST_CASE("IMG-1: values that are not finite never pass") {
  const Scene scene = everything();
  const Camera camera = relation_camera(scene);
  const Frame flat = rastered(scene, camera), deep = traced(scene, camera);
  REQUIRE(compare(flat, deep, scene.lights.size()).agrees());
  std::uint64_t passed = 0, miscounted = 0, asked = 0;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()})
    for (const int where : {1, 2, 3})  // in the reference, in the test, in both at the same place
      for (const std::size_t pixel : {std::size_t{0}, std::size_t{1234}, flat.pixels() - 1}) {
        Frame a = flat, b = deep;
        if (where & 1) a.color[pixel].y = bad;
        if (where & 2) b.color[pixel].y = bad;
        const Comparison result = compare(a, b, scene.lights.size());
        ++asked;
        passed += result.agrees();
        miscounted += result.unexplained != 1 || result.metrics.non_finite != 1 ||
                      !std::isfinite(result.metrics.rms) ||
                      static_cast<std::size_t>(result.unexplained_y * 67 + result.unexplained_x) != pixel;
      }
  const HardCase hard("IMG-1");
  hard.none("comparisons with such a value that agree", passed, asked);
  hard.none("that do not count it once and name its pixel", miscounted, asked);
}

TEST_CASE("IMG-4: a crack of one pixel is seen, right differences are explained, a shift is seen") {
  const HardCase hard("IMG-4");
  const Scene scene = everything();
  const Camera camera = make_camera(scene.camera, 128, 96, 1);
  const Frame flat = rastered(scene, camera), deep = traced(scene, camera);
  const Comparison right = compare(flat, deep, scene.lights.size());
  hard.none("z-buffer against tracer: unexplained pixels", right.unexplained + right.visibility_mismatches,
            flat.pixels());
  hard.at_least("pixels explained by shadow, mirror or glass",
                static_cast<double>(right.shadow.pixels + right.reflection.pixels + right.refraction.pixels),
                1000);

  Frame cracked = deep;
  std::size_t lit = 0;  // the first pixel that has no cause to differ and is not black
  while (lit < deep.pixels() && (deep.color[lit] != flat.color[lit] || deep.color[lit] == glm::vec3(0)))
    ++lit;
  REQUIRE(lit < deep.pixels());
  cracked.color[lit] = glm::vec3(0);
  hard.holds("one black pixel: 1 unexplained", compare(flat, cracked, scene.lights.size()).unexplained == 1);
  Frame hole = deep;
  hole.sample_primitive[lit] = kNone;
  hard.holds("one sample without its surface: 1 mismatch",
             compare(flat, hole, scene.lights.size()).visibility_mismatches == 1);

  Frame shifted = deep;
  std::rotate(shifted.sample_primitive.begin(), shifted.sample_primitive.begin() + 1,
              shifted.sample_primitive.end());
  std::rotate(shifted.sample_depth.begin(), shifted.sample_depth.begin() + 1, shifted.sample_depth.end());
  hard.at_least("a shift by one pixel: mismatches, of 12288 samples",
                static_cast<double>(compare(flat, shifted, scene.lights.size()).visibility_mismatches), 6000);
}
