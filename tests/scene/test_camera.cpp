// SPDX-License-Identifier: MIT
// The rays of samples: by hand for a small camera, and what holds for every camera (CAM-1, MET-2, MET-5).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/scene/camera.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/random.h"
#include "tests/support/wide.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

CameraSettings looking(const glm::dvec3& eye, const glm::dvec3& look_at, const glm::dvec3& up = {0, 1, 0}) {
  CameraSettings settings;
  settings.eye = eye;
  settings.look_at = look_at;
  settings.up = up;
  return settings;
}

// The largest entry of |B^T B - I| for the columns right, up and forward, at a view height of 1.
double off_orthonormal(CameraSettings settings) {
  settings.view_height = 1;
  const Camera camera = make_camera(settings, 4, 4, 1);
  const QuadVec b[]{quad(camera.right), quad(camera.up), quad(camera.forward)};
  Quad worst = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) worst = std::max(worst, magnitude(dot(b[i], b[j]) - (i == j ? 1 : 0)));
  return static_cast<double>(worst);
}

CameraSettings any_camera(Random& random) {
  CameraSettings settings = looking(random.in_box(10), random.in_box(10), random.direction());
  settings.view_height = random.log_uniform(1e-3, 1e3);
  return settings;
}

}  // namespace

// eye at the origin, looking along -z, height 2 at distance 1: r = (2, 0, 0), u = (0, 2, 0), f = (0, 0, -1).
// For 4x2 pixels d(X, Y) = (2X - 3) r + (1 - 2Y) u + 4 f: four times the point (X - 1.5, 0.5 - Y, -1) of the
// picture plane.
TEST_CASE("the rays of a camera of 4 by 2 pixels") {
  CameraSettings settings;
  settings.view_height = 2;
  const Camera camera = make_camera(settings, 4, 2, 1);
  CHECK(camera.right == glm::dvec3(2, 0, 0));
  CHECK(camera.up == glm::dvec3(0, 2, 0));
  CHECK(camera.forward == glm::dvec3(0, 0, -1));
  CHECK(camera.depth_scale() == 4);
  CHECK(camera.direction(0, 0) == glm::dvec3(-6, 2, -4));
  CHECK(camera.direction(1, 0) == glm::dvec3(-2, 2, -4));
  CHECK(camera.direction(3, 0) == glm::dvec3(6, 2, -4));
  CHECK(camera.direction(0, 1) == glm::dvec3(-6, -2, -4));
  CHECK(camera.direction(3, 1) == glm::dvec3(6, -2, -4));
}

TEST_CASE("x runs to the right, y down, whatever the camera looks at") {
  // From +x towards the origin with z up: right is +y.
  const Camera camera = make_camera(looking({5, 0, 0}, {0, 0, 0}, {0, 0, 1}), 3, 3, 1);
  CHECK(camera.forward == glm::dvec3(-1, 0, 0));
  CHECK(camera.right == glm::dvec3(0, 1, 0));
  CHECK(camera.up == glm::dvec3(0, 0, 1));
  CHECK(camera.direction(2, 1).y > 0);
  CHECK(camera.direction(1, 2).z < 0);
}

TEST_CASE("the middle of an odd lattice looks straight ahead, an even one has no middle") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const CameraSettings settings = any_camera(random);
    const Camera odd = make_camera(settings, 7, 5, 1), even = make_camera(settings, 8, 6, 1);
    CHECK(odd.direction(3, 2) == odd.depth_scale() * odd.forward);
    // The four rays around the middle of an even lattice lean to the four sides: their sum is ahead.
    const glm::dvec3 sum =
        (even.direction(3, 2) + even.direction(4, 3)) + (even.direction(3, 3) + even.direction(4, 2));
    const double largest = 4 * even.depth_scale() * std::max(1.0, settings.view_height);
    CHECK(sum == near(4.0 * even.depth_scale() * even.forward, 8 * kEps * largest));
  }
}

TEST_CASE("opposite corners lean to opposite sides, by half the picture less half a sample") {
  CameraSettings settings;
  settings.view_height = 1.5;
  for (const int n : {1, 2, 3}) {
    const Camera camera = make_camera(settings, 5, 4, n);
    const int X = camera.columns() - 1, Y = camera.rows() - 1;
    CHECK(camera.columns() == 5 * n);
    CHECK(camera.direction(0, 0) == glm::dvec3(-1.5 * X, 1.5 * Y, -2.0 * camera.rows()));
    CHECK(camera.direction(X, Y) == glm::dvec3(1.5 * X, -1.5 * Y, -2.0 * camera.rows()));
    CHECK(camera.direction(X, 0) == glm::dvec3(1.5 * X, 1.5 * Y, -2.0 * camera.rows()));
  }
}

TEST_CASE("a direction is the sum of its three parts, in this order, bit for bit") {
  Random random(2);
  std::uint64_t unlike = 0;
  for (int i = 0; i < 1000; ++i) {
    const Camera camera = make_camera(any_camera(random), 640, 480, 2);
    const int X = static_cast<int>(random.below(1280)), Y = static_cast<int>(random.below(960));
    for (int k = 0; k < 3; ++k) {
      const double column = (2 * X + 1 - 1280) * camera.right[k], row = (960 - 1 - 2 * Y) * camera.up[k];
      const double sum = column + row;
      unlike += camera.direction(X, Y)[k] != sum + 1920 * camera.forward[k];
    }
  }
  CHECK(unlike == 0);
}

