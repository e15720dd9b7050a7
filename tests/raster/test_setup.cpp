// SPDX-License-Identifier: MIT
// box_of_primitive never excludes a sample at which intersect() finds the primitive: in front of, around and
// behind the eye, huge and tiny, seen through telephoto lenses and through 179.99 degrees. And it does
// exclude most others.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/visibility.h"
#include "raster/setup.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using raster::SampleBox;

namespace {

constexpr int kWidth = 16, kHeight = 12;

// View heights 2 tan(fov/2): from 1e-6 degrees over 53 to 179 and 179.99.
constexpr double kHeights[]{1.75e-8, 1e-3, 1, 229.2, 22918};

Camera any_camera(Random& random, double view_height) {
  CameraSettings settings;
  settings.eye = random.in_box(random.log_uniform(1e-3, 1e3));
  settings.look_at = settings.eye + random.direction();
  settings.up = random.direction();
  settings.view_height = view_height;
  return make_camera(settings, kWidth, kHeight, 1 + static_cast<int>(random.below(2)));
}

// A point on, or next to, the ray of a sample of the picture or of its surroundings, at any distance in front
// of the eye. The step between samples there is `footprint`.
struct Aim {
  glm::dvec3 point{0};
  double footprint = 0;
};
Aim aim(const Camera& camera, Random& random) {
  const int X = static_cast<int>(random.below(static_cast<std::uint32_t>(camera.columns() + 4))) - 2;
  const int Y = static_cast<int>(random.below(static_cast<std::uint32_t>(camera.rows() + 4))) - 2;
  const double distance = random.log_uniform(1e-3, 1e3) / camera.depth_scale();
  return {camera.eye + distance * camera.direction(X, Y), distance * 2 * glm::length(camera.up)};
}

struct Tally {
  std::uint64_t excluded = 0, hits = 0, samples_in_boxes = 0, samples = 0;
};

bool is_inside(const SampleBox& box, int X, int Y) {
  return X >= box.x0 && X < box.x1 && Y >= box.y0 && Y < box.y1;
}

void compare_with_intersect(const Scene& scene, const Camera& camera, Tally& tally) {
  VisibilityCounts counts;
  const SampleBox box = raster::box_of_primitive(scene, camera, 0);
  for (int Y = 0; Y < camera.rows(); ++Y)
    for (int X = 0; X < camera.columns(); ++X) {
      const bool inside = is_inside(box, X, Y);
      const bool hit = intersect(scene, 0, {camera.eye, camera.direction(X, Y)}, kRayStart, counts).found();
      tally.excluded += hit && !inside;
      tally.hits += hit;
      tally.samples_in_boxes += inside;
      ++tally.samples;
    }
}

// `make(camera, random)` is a scene of one primitive.
template <class Make>
Tally over_all_cameras(const Make& make) {
  Random random(11);
  Tally tally;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 64; left > 0; --left)
    for (const double view_height : kHeights) {
      const Camera camera = any_camera(random, view_height);
      compare_with_intersect(make(camera, random), camera, tally);
    }
  CHECK(tally.excluded == 0);
  CHECK(tally.hits > 0);
  return tally;
}

}  // namespace

TEST_CASE("the box of a triangle whose corners lie on sample rays holds every sample that hits it") {
  const Tally tally = over_all_cameras([](const Camera& camera, Random& random) {
    return scene_of_triangle(aim(camera, random).point, aim(camera, random).point, aim(camera, random).point);
  });
  CHECK(tally.samples_in_boxes < tally.samples);
}

TEST_CASE("the box of a triangle of the size of a sample holds every sample that hits it, and few others") {
  const Tally tally = over_all_cameras([](const Camera& camera, Random& random) {
    const Aim at = aim(camera, random);
    const double size = at.footprint * random.log_uniform(1e-3, 2);
    const auto corner = [&] { return at.point + random.in_box(size); };
    return scene_of_triangle(corner(), corner(), corner());
  });
  // 4 footprints and the margin of one sample to either side: 7 of the 12 to 32 samples of a row or column.
  CHECK(tally.samples_in_boxes * 3 < tally.samples);
}

