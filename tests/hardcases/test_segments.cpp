// SPDX-License-Identifier: MIT
// Hard cases of triangles as the tracer asks for them, through its hierarchy and with every instruction set: rays in
// their plane (TRI-6) and segments that end on them (TRI-10).
#include <doctest/doctest.h>

#include "raytrace/prepared.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

// Many triangles of one plane, on a grid, so that the eye lies in it exactly: no ray meets one of them, whatever asks.
TEST_CASE("TRI-6: no ray in the plane of triangles meets one, with any instruction set and in any picture") {
  Random random(61);
  VisibilityCounts counts;
  std::uint64_t hits = 0, rays = 0, shown = 0, pixels = 0;
  for (std::uint64_t left = 4 + tier_count("rays_per_case") / 20'000; left > 0; --left) {
    const glm::dvec3 v0 = random.on_grid(1 << 16), e1 = random.on_grid(1 << 16), e2 = random.on_grid(1 << 16);
    const auto in_plane = [&] {
      return static_cast<double>(random.integer(9)) * e1 + static_cast<double>(random.integer(9)) * e2;
    };
    std::vector<glm::dvec3> positions;
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < 60; ++i) {
      for (int k = 0; k < 3; ++k) positions.push_back(v0 + in_plane());
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    Scene scene = scene_of(mesh_of(positions, faces));
    const raytrace::Prepared prepared(scene);
    for (int i = 0; i < 50; ++i) {
      const Ray ray{v0 + in_plane(), in_plane()};
      const glm::dvec3 light = ray.origin + ray.direction;
      if (ray.direction == glm::dvec3(0)) continue;
      for (const Isa isa : kIsas) {
        if (!machine_has(isa)) continue;
        ++rays;
        constexpr auto exact = raytrace::Precision::exact;
        hits += raytrace::nearest(prepared, ray, kRayStart, counts, exact, isa).found() ||
                raytrace::blocker(prepared, ray, nullptr, counts, kRayStart, exact, isa).found() ||
                raytrace::blocker(prepared, ray, &light, counts, kRayStart, exact, isa).found() ||
                !raytrace::hits_between(prepared, ray, {0, 0}, std::numeric_limits<double>::infinity(),
                                        counts, isa)
                     .empty();
      }
    }
    scene.camera.eye = v0 + in_plane();
    scene.camera.look_at = v0 + 0.5 * (e1 + e2);
    if (scene.camera.eye == scene.camera.look_at) continue;
    const Camera camera = make_camera(scene.camera, 20, 15, 1);
    for (const Frame& frame : {rastered(scene, camera), traced(scene, camera)})
      for (const std::uint32_t id : frame.object_id) {
        ++pixels;
        shown += id != 0;
      }
  }
  const HardCase graze("TRI-6");
  graze.none("rays in the plane of 60 triangles that meet one, with any instruction set", hits, rays);
  graze.none("pixels of triangles in whose plane the eye lies", shown, pixels);
}

// Half of the segments end at a light on a surface, as far as doubles let it lie there, and so are aimed at it: a point
// of a face, of an edge, a vertex; of a ball, of the floor. That a blocker stands somewhere on a segment asks the same as
// whether one of the hits in order does; each instruction set is asked in turn.
TEST_CASE("TRI-10: something blocks a segment iff one of the hits along it stands before its end") {
  Random random(67);
  Scene scene = scene_of(star_sphere(24, 24, 0.4, 9));
  const Sphere ball{{1.5, 0.5, 0}, 0.75, 0};
  const glm::dvec3 floor_point(0, -1.25, 0), floor_normal(0.1, 1, 0.2);
  add_sphere(scene, ball, {});
  add_sphere(scene, {{-2, 0, 1}, 0.5, 0}, {});
  add_plane(scene, {floor_point, floor_normal, 0}, {});
  const raytrace::Prepared prepared(scene);
  std::vector<Isa> isas;
  for (const Isa isa : kIsas)
    if (machine_has(isa)) isas.push_back(isa);
  const auto on_mesh = [&] {
    const auto& v = scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))].vertex;
    const double b = random.below(3) == 0 ? 0 : random.uniform();
    const double c = random.below(2) == 0 ? 0 : random.uniform() * (1 - b);
    const glm::dvec3 corner = scene.positions[v[0]];
    return corner + b * (scene.positions[v[1]] - corner) + c * (scene.positions[v[2]] - corner);
  };
  VisibilityCounts counts;
  std::uint64_t differing = 0, blocked = 0, all = 0;
  for (std::uint64_t left = tier_count("rays_per_case"); left > 0; --left, ++all) {
    const glm::dvec3 origin = random.in_box(3);
    glm::dvec3 light = random.in_box(3);
    switch (random.below(8)) {
      case 0:
        light = ball.center + ball.radius * random.direction();
        break;
      case 1:
        light = floor_point + glm::cross(floor_normal, random.in_box(2));
        break;
      case 2:
      case 3:
        light = on_mesh();
        break;
    }
    const Isa isa = isas[left % isas.size()];
    const Ray ray = make_ray(origin, light - origin);
    bool before_end = false;
    const Hit first = raytrace::nearest(prepared, ray, kRayStart, counts);
    for (Hit hit = first; hit.found() && hit.t < 1 + 1e-6 && !before_end;
         hit = raytrace::nearest(prepared, ray, hit, counts))
      before_end = before_light(scene, hit, ray, light, counts);
    constexpr auto exact = raytrace::Precision::exact;
    const bool there = raytrace::blocker(prepared, ray, &light, counts, kRayStart, exact, isa).found();
    const bool beyond = raytrace::blocker(prepared, ray, nullptr, counts, kRayStart, exact, isa).found();
    blocked += before_end;
    differing += there != before_end || beyond != first.found();
  }
  CHECK(blocked > all / 10);
  CHECK(blocked < all * 9 / 10);
  HardCase("TRI-10").none("segments on which a blocker and the hits in order disagree", differing, all);
}
