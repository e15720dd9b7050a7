// SPDX-License-Identifier: MIT
// Packets answer as single rays do, ray by ray and bit for bit: EyePackets as nearest() and leaving_point(),
// ShadowPackets as blocker(). (That pictures agree as well is test_wave.cpp's.)
#include <doctest/doctest.h>

#include "common/model/place.h"
#include "raytrace/eye_packets.h"
#include "raytrace/secondary.h"
#include "raytrace/shadow_packets.h"
#include "raytrace/wave.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::Prepared;

namespace {

// What is drawn lies around `center`: triangles of all sizes that touch and repeat, a finely faceted ball, balls, planes.
struct Drawn {
  glm::dvec3 center{0};
  double grid = 0;  // 0: vertices anywhere
};

glm::dvec3 place(const Drawn& drawn, Random& random, int cells) {
  return drawn.center + (drawn.grid > 0 ? drawn.grid * random.on_grid(cells)
                                        : random.in_box(static_cast<double>(cells) * 0x1p-4));
}

Scene drawn_scene(const Drawn& drawn, Random& random) {
  Scene scene = empty_scene();
  Material ghost;
  ghost.name = "ghost";
  ghost.casts_shadow = false;
  add_material(scene, ghost);
  std::vector<glm::dvec3> positions;
  std::vector<Face> faces;
  const std::uint32_t triangles = 1 + random.below(150);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const glm::dvec3 at = place(drawn, random, 32);
    const double size = random.log_uniform(0x1p-8, 1);
    for (int k = 0; k < 3; ++k)
      positions.push_back(drawn.grid > 0 ? at + drawn.grid * random.on_grid(8)
                                         : at + size * random.in_box(1));
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    if (random.below(20) == 0) faces.push_back(faces[random.below(i + 1)]);
  }
  PolygonMesh soup = mesh_of(positions, faces);
  for (PolygonMesh::Face& face : soup.faces) face.material = random.below(4) == 0 ? 1 : 0;
  add_mesh(scene, soup, {}, {});
  if (random.uniform() < 0.5) {
    PolygonMesh ball = star_sphere(40, 60, 0.1, random.bits());
    const glm::dvec3 at = place(drawn, random, 16);
    for (glm::dvec3& p : ball.positions) p = at + 0.5 * p;
    add_mesh(scene, ball, {}, {});
  }
  for (std::uint32_t left = random.below(6); left > 0; --left)
    add_sphere(scene, {place(drawn, random, 32), random.uniform(0.05, 0.6), random.below(2)}, {});
  for (std::uint32_t left = random.below(3); left > 0; --left)
    add_plane(
        scene,
        {place(drawn, random, 32), left == 1 ? glm::dvec3(0, 1, 0) : random.direction(), random.below(2)},
        {});
  return scene;
}

Camera drawn_camera(Scene& scene, const Drawn& drawn, Random& random) {
  scene.camera.eye = place(drawn, random, random.uniform() < 0.3 ? 16 : 96);
  scene.camera.look_at = place(drawn, random, 16);
  if (scene.camera.look_at == scene.camera.eye) scene.camera.look_at.z -= 1;
  scene.camera.up = random.direction();
  scene.camera.view_height = random.log_uniform(0.01, 2);
  return make_camera(scene.camera, 53, 39, 1);
}

// One of raytrace::ShadowQueries.
struct ShadowQuery {
  glm::dvec3 from{0};
  std::uint32_t own = kNone;
};

// Where rays to lights leave: all that the eye sees.
std::vector<ShadowQuery> seen_places(const Prepared& prepared, const Camera& camera) {
  std::vector<ShadowQuery> queries;
  VisibilityCounts counts;
  for (int Y = 0; Y < camera.rows(); ++Y)
    for (int X = 0; X < camera.columns(); ++X) {
      const Ray ray{camera.eye, camera.direction(X, Y)};
      const Hit hit = nearest(prepared, ray, kRayStart, counts);
      if (!hit.found()) continue;
      const Place at = locate(prepared.scene, ray, hit, counts);
      ShadowQuery query{leaving_point(prepared, ray, hit, at, counts), hit.primitive};
      if (primitive_ref(prepared.scene, hit.primitive).kind == ObjectKind::sphere &&
          !raytrace::is_entering(prepared.scene, ray, hit, at.facing))
        query.own = kNone;
      queries.push_back(query);
    }
  return queries;
}

// The light is on the side of the surface on which the point lies, as ShadowQueries ask for.
bool faces_light(const Scene& scene, const ShadowQuery& query, const Light& light) {
  if (query.own == kNone) return true;
  const PrimitiveRef ref = primitive_ref(scene, query.own);
  glm::dvec3 normal, on;
  if (ref.kind == ObjectKind::mesh) {
    const auto [v0, v1, v2] = corners(scene, scene.triangles[ref.index]);
    normal = glm::cross(v1 - v0, v2 - v0);
    on = v0;
  } else if (ref.kind == ObjectKind::plane) {
    normal = scene.planes[ref.index].normal;
    on = scene.planes[ref.index].point;
  } else {
    normal = query.from - scene.spheres[ref.index].center;
    on = scene.spheres[ref.index].center;
  }
  const double from_side = glm::dot(query.from - on, normal);
  const double light_side = glm::dot(raytrace::ray_to_light(query.from, light).direction, normal);
  return from_side * light_side > 0;
}

struct Counts {
  std::uint64_t asked = 0, different = 0, positive = 0, alone = 0;  // positive: hits, and dark places

  Counts& operator+=(const Counts& more) {
    asked += more.asked;
    different += more.different;
    positive += more.positive;
    alone += more.alone;
    return *this;
  }
};