// MET-5: with an odd n, sample (n/2, n/2) of a pixel is its centre, n times as long: 2 (n x + n/2) + 1 - n W
// = n (2 x + 1 - W). Each part is rounded on its own, hence parallel up to 3 u of each part and sum.
TEST_CASE("an odd number of samples has one at the pixel's centre, an even number has none") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const CameraSettings settings = any_camera(random);
    const Camera pixels = make_camera(settings, 13, 9, 1), threes = make_camera(settings, 13, 9, 3);
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 13; ++x) {
        const double size = 3 * (13 * settings.view_height + 9 * settings.view_height + 18);
        CHECK(threes.direction(3 * x + 1, 3 * y + 1) == near(3.0 * pixels.direction(x, y), 4 * kEps * size));
      }
  }
  CameraSettings settings;  // where r and u have no bits to lose, the rays coincide exactly
  settings.view_height = 0.75;
  const Camera one = make_camera(settings, 6, 5, 1), two = make_camera(settings, 6, 5, 2),
               three = make_camera(settings, 6, 5, 3);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 6; ++x) {
      CHECK(three.direction(3 * x + 1, 3 * y + 1) == 3.0 * one.direction(x, y));
      // The centre lies between the two: a quarter of a pixel, 2 r/4 and 2 u/4 (times n = 2), to each side.
      const glm::dvec3 aside = two.direction(2 * x, 2 * y) - 2.0 * one.direction(x, y);
      CHECK(aside == glm::dvec3(-0.75, 0.75, 0));
      CHECK(two.direction(2 * x + 1, 2 * y + 1) - 2.0 * one.direction(x, y) == -aside);
    }
}

// CAM-1
TEST_CASE("every camera is orthonormal to 4 eps") {
  Random random(4);
  double worst = 0;
  for (std::uint64_t left = tier_count("rays_per_case") / 4; left > 0; --left)
    worst = std::max(worst, off_orthonormal(any_camera(random)));
  // Up nearly parallel to the view, down to where it is given up.
  for (const double angle : {1e-4, 1e-6, 1e-8, 1e-12, 1e-13, 3e-14, 1e-15, 1e-18})
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 ahead = random.direction();
      worst = std::max(worst, off_orthonormal(looking({0, 0, 0}, ahead, ahead + angle * random.direction())));
    }
  // Very near and very far targets, very short and very long up vectors.
  for (const double distance : {1e-30, 1e14})
    for (const double length : {1e-300, 1e-30, 1e300})
      for (int i = 0; i < 1000; ++i)
        worst = std::max(worst, off_orthonormal(looking({0, 0, 0}, distance * random.direction(),
                                                        length * random.direction())));
  HardCase("CAM-1").at_most("entries of B^T B - I, in units of eps", worst / kEps, 4);
}

TEST_CASE("what of a direction is too small to move a sample is zero") {
  const Camera camera = make_camera(looking({0, 0, 5}, {1e-110, 0, 0}), 4, 4, 1);
  CHECK(camera.forward == glm::dvec3(0, 0, -1));
  CHECK(camera.right.z == 0);
}

TEST_CASE("an up that says nothing is replaced by the least aligned axis, the later one on a tie") {
  const glm::dvec3 down{0, -1, 0};  // x and z tie: z serves; right = down x z = -x
  for (const glm::dvec3& up :
       {glm::dvec3(0, 1, 0), glm::dvec3(0, -3, 0), glm::dvec3(0, 0, 0), glm::dvec3(1e-16, 1, 0)}) {
    const Camera camera = make_camera(looking({0, 7, 0}, {0, 0, 0}, up), 4, 4, 1);
    CHECK(camera.forward == down);
    CHECK(camera.right == glm::dvec3(-1, 0, 0));
    CHECK(camera.up == glm::dvec3(0, 0, 1));
  }
  const Camera along_z = make_camera(looking({0, 0, 0}, {0, 0, 2}, {0, 0, 1}), 4, 4, 1);
  CHECK(along_z.up == glm::dvec3(0, 1, 0));
  const Camera slanted =
      make_camera(looking({0, 0, 0}, {1, 2, 3}, {2, 4, 6}), 4, 4, 1);  // x is least aligned
  CHECK(slanted.up.x > 0.9);
}

TEST_CASE("an up that leans by 1e-4 is kept") {
  const Camera camera = make_camera(looking({0, 7, 0}, {0, 0, 0}, {1e-4, 1, 0}), 4, 4, 1);
  CHECK(camera.up == near({1, 0, 0}, 4 * kEps));  // up across the view is its x part alone
}

TEST_CASE("scaling the scene by a power of two changes no bit of a ray") {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const CameraSettings settings = any_camera(random);
    const Camera camera = make_camera(settings, 640, 480, 1);
    for (const int k : {-90, -20, 1, 20, 45}) {
      CameraSettings scaled = settings;
      scaled.eye *= std::exp2(k);
      scaled.look_at *= std::exp2(k);
      const Camera other = make_camera(scaled, 640, 480, 1);
      CHECK(other.eye == std::exp2(k) * camera.eye);
      CHECK(other.direction(17, 391) == camera.direction(17, 391));
    }
  }
}

TEST_CASE("samples come in squares") {
  for (int n = 1; n <= 64; ++n) CHECK(samples_per_edge(n * n) == n);
  for (const int spp : {-4, 0, 2, 3, 8, 15, 2147395601, 2147483647}) CHECK(samples_per_edge(spp) == 0);
  CHECK(samples_per_edge(46340 * 46340) == 46340);
}
