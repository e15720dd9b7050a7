// SPDX-License-Identifier: MIT
// Hard cases of refraction beside those of tests/model: invisible glass (REF-2), interfaces that coincide (REF-4), an
// eye inside glass (REF-5), trapped light (REF-7) and absurd indices (REF-8).
#include <doctest/doctest.h>
#include <pthread.h>

#include <cmath>
#include <functional>

#include "common/model/optics.h"
#include "common/scene/shapes.h"
#include "raytrace/prepared.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/scene/toml_text.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/support/worst.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr double kEps = 0x1p-52;

// Nothing but refraction, of this index.
Material clear(double ior, double refract = 1) {
  Material material;
  material.local = glm::dvec3(0);
  material.refract = glm::dvec3(refract);
  material.ior = ior;
  material.casts_shadow = false;
  return material;
}

Camera square_camera(const Scene& scene) { return make_camera(scene.camera, tier_edge(), tier_edge(), 1); }

// Squares of two materials on y = -1, from -8 to 8.
void add_checkers(Scene& scene) {
  Material dark;
  dark.diffuse = glm::dvec3(0.05);
  const std::uint32_t black = add_material(scene, dark);
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  for (int x = -8; x < 8; ++x)
    for (int z = -8; z < 8; ++z) {
      const auto first = static_cast<std::uint32_t>(positions.size());
      for (const glm::dvec3& p : {glm::dvec3(x, -1, z), glm::dvec3(x, -1, z + 1),
                                  glm::dvec3(x + 1, -1, z + 1), glm::dvec3(x + 1, -1, z)})
        positions.push_back(p);
      faces.push_back({first, first + 1, first + 2});
      faces.push_back({first, first + 2, first + 3});
    }
  PolygonMesh mesh = mesh_of(positions, faces);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    if ((i / 2 + i / 32) % 2 == 1) mesh.faces[i].material = black;
  add_mesh(scene, mesh, {}, {});
}

// ---- REF-4 ----

// Glass around a cavity around water, last; the other objects before or after them. Smooth surroundings, so that a
// ray that is bent a little otherwise comes back with a little other colour.
enum class Order { others_first, others_last };
Scene drink(double cavity, double water, Order order) {
  Scene scene = empty_scene();
  scene.background = {0.3, 0.4, 0.5};
  scene.ambient = glm::dvec3(0.2);
  scene.materials[0].ambient = glm::dvec3(1);
  const std::uint32_t glass = add_material(scene, clear(1.5)), air = add_material(scene, clear(1)),
                      wet = add_material(scene, clear(1.33));
  const auto add_others = [&] { add_plane(scene, {{0, -1.2, 0}, {0, 1, 0}, 0}, {}); };
  if (order == Order::others_first) add_others();
  add_sphere(scene, {{0, 0, 0}, 1, glass}, {});
  if (cavity > 0) add_sphere(scene, {{0, 0, 0}, cavity, air}, {});
  add_sphere(scene, {{0, 0, 0}, water, wet}, {});
  if (order == Order::others_last) add_others();
  scene.lights.push_back(lamp({2, 5, 3}, 1));
  scene.camera.eye = {0, 1, 4};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.view_height = 0.6;
  scene.trace.depth = 20;
  return scene;
}
// The same with meshes of the same vertices for cavity and water.
Scene faceted_drink(Order order) {
  Scene scene = drink(0, 1e-3, order);
  Scene out = scene;
  PolygonMesh mesh = star_sphere(16, 16, 0, 1);
  for (glm::dvec3& p : mesh.positions) p *= 0.9;
  for (const std::uint32_t material : {2u, 3u}) {
    for (PolygonMesh::Face& face : mesh.faces) face.material = material;
    add_mesh(out, mesh, {}, {});
  }
  return out;
}

Camera camera_at(const Scene& scene) {
  const int edge = std::min(tier_edge() / 3, 160);
  return make_camera(scene.camera, edge, edge, 1);
}

struct Apart {
  double mean = 0;        // of the absolute differences over that of the colours
  double share_over = 0;  // of pixels that differ by more than 5 %
};
Apart apart(const Scene& a, const Scene& b) {
  const Frame p = testing::traced(a, camera_at(a)), q = testing::traced(b, camera_at(b));
  double difference = 0, sum = 0;
  std::uint64_t over = 0;
  for (std::size_t i = 0; i < p.pixels(); ++i) {
    const double off = std::abs(double{p.color[i].y} - double{q.color[i].y});
    difference += off;
    sum += p.color[i].y;
    over += !(off <= 0.05 * std::max(p.color[i].y, q.color[i].y));
  }
  return {difference / sum, static_cast<double>(over) / static_cast<double>(p.pixels())};
}

// ---- REF-5 ----

RayRecord tree_of(const raytrace::Prepared& prepared, const glm::dvec3& eye, const glm::dvec3& towards) {
  CameraSettings settings;
  settings.eye = eye;
  settings.look_at = towards;
  settings.view_height = 0x1p-10;
  return raytrace::explain(prepared, make_camera(settings, 1, 1, 1), 0, 0);
}
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