TEST_CASE("the box of a triangle around, beside or behind the eye holds every sample that hits it") {
  over_all_cameras([](const Camera& camera, Random& random) {
    const double size = random.log_uniform(1e-3, 1e6);
    const auto corner = [&] { return camera.eye + random.in_box(size); };
    return scene_of_triangle(corner(), corner(),
                             random.uniform() < 0.5 ? corner() : aim(camera, random).point);
  });
}

TEST_CASE("the box of a huge or far triangle holds every sample that hits it") {
  over_all_cameras([](const Camera& camera, Random& random) {
    const double size = random.log_uniform(1e6, 9e13);  // 11 of it stay below the 1e15 of a scene
    const glm::dvec3 center = camera.eye + random.uniform(0, 10) * size * camera.forward;
    const auto corner = [&] { return center + random.in_box(size); };
    return scene_of_triangle(corner(), corner(), corner());
  });
}

TEST_CASE("the box of a sphere holds every sample that hits it, silhouettes included") {
  const Tally tally = over_all_cameras([](const Camera& camera, Random& random) {
    // Half of them tangent to a sample's ray, as near as rounding takes it.
    const Aim at = aim(camera, random);
    const double radius = at.footprint * random.log_uniform(1e-2, 1e2);
    glm::dvec3 center = at.point;
    if (random.uniform() < 0.5) {
      const glm::dvec3 along = glm::normalize(at.point - camera.eye);
      center += radius * glm::normalize(glm::cross(along, random.direction()));
    }
    return scene_of(Sphere{center, radius, 0});
  });
  CHECK(tally.samples_in_boxes < tally.samples);
}

TEST_CASE("the box of a sphere around or behind the eye, or huge, holds every sample that hits it") {
  over_all_cameras([](const Camera& camera, Random& random) {
    const double radius = random.log_uniform(1e-3, 1e9);
    return scene_of(Sphere{camera.eye + random.uniform(0, 2) * radius * random.direction(), radius, 0});
  });
}

TEST_CASE("a plane may be anywhere, a degenerate triangle is nowhere") {
  Random random(12);
  const Camera camera = any_camera(random, 1);
  const SampleBox all = raster::box_of_primitive(scene_of(Plane{}), camera, 0);
  CHECK(is_inside(all, 0, 0));
  CHECK(is_inside(all, camera.columns() - 1, camera.rows() - 1));
  CHECK(raster::box_of_primitive(scene_of_triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), camera, 0).empty());
}

TEST_CASE("boxes worked out by hand") {
  CameraSettings settings;
  settings.view_height = 2;
  const Camera camera =
      make_camera(settings, 40, 20, 1);  // ten samples a unit: x = (X - 19.5)/10, y = (9.5 - Y)/10
  const auto box_of = [&](const std::vector<glm::dvec3>& points) {
    return raster::box_of_points(camera, points);
  };
  // x from -0.55 to 0.45 is X from 14 to 24, y from -0.25 to 0.35 is Y from 6 to 12; a margin of one sample,
  // half-open.
  const SampleBox box = box_of({{-0.55, 0.05, -1}, {0.9, 0.7, -2}, {0, -0.25, -1}});
  CHECK(box.x0 <= 14);
  CHECK(box.x0 >= 12);
  CHECK(box.x1 >= 25);
  CHECK(box.x1 <= 27);
  CHECK(box.y0 <= 6);
  CHECK(box.y0 >= 4);
  CHECK(box.y1 >= 13);
  CHECK(box.y1 <= 15);
  CHECK(box_of({{-0.55, 0.05, 1}, {0.9, 0.7, 2}, {0, -0.25, 1}}).empty());  // behind
  CHECK(box_of({{9, 0, -1}, {9, 1, -1}, {8, 0, -1}}).empty());              // to the right
  CHECK(box_of({{0, 0, -1}, {0, 1, 1}, {1, 0, -1}}).x1 == 40);  // through the eye's plane: anywhere
  CHECK(box_of({{0, 0, -1}, {0, 0, 0}, {1, 0, -1}}).x1 == 40);  // at the eye
}
