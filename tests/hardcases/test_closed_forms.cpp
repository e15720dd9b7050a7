// SPDX-License-Identifier: MIT
// Scenes with a formula: a hall of mirrors (FORM-1), a slab of glass (FORM-2), a ball of glass (FORM-3), a corner cube
// (FORM-4) and a closed box of mirrors (FORM-5). What the tracer's own rays do, told by explain(), against paper.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/common.hpp>

#include "common/scene/shapes.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/support/trees.h"
#include "tests/support/worst.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// The rays of a tree that follow one another by the first child of this kind.
std::vector<const RayRecord*> chain(const RayRecord& root, RayKind kind) {
  std::vector<const RayRecord*> rays{&root};
  for (;;) {
    const RayRecord* next = nullptr;
    for (const RayRecord& child : rays.back()->children)
      if (child.sent && child.kind == kind && !next) next = &child;
    if (!next) return rays;
    rays.push_back(next);
  }
}

// A mirror that shines by itself: c1 ka Ia = `glow`, c2 = k.
std::uint32_t add_glowing_mirror(Scene& scene, double glow, double k) {
  scene.ambient = glm::dvec3(1);
  Material mirror;
  mirror.ambient = glm::dvec3(glow);
  mirror.reflect = glm::dvec3(k);
  return add_material(scene, mirror);
}
// glow (1 + k + ... + k^(depth - 1))
double series(double glow, double k, int depth) { return glow * (1 - std::pow(k, depth)) / (1 - k); }

std::uint32_t add_glass(Scene& scene, double ior, double reflect) {
  Material glass;
  glass.local = glm::dvec3(0);
  glass.refract = glm::dvec3(1 - reflect);
  glass.reflect = glm::dvec3(reflect);
  glass.ior = ior;
  return add_material(scene, glass);
}

// A straight line folded into [-1, 1] at both ends: where a ball between two walls is.
double folded(double x) {
  const double y = std::fmod(x + 1, 4);
  const double up = y < 0 ? y + 4 : y;
  return up <= 2 ? up - 1 : 3 - up;
}

Quad distance_to_origin(const RayRecord& ray) {
  const QuadVec d = quad(ray.direction);
  return length(cross(quad(ray.origin), d)) / length(d);
}
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

// Unfolded, the way between two mirrors at z = -1 and 1 is a straight line: the mirror images of the hall stand behind
// one another. Bounce i meets a plane z = +-(1 + 2 i) of it; x and y go on. A start is off by 16 eps of its place
// (clearance, along z) and a direction by 4 eps a bounce, which the way that is left multiplies.
TEST_CASE("FORM-1: a hall of mirrors") {
  constexpr int kDepth = 200;
  constexpr double kGlow = 0.1, k = 0.95;
  Scene scene = empty_scene();
  const std::uint32_t mirror = add_glowing_mirror(scene, kGlow, k);
  add_plane(scene, {{0, 0, -1}, {0, 0, 1}, mirror}, {});
  add_plane(scene, {{0, 0, 1}, {0, 0, -1}, mirror}, {});
  scene.trace.depth = kDepth;
  const raytrace::Prepared prepared(scene);
  Random random(111);
  Worst place, color;
  std::uint64_t short_chains = 0, trees = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / (4 * kDepth); left > 0; --left, ++trees) {
    const glm::dvec3 eye(0, 0, random.uniform(-0.9, 0.9));
    const glm::dvec3 to(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform() < 0.5 ? -1 : 1);
    const RayRecord root = tree_of(prepared, eye, eye + to);
    const auto rays = chain(root, RayKind::mirrored);
    short_chains += rays.size() != kDepth;
    const glm::dvec3 d = root.direction / std::abs(root.direction.z);
    const double first = 1 - eye.z * d.z;  // to the first mirror, along z
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double way = first + 2 * static_cast<double>(i);
      const glm::dvec3 p = rays[i]->local.surface.point, expected = way * d;
      const double bound = (16 + 4) * kEps * (1 + static_cast<double>(i)) * way * glm::length(d);
      place.add(std::hypot(p.x - expected.x, p.y - expected.y) / bound);
    }
    color.add(std::abs(root.color.x / series(kGlow, k, kDepth) - 1));
  }
  // A product and a sum of floats a level, of terms that fall by k: 2 u / (1 - k) in all.
  const HardCase hall("FORM-1");
  hall.none("ways through the hall that end before depth 200", short_chains, trees);
  hall.at_most("error of a place in 20 eps a bounce of the way", place, 1);
  hall.at_most("relative error of the colour against the series", color, 2 * 0x1p-24 / (1 - k));
}