TEST_CASE("REF-2: glass of index 1 is not seen, before checkers and mirrors") {
  Scene without = empty_scene();
  without.background = {0.1, 0.2, 0.3};
  without.trace.depth = 24;
  without.lights.push_back(lamp({2, 5, 3}, 1));
  add_checkers(without);
  Material mirror;
  mirror.reflect = glm::dvec3(0.8);
  add_sphere(without, {{1.5, 0, -2}, 1, add_material(without, mirror)}, {});
  without.camera.eye = {0, 2, 6};
  without.camera.look_at = {0, -0.3, 0};
  Scene with = without;
  const std::uint32_t nothing = add_material(with, clear(1));
  PolygonMesh box = make_box({1, 1, 1}), star = star_sphere(12, 12, 0.3, 3);
  for (PolygonMesh* mesh : {&box, &star})
    for (PolygonMesh::Face& face : mesh->faces) face.material = nothing;
  add_sphere(with, {{-1, 0, 1}, 0.8, nothing}, {});
  add_mesh(with, box, {.translate = {0.2, -0.3, 2}}, {});
  add_mesh(with, star, {.translate = {1.2, 0.2, 1}}, {});
  const Frame a = testing::traced(without, square_camera(without)),
              b = testing::traced(with, square_camera(with));
  Worst error;
  std::uint64_t over = 0, through = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    const double off = std::abs(double{a.color[i].x} - double{b.color[i].x});
    error.add(off);
    over += !(off <= 1e-6);
    through += b.sample_primitive[i] != a.sample_primitive[i];
  }
  CHECK(through > a.pixels() / 20);
  const HardCase invisible("REF-2");
  invisible.at_most("greatest difference of a pixel with and without glass of index 1", error, 1e-5);
  invisible.at_most("share of pixels that differ by more than 1e-6",
                    static_cast<double>(over) / static_cast<double>(a.pixels()), 1e-3);
}

// Policy: of solids that contain a point the last in the file is the medium, and surfaces at one depth are crossed
// together. So a cavity filled to the brim is glass against water, as where the water overlaps the glass.
// A gap is another matter: its film of air reflects all light beyond the critical angle of glass and air (42 degrees;
// of glass and water 62), however thin it is, so the catalogue's limit "gap to 0 is the overlap" holds for waves and
// not for rays. For rays the limit is that the film's thickness ceases to matter.
TEST_CASE("REF-4: glass that touches water, overlaps it, and leaves a gap") {
  const HardCase nested("REF-4");
  const Scene touching = drink(0.9, 0.9, Order::others_first);
  const Apart overlap = apart(touching, drink(0.9, 0.901, Order::others_first));
  nested.at_most("share of pixels over 5 % apart, touching against overlapping by 1e-3", overlap.share_over,
                 1e-3);
  nested.at_most("mean difference, touching against overlapping by 1e-3", overlap.mean, 0.01);
  const Apart last_wins = apart(touching, drink(0, 0.9, Order::others_first));
  nested.at_most("mean difference, touching against water that displaces glass", last_wins.mean, 1e-6);
  const Apart thin =
      apart(drink(0.9, 0.9 - 1e-5, Order::others_first), drink(0.9, 0.9 - 1e-4, Order::others_first));
  nested.at_most("mean difference of a film of air 1e-5 thick and one of 1e-4", thin.mean, 0.01);
  const Apart film = apart(touching, drink(0.9, 0.9 - 1e-5, Order::others_first));
  nested.at_least("mean difference that such a film makes", film.mean, 0.02);

  std::uint64_t permuted = 0;
  const auto colors = [](const Scene& scene) { return testing::traced(scene, camera_at(scene)).color; };
  permuted += colors(touching) != colors(drink(0.9, 0.9, Order::others_last));
  permuted += colors(faceted_drink(Order::others_first)) != colors(faceted_drink(Order::others_last));
  nested.none("touching pictures that the order of the other objects changes in any bit", permuted, 2);
}

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
  SignCounts counts;
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
          const Camera camera = camera_at(scene);
          on_small_stack(kSmallStack, [&] {
            RenderOptions options = testing::keeping(0);
            options.threads = 1;
            frames.push_back(testing::traced(scene, camera, options));
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

// Between D and T lie i - t, tan i (n - 1) to first order: 1e-7 at 45 degrees, a float's eps.
TEST_CASE("REF-8: absurd indices are refused, and one next to 1 is Snell's law") {
  std::uint64_t accepted = 0, all = 0;
  for (const char* ior : {"0", "-1.5", "nan", "inf", "1e-10", "1e10", "0.2499", "4.001"}) {
    ++all;
    accepted += error_of(std::string("material.x.ior = ") + ior + kCamera).find("ior") == std::string::npos;
  }
  Random random(83);
  Worst against_snell, against_straight;
  constexpr double kIndex = 1 + 1e-7;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left) {
    const glm::dvec3 n = random.direction();
    const double sine = random.uniform(0, std::sqrt(0.5));
    const glm::dvec3 d = glm::normalize(sine * across(n, random) - std::sqrt(1 - sine * sine) * n);
    const std::optional<glm::dvec3> t = refract_direction(d, n, n, 1 / kIndex);
    REQUIRE(t);
    const QuadVec tangential = quad(d) - dot(quad(d), quad(n)) * quad(n);
    const Quad eta = 1 / Quad(kIndex);
    const QuadVec snell =
        eta * tangential - square_root(1 - eta * eta * dot(tangential, tangential)) * quad(n);
    against_snell.add(length(quad(*t) - snell) / kEps);
    against_straight.add(glm::length(*t - d) / 0x1p-23);
  }
  const HardCase absurd("REF-8");
  absurd.none("indices outside 0.25 to 4 that are let in", accepted, all);
  absurd.at_most("error of T for n = 1 + 1e-7, in eps", against_snell, 16);
  absurd.at_most("distance of T and D, up to 45 degrees, in float eps", against_straight, 2);
}
