// SPDX-License-Identifier: MIT
// Hard cases of refraction seen from within: an eye inside glass (REF-5) and light that is trapped in it (REF-7).
#include <doctest/doctest.h>
#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/scene/shapes.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/lit.h"
#include "tests/support/rays.h"
#include "tests/support/trees.h"
#include "tests/support/worst.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// ---- REF-5 ----

QuadVec unit_of(const glm::dvec3& v) { return (1 / length(quad(v))) * quad(v); }

// Where a ray leaves the sphere around the origin.
QuadVec exit_point(const QuadVec& o, const QuadVec& d, double radius) {
  const Quad b = dot(o, d);
  return o + (square_root(b * b - dot(o, o) + Quad(radius) * radius) - b) * d;
}

// ---- REF-7 ----

// Runs `work` on a thread with a stack of this many bytes.
void on_small_stack(std::size_t bytes, std::function<void()> work) {
  pthread_attr_t attributes;
  REQUIRE(pthread_attr_init(&attributes) == 0);
  REQUIRE(pthread_attr_setstacksize(&attributes, bytes) == 0);
  pthread_t thread;
  const auto run = [](void* given) -> void* {
    (*static_cast<std::function<void()>*>(given))();
    return nullptr;
  };
  REQUIRE(pthread_create(&thread, &attributes, run, &work) == 0);
  REQUIRE(pthread_join(thread, nullptr) == 0);
  pthread_attr_destroy(&attributes);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t kSmallStack = 4 << 20;  // sanitizers pad every frame
#else
constexpr std::size_t kSmallStack = 256 << 10;
#endif

}  // namespace

// The exact directions are Snell's law in 113 bits at the exact exit. What is rounded: the point and so the normal, by
// a few u of r over the half chord (where light leaves, cos i is at least 0.74 r), the sine by n times that, and the
// cosine by n² times that over itself.
TEST_CASE("REF-5: an eye inside glass sees Snell's law from within") {
  constexpr double kIndex = 1.5;
  Scene scene = empty_scene();
  add_sphere(scene, {{0, 0, 0}, 1, add_material(scene, clear(kIndex))}, {});
  const raytrace::Prepared prepared(scene);
  Random random(71);
  Worst error;  // of T in eps (1 + n² / cos t)
  std::uint64_t wrong = 0, rays = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 8; left > 0; --left, ++rays) {
    const glm::dvec3 eye = 0.95 * std::cbrt(random.uniform()) * random.direction();
    const RayRecord root = tree_of(prepared, eye, eye + random.direction());
    const QuadVec d = unit_of(root.direction), n = exit_point(quad(eye), d, 1);
    const Quad cos_i = dot(d, n);
    const QuadVec tangential = d - cos_i * n;
    const Quad radicand = 1 - Quad(kIndex) * kIndex * dot(tangential, tangential);
    if (root.children.empty() || root.local.surface.entering) {
      ++wrong;
      continue;
    }
    const RayRecord& child = root.children[0];
    if (magnitude(radicand) > 8 * kIndex * kIndex * kEps)
      wrong += (child.kind == RayKind::refracted) != (radicand > 0);
    if (child.kind != RayKind::refracted || !(radicand > 0)) continue;
    const QuadVec t = Quad(kIndex) * tangential + square_root(radicand) * n;
    const Quad condition = 1 + kIndex * kIndex / square_root(radicand);
    error.add(length(quad(child.direction) - t) / (kEps * condition));
  }
  const HardCase inside("REF-5");
  inside.none("exits that are taken for entries, or for total reflection", wrong, rays);
  inside.at_most("error of the direction outside in eps (1 + n²/cos t)", error, 16);

  // On the surface is outside: light goes straight on, and nothing is not a number.
  const RayRecord on = tree_of(prepared, {0, 0, 1}, {0.3, 0.2, 0});
  inside.holds("an eye on the surface is outside",
               on.children.size() == 1 && on.children[0].kind == RayKind::refracted &&
                   on.children[0].direction == glm::normalize(on.direction));
}

// Around one centre, index times distance of the ray's line from the centre is kept (Bouguer). Each of two interfaces
// starts its ray 16 u off the surface (8 eps) and turns it by 16 eps of the condition above.
TEST_CASE("REF-5: an eye in water in glass sees through both") {
  Scene scene = empty_scene();
  add_sphere(scene, {{0, 0, 0}, 1, add_material(scene, clear(1.5))}, {});
  add_sphere(scene, {{0, 0, 0}, 0.6, add_material(scene, clear(1.33))}, {});
  const raytrace::Prepared prepared(scene);
  Random random(73);
  Worst error;
  std::uint64_t outside = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 8; left > 0; --left) {
    const glm::dvec3 eye = 0.55 * std::cbrt(random.uniform()) * random.direction();
    const RayRecord root = tree_of(prepared, eye, eye + random.direction());
    const RayRecord* ray = &root;
    while (!ray->children.empty() && ray->children[0].kind == RayKind::refracted) ray = &ray->children[0];
    const auto offset = [](const RayRecord& r) {
      return length(cross(quad(r.origin), unit_of(r.direction)));
    };
    const Quad expected = 1.33 * offset(root);
    if (!ray->background || ray->depth != 3 || !(expected < 1)) continue;
    ++outside;
    const Quad condition = 1 + 1.5 * 1.5 / square_root(1 - expected * expected);
    error.add(magnitude(offset(*ray) - expected) / (kEps * condition));
  }
  CHECK(outside > 0);
  HardCase("REF-5").at_most("error of n b through water and glass in eps (1 + n²/cos t)", error,
                            2 * (16 + 8));
}