// A ray leaves as it came, moved aside by thickness sin(i - t) / cos t. Its point on each face is off by the clearance,
// 16 eps of 1, and a direction by 16 eps over cos t.
TEST_CASE("FORM-2: a slab of glass moves a ray aside") {
  constexpr double kIndex = 1.5, kThickness = 0.5;
  Scene scene = empty_scene();
  PolygonMesh slab = make_box({8, 8, kThickness});
  for (PolygonMesh::Face& face : slab.faces) face.material = 1;
  add_glass(scene, kIndex, 0);
  add_mesh(scene, slab, {}, {});
  const raytrace::Prepared prepared(scene);
  Random random(113);
  Worst turned, moved;
  std::uint64_t lost = 0, rays = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 4; left > 0; --left, ++rays) {
    const double angle = random.uniform(0, 1.2), around = random.uniform(0, 6.28);
    const glm::dvec3 d{std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around),
                       -std::cos(angle)};
    const RayRecord root = tree_of(prepared, glm::dvec3(0, 0, 0.25) - d, {0, 0, 0.25});
    const auto way = chain(root, RayKind::refracted);
    if (way.size() != 3 || !way[2]->background) {
      ++lost;
      continue;
    }
    const QuadVec in = (1 / length(quad(root.direction))) * quad(root.direction),
                  out = quad(way[2]->direction);
    const Quad sine2 = in.x * in.x + in.y * in.y, cos_i = square_root(1 - sine2),
               cos_t = square_root(1 - sine2 / (Quad(kIndex) * kIndex));
    turned.add(length(out - in) * cos_i / kEps);
    // sin(i - t) / cos t = sin i (1 - cos i / (n cos t)), between the lines, whose distance is that of a point.
    const Quad aside = kThickness * square_root(sine2) * (1 - cos_i / (kIndex * cos_t));
    const Quad apart = length(cross(quad(way[2]->origin) - quad(root.origin), in));
    moved.add(magnitude(apart - aside) * cos_i / kEps);
  }
  const HardCase slab_case("FORM-2");
  slab_case.none("rays that do not pass a slab by two refractions", lost, rays);
  slab_case.at_most("angle between coming and going, in eps / cos i", turned, 2 * 16);
  slab_case.at_most("error of the way aside, in eps / cos i", moved, 3 * 16);
}

// Through a ball of glass a ray turns by 2 (i - t), with one reflection inside by pi + 2 i - 4 t: the rainbow. sin i is
// the distance of the ray from the centre. Angles are those of doubles; at i they grow by 1 / cos i.
TEST_CASE("FORM-3: a ball of glass turns a ray, and makes the rainbow") {
  constexpr double kIndex = 1.33;
  Scene scene = empty_scene();
  add_sphere(scene, {{0, 0, 0}, 1, add_glass(scene, kIndex, 0.25)}, {});
  scene.trace.depth = 4;
  const raytrace::Prepared prepared(scene);
  Random random(117);
  Worst through, bow;
  std::uint64_t lost = 0, rays = 0;
  double least = 10;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 8; left > 0; --left, ++rays) {
    const glm::dvec3 eye = 3.0 * random.direction();
    const RayRecord root = tree_of(prepared, eye, random.uniform(0, 0.95) * across(eye, random));
    const double sine = static_cast<double>(distance_to_origin(root));
    const double i = std::asin(sine), t = std::asin(sine / kIndex), unit = kEps / (1 - sine * sine);
    // in: eye, refracted; then out, or mirrored and out
    const auto way = chain(root, RayKind::refracted);
    const RayRecord* mirrored = nullptr;
    if (way.size() == 3)
      for (const RayRecord& child : way[1]->children)
        if (child.kind == RayKind::mirrored) mirrored = &child;
    const auto out = mirrored ? chain(*mirrored, RayKind::refracted) : std::vector<const RayRecord*>{};
    if (out.size() != 2 || !out[1]->background || !way[2]->background) {
      ++lost;
      continue;
    }
    through.add(std::abs(angle_between(root.direction, way[2]->direction) - 2 * (i - t)) / unit);
    const double turn = angle_between(root.direction, out[1]->direction);  // in [0, pi]: pi - |2 i - 4 t|
    bow.add(std::abs(turn - (std::numbers::pi - std::abs(2 * i - 4 * t))) / unit);
    least = std::min(least, turn);
  }
  const HardCase ball("FORM-3");
  ball.none("rays that do not leave a ball as they must", lost, rays);
  ball.at_most("error of the angle through the ball, in eps / cos² i", through, 64);
  ball.at_most("error of the angle with one reflection inside, in eps / cos² i", bow, 96);
  // Descartes: the least turn is at cos² i = (n² - 1) / 3: 137.5 degrees for water.
  const double i = std::acos(std::sqrt((kIndex * kIndex - 1) / 3)), t = std::asin(std::sin(i) / kIndex);
  const double rainbow = std::numbers::pi + 2 * i - 4 * t;
  ball.at_most("least turn below the rainbow's, in radians", rainbow - least, 1e-12);
  ball.at_most("least turn above the rainbow's, in radians", least - rainbow, 1e-3);
}