Counts check_eye(const Prepared& prepared, const Camera& camera, Isa isa) {
  Counts result;
  VisibilityCounts counts;
  raytrace::EyePackets packets(prepared, camera, isa);
  std::vector<Hit> hits;
  std::vector<std::uint8_t> alone;
  for (const auto& [X0, Y0, columns, rows] : {std::array{0, 0, 32, 32}, {32, 0, 21, 32}, {3, 32, 50, 7}}) {
    packets.trace(X0, Y0, columns, rows, hits, alone, counts);
    const std::vector<std::uint32_t> order = raytrace::EyePackets::order(columns, rows);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto sample = static_cast<int>(order[i]);
      const Ray ray{camera.eye, camera.direction(X0 + sample % columns, Y0 + sample / columns)};
      const Hit expected = nearest(prepared, ray, kRayStart, counts);
      ++result.asked;
      result.different += hits[i].primitive != expected.primitive;
      result.positive += expected.found();
      if (!expected.found() || !alone[i] || expected.t >= 16 * packets.reach() / packets.ray_length())
        continue;
      const Place at = locate(prepared.scene, ray, expected, counts);
      result.different +=
          leaving_point(prepared, ray, expected, at, counts) != at.point + at.clearance * at.facing;
      ++result.alone;
    }
  }
  return result;
}

Counts check_shadows(const Prepared& prepared, const Light& light, const std::vector<ShadowQuery>& queries,
                     bool seen_by_eye, Isa isa) {
  Counts result;
  VisibilityCounts counts;
  raytrace::ShadowQueries asked;
  asked.seen_by_eye = seen_by_eye;
  asked.resize(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    asked.x[i] = queries[i].from.x;
    asked.y[i] = queries[i].from.y;
    asked.z[i] = queries[i].from.z;
    asked.own[i] = static_cast<std::int32_t>(queries[i].own);
    asked.asks[i] = faces_light(prepared.scene, queries[i], light);
  }
  raytrace::ShadowPackets packets(prepared, isa);
  std::vector<std::uint8_t> dark;
  packets.trace(light, asked, dark, counts);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (asked.asks[i] == 0) {
      result.different += dark[i] != 0;
      continue;
    }
    const Ray ray = raytrace::ray_to_light(queries[i].from, light);
    const bool expected =
        blocker(prepared, ray, light.directional ? nullptr : &light.position, counts).found();
    ++result.asked;
    result.different += (dark[i] != 0) != expected;
    result.positive += expected;
  }
  return result;
}

std::uint64_t scenes() { return 4 + tier_count("rays_per_case") / 50000; }

Counts check_all(const Drawn& drawn, std::uint64_t seed) {
  Random random(seed);
  Counts eye, shadow;
  for (std::uint64_t left = scenes(); left > 0; --left) {
    CAPTURE(left);
    Scene scene = drawn_scene(drawn, random);
    const Camera camera = drawn_camera(scene, drawn, random);
    const Prepared prepared(scene);
    std::vector<ShadowQuery> queries = seen_places(prepared, camera);
    for (int i = 0; i < 300; ++i) queries.push_back({place(drawn, random, 40), kNone});
    const std::array lights{lamp(place(drawn, random, 20), 1), lamp(place(drawn, random, 200), 1),
                            lamp(queries.back().from, 1), lamp(drawn.center + 1e7 * random.direction(), 1),
                            sun(random.direction(), 1)};
    for (const Isa isa : kIsas) {
      if (!machine_has(isa)) continue;
      eye += check_eye(prepared, camera, isa);
      for (const Light& light : lights)
        shadow += check_shadows(prepared, light, queries, random.uniform() < 0.5, isa);
    }
  }
  CHECK(eye.different == 0);
  CHECK(shadow.different == 0);
  CHECK(eye.positive > 0);
  CHECK(shadow.positive > 0);
  CHECK(shadow.positive < shadow.asked);
  return eye;
}

}  // namespace

TEST_CASE("packets are nearest and blocker, ray by ray: drawn scenes") {
  CHECK(check_all({}, 300).alone > 0);
}
TEST_CASE("packets are nearest and blocker, ray by ray: vertices, eyes and lights on a grid") {
  CHECK(check_all({{0, 0, 0}, 0x1p-4}, 301).alone > 0);
}
TEST_CASE("packets are nearest and blocker, ray by ray: far from the world's origin") {
  check_all({{1e6, -3e5, 2e6}, 0}, 302);
  check_all({{0x1p20, 0x1p18, -0x1p21}, 0x1p-4}, 303);
}

// Where a triangle's least or greatest u or v is that of a ray, exactly.
TEST_CASE("packets are nearest and blocker, ray by ray: vertices on rays") {
  Random random(304);
  const Camera camera = plain_camera(53, 39);
  Counts eye, shadow;
  for (std::uint64_t left = scenes(); left > 0; --left) {
    std::vector<glm::dvec3> positions;
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < 400; ++i) {
      const auto X = random.between(0, 52), Y = random.between(0, 38);
      for (int k = 0; k < 3; ++k)
        positions.push_back(static_cast<double>(random.between(8, 12)) * 0x1p-5 *
                            camera.direction(static_cast<int>(X + random.integer(3)),
                                             static_cast<int>(Y + random.integer(3))));
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Scene scene = scene_of(mesh_of(positions, faces));
    const Prepared prepared(scene);
    const std::vector<ShadowQuery> queries = seen_places(prepared, camera);
    for (const Isa isa : kIsas) {
      if (!machine_has(isa)) continue;
      eye += check_eye(prepared, camera, isa);
      shadow += check_shadows(prepared, lamp({3, 20, 5}, 1), queries, true, isa);
    }
  }
  CHECK(eye.different == 0);
  CHECK(shadow.different == 0);
  CHECK(eye.positive > 0);
  CHECK(shadow.positive > 0);
}