TEST_CASE("REF-5: the side that a ray comes from is that of D.N") {
  Random random(79);
  VisibilityCounts counts;
  std::uint64_t wrong = 0, hits = 0;
  const Scene ball = scene_of(Sphere{{1, 2, 3}, 2, 0}), star = scene_of(star_sphere(16, 16, 0.3, 3));
  for (std::uint64_t left = tier_count("rays_per_case") / 2; left > 0; --left)
    for (const Scene* scene : {&ball, &star}) {
      const Ray ray = make_ray(random.in_box(3), random.direction());
      const Hit hit = nearest_of_all(*scene, ray, kRayStart, counts);
      if (!hit.found()) continue;
      ++hits;
      Quad along = 0;
      if (scene == &ball) {
        along =
            dot(quad(ray.origin) + Quad(hit.t) * quad(ray.direction) - quad({1, 2, 3}), quad(ray.direction));
      } else {
        const auto& v = scene->triangles[hit.primitive].vertex;
        const auto at = [&](std::size_t k) { return quad(scene->positions[v[k]]); };
        along = dot(cross(at(1) - at(0), at(2) - at(0)), quad(ray.direction));
      }
      // Within the rounding of t, a tangent has no side.
      if (magnitude(along) > 64 * kEps) wrong += locate(*scene, ray, hit, counts).entering != (along < 0);
    }
  HardCase("REF-5").none("sides unlike the sign of D.N", wrong, hits);
}

// One chain of rays, since nothing is mirrored but by total reflection: with c3 = 1 all light that is not lost in the
// dark of the depth limit comes back, so a picture before a background of 1 and the weight of the rays not sent add up
// to 1.
TEST_CASE("REF-7: light trapped in a cube and in a gem of index 2.4") {
  const HardCase trapped("REF-7");
  std::uint64_t pixels_over = 0, rays_over = 0, pictures = 0, pixels = 0;
  Worst balance;
  double farther = 0, nearer = 0;  // greatest differences between depth 20 and 100, 5 and 20
  PolygonMesh cube = make_box({1, 1, 1}), gem = star_sphere(9, 8, 0.3, 3);
  for (PolygonMesh* mesh : {&cube, &gem})
    for (PolygonMesh::Face& face : mesh->faces) face.material = 1;
  // In a cube light is free at once or for ever; in a gem it may find its way out late.
  const std::pair<const PolygonMesh*, glm::dvec3> views[]{
      {&cube, {0.1, 0.2, 0.3}}, {&cube, {1.1, 1.4, 2.5}}, {&gem, {0.1, 0.2, 0.3}}, {&gem, {1.1, 1.4, 2.5}}};
  for (const auto& [mesh, eye] : views)
    for (const double refract : {1.0, 0.9})
      for (const double cut : {0.0, 1e-3}) {
        std::vector<Frame> frames;
        for (const int depth : {5, 20, 100}) {
          Scene scene = empty_scene();
          scene.background = glm::dvec3(1);
          add_material(scene, clear(2.4, refract));
          add_mesh(scene, *mesh, {}, {});
          scene.camera.eye = eye;
          scene.camera.look_at = {-0.3, -0.1, -0.2};
          scene.trace.depth = depth;
          scene.trace.contribution_cut = cut;
          const int edge = std::min(tier_edge() / 3, 160);
          const Camera camera = square_camera(scene, edge);
          on_small_stack(kSmallStack, [&] {
            RenderOptions options = test::keeping(0);
            options.threads = 1;
            frames.push_back(test::traced(scene, camera, options));
          });
          const Frame& frame = frames.back();
          double sum = 0;
          for (const glm::vec3& c : frame.color) {
            pixels_over += !(c.x <= 1);
            sum += c.x;
          }
          const auto count = static_cast<double>(frame.pixels());
          if (refract == 1) balance.add(std::abs(sum / count + frame.stats.cut_weight - 1));
          const RayCounts& rays = frame.stats.rays;
          rays_over +=
              rays.reflection + rays.refraction > static_cast<std::uint64_t>(depth - 1) * frame.pixels();
          pixels += frame.pixels();
          ++pictures;
        }
        const auto greatest = [&](const Frame& a, const Frame& b) {
          double most = 0;
          for (std::size_t i = 0; i < a.pixels(); ++i)
            most = std::max(most, std::abs(double{a.color[i].x} - double{b.color[i].x}));
          return most;
        };
        if (refract < 1) nearer = std::max(nearer, greatest(frames[0], frames[1]));
        if (refract < 1) farther = std::max(farther, greatest(frames[1], frames[2]));
      }
  trapped.none("pixels brighter than the brightest source", pixels_over, pixels);
  trapped.none("pictures with more rays than depth times pixels, on a stack of 256 KiB", rays_over, pictures);
  trapped.at_most("light that comes back and light not sent, off 1", balance, 1e-12);
  CHECK(nearer > 0);
  trapped.at_most("greatest change from depth 20 to 100 over that from 5 to 20", farther / nearer, 1);
}