// Three mirrors at right angles send every ray back: -D, along the line through the corner's mirror image of the eye.
TEST_CASE("FORM-4: a corner cube sends every ray back") {
  Scene scene = empty_scene();
  const std::uint32_t mirror = add_glowing_mirror(scene, 0.125, 0.5);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal(0);
    normal[axis] = 1;
    add_plane(scene, {{0, 0, 0}, normal, mirror}, {});
  }
  scene.background = glm::dvec3(0);
  const raytrace::Prepared prepared(scene);
  Random random(121);
  Worst turned, moved;
  std::uint64_t wrong = 0, rays = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 4; left > 0; --left, ++rays) {
    const glm::dvec3 eye(random.uniform(0.5, 1), random.uniform(0.5, 1), random.uniform(0.5, 1));
    const RayRecord root = tree_of(prepared, eye, random.in_box(0.4));
    const auto way = chain(root, RayKind::mirrored);
    const glm::dvec3 d = glm::normalize(root.direction);
    wrong += way.size() != 4 || !way.back()->background || root.color.x != 0.125f * 1.75f;
    turned.add(glm::length(way.back()->direction + d) / kEps);
    // The line back passes the point -eye.
    moved.add(length(cross(quad(way.back()->origin) + quad(eye), quad(d))) / kEps);
  }
  const HardCase corner("FORM-4");
  corner.none("rays that do not come back by three mirrors, 7/8 as the series of 1/2 says", wrong, rays);
  corner.at_most("angle between the ray and its return, in eps", turned, 16);
  corner.at_most("distance of the return from the mirrored eye, in eps", moved, 64);
}

// Six mirrors that shine alike: whatever the direction, a pixel is the series. And where a ray is after any number of
// bounces tells the straight line, folded at the walls.
TEST_CASE("FORM-5: a closed box of mirrors") {
  constexpr double kGlow = 0.25, k = 0.875;
  constexpr int kDepth = 100;
  Scene scene = empty_scene();
  add_glowing_mirror(scene, kGlow, k);
  PolygonMesh box = make_box({2, 2, 2});
  for (PolygonMesh::Face& face : box.faces) face.material = 1;
  add_mesh(scene, box, {}, {});
  scene.trace.depth = kDepth;
  scene.camera.eye = {0.3, -0.2, 0.1};
  scene.camera.look_at = {1, 0.4, -0.7};
  scene.camera.view_height = 2;
  const int edge = std::min(128, tier_edge() / 4);
  const Frame frame = test::traced(scene, square_camera(scene, edge));
  Worst color;
  for (const glm::vec3& c : frame.color) color.add(std::abs(c.x / series(kGlow, k, kDepth) - 1));
  const HardCase closed("FORM-5");
  closed.at_most("relative error of a pixel against the series", color, 2 * 0x1p-24 / (1 - k));

  // Errors as in FORM-1; where a wall is met next to an edge, the order of two walls does not matter to the fold.
  const raytrace::Prepared prepared(scene);
  Random random(123);
  Worst place;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / (4 * kDepth); left > 0; --left) {
    const glm::dvec3 eye = random.in_box(0.9);
    const RayRecord root = tree_of(prepared, eye, random.in_box(0.9));
    const glm::dvec3 d = glm::normalize(root.direction);
    double way = 0;
    glm::dvec3 before = eye;
    int bounce = 0;
    for (const RayRecord* ray : chain(root, RayKind::mirrored)) {
      way += glm::length(ray->local.surface.point - before);
      before = ray->local.surface.point;
      ++bounce;
      const glm::dvec3 line = eye + way * d;
      const glm::dvec3 expected{folded(line.x), folded(line.y), folded(line.z)};
      place.add(glm::length(before - expected) / (20 * kEps * bounce * (1 + way)));
    }
  }
  closed.at_most("error of a place in 20 eps a bounce of the way", place, 1);
}
