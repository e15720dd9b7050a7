// SPDX-License-Identifier: MIT
// Hard cases of rays that leave a surface, beside those of tests/model: the neighbours of the triangle that is left
// (SEC-3), a ball that rests on a plane (SEC-4), and no length that is fixed in scene units (SEC-6).
#include <doctest/doctest.h>

#include <cmath>

#include "common/scene/shapes.h"
#include "raytrace/prepared.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// As the tracer starts a ray, on the side that `ray` came from.
struct Departure {
  glm::dvec3 from{0}, facing{0};
};
Departure departure(const Scene& scene, const Ray& ray, const Hit& hit) {
  VisibilityCounts counts;
  const Place place = locate(scene, ray, hit, counts);
  return {start_of_leaving(scene, ray, hit, place, counts), place.facing};
}

// Rays that leave where `ray` meets the scene and meet it again. At an edge of a body's outline front and back have one
// depth, and the lower number is seen: rays that leave such a back stay inside, rightly, and are not counted.
struct Again {
  std::uint64_t hits = 0, rays = 0;
};
void leave(const Scene& scene, const Ray& ray, Random& random, Again& again) {
  VisibilityCounts counts;
  const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
  if (!hit.found()) return;
  if (scene.objects[0].closed && !locate(scene, ray, hit, counts).entering) return;
  const Departure start = departure(scene, ray, hit);
  for (int i = 0; i < 16; ++i, ++again.rays)
    again.hits +=
        nearest_of_all(scene, make_ray(start.from, outward(start.facing, random)), kRayStart, counts).found();
}

// All lengths times 2^k, what falls with the distance accordingly.
Scene scaled(Scene scene, int k) {
  const double s = std::exp2(k);
  const auto scale = [&](Attenuation& q) {
    q.q1 /= s;
    q.q2 /= s * s;
  };
  for (glm::dvec3& p : scene.positions) p *= s;
  for (Sphere& sphere : scene.spheres) sphere.center *= s, sphere.radius *= s;
  for (Plane& plane : scene.planes) plane.point *= s;
  for (Light& light : scene.lights) light.position *= s, scale(light.attenuation);
  scene.camera.eye *= s;
  scene.camera.look_at *= s;
  scale(scene.trace.secondary_attenuation);
  return scene;
}

// Whether two trees of rays are the same but for the scale of their points.
bool same_rays(const RayRecord& a, const RayRecord& b, double scale) {
  if (scale * a.origin != b.origin || a.color != b.color || a.children.size() != b.children.size())
    return false;
  if (a.background != b.background || a.local.surface.clearance * scale != b.local.surface.clearance)
    return false;
  for (std::size_t i = 0; i < a.children.size(); ++i)
    if (!same_rays(a.children[i], b.children[i], scale)) return false;
  return true;
}

}  // namespace

// A parallelogram on a grid: its two triangles lie in one plane, exactly, and then moved by up to 1e6 of its size, which
// tilts them by 1e-10 at most, far less than the rays that leave.
TEST_CASE("SEC-3: rays that leave the diagonal of a quad, or an edge of an octahedron") {
  Random random(51);
  Again quad_again, edge_again;
  const std::uint64_t some = 1 + tier_count("rays_per_case") / 32;
  for (std::uint64_t left = some; left > 0; --left) {
    const glm::dvec3 e1 = random.on_grid(1 << 10), e2 = random.on_grid(1 << 10);
    const glm::dvec3 v0 = left % 2 ? random.on_grid(1 << 10) : random.in_box(random.log_uniform(1, 1e9));
    const Scene quad = scene_of(mesh_of({v0, v0 + e1, v0 + e1 + e2, v0 + e2}, {{0, 1, 2}, {0, 2, 3}}));
    const glm::dvec3 on_diagonal = v0 + random.uniform() * (e1 + e2), origin = v0 + random.in_box(1 << 12);
    leave(quad, make_ray(origin, on_diagonal - origin), random, quad_again);

    const glm::dvec3 center = random.in_box(random.log_uniform(1, 1e6));
    const Scene body = scene_of(octahedron(center, 1));
    const auto& v = body.triangles[random.below(8)].vertex;
    const glm::dvec3 a = body.positions[v[0]], b = body.positions[v[1]],
                     eye = center + 5.0 * random.direction();
    leave(body, make_ray(eye, a + random.uniform() * (b - a) - eye), random, edge_again);
  }
  const HardCase neighbours("SEC-3");
  neighbours.none("rays that leave the diagonal of a quad and meet either half", quad_again.hits,
                  quad_again.rays);
  neighbours.none("rays that leave an edge of an octahedron and meet it again", edge_again.hits,
                  edge_again.rays);
}

// At a distance x from the contact the gap is x²/2. An origin over the ball stands 32 u off it (locate: 16 u (|c| + r)),
// so a ray could start beyond the floor only where x < 8e-8: less than one in 10^8 of the points within 1e-3.
TEST_CASE("SEC-4: no ray that leaves next to the contact of ball and floor sees what lies below the floor") {
  Scene scene = empty_scene();
  add_sphere(scene, {{0, 1, 0}, 1, 0}, {});
  add_plane(scene, {{0, 0, 0}, {0, 1, 0}, 0}, {});
  add_plane(scene, {{0, -1, 0}, {0, 1, 0}, 0}, {});
  const raytrace::Prepared prepared(scene);
  Random random(53);
  VisibilityCounts counts;
  std::uint64_t leaked = 0, rays = 0, below = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 4; left > 0; --left) {
    // Inside the gap or inside the ball, from where a ray meets one of the two.
    const double x = 1e-3 * std::sqrt(random.uniform()), angle = random.uniform(0, 6.28), gap = x * x / 2;
    const double height = left % 2 ? gap * random.uniform(0.1, 0.9) : 2 * gap + 1e-6 * random.uniform();
    const Ray ray = make_ray({x * std::cos(angle), height, x * std::sin(angle)}, random.direction());
    const Hit hit = raytrace::nearest(prepared, ray, kRayStart, counts);
    if (!hit.found()) continue;  // out of the gap
    below += hit.primitive == 2;
    const Departure start = departure(scene, ray, hit);
    for (int i = 0; i < 4; ++i, ++rays) {
      const Ray on = make_ray(start.from, outward(start.facing, random));
      leaked += raytrace::nearest(prepared, on, kRayStart, counts).primitive == 2;
    }
  }
  const HardCase contact("SEC-4");
  contact.none("first hits below the floor", below, 1 + tier_count("rays_per_case") / 4);
  contact.none("rays from the contact that see what lies below the floor", leaked, rays);
}

// What lies below shines a million times brighter than anything else.
TEST_CASE("SEC-4: a glass ball on a floor, seen at the contact from outside and from inside") {
  Scene scene = empty_scene();
  scene.ambient = glm::dvec3(1);
  Material glass, light;
  glass.reflect = glm::dvec3(0.5);
  glass.refract = glm::dvec3(0.5);
  glass.ior = 1.5;
  light.ambient = glm::dvec3(1e6);
  add_sphere(scene, {{0, 1, 0}, 1, add_material(scene, glass)}, {});
  add_plane(scene, {{0, 0, 0}, {0, 1, 0}, 0}, {});
  add_plane(scene, {{0, -1, 0}, {0, 1, 0}, add_material(scene, light)}, {});
  scene.lights.push_back(lamp({3, 5, 2}, 1));
  scene.camera.look_at = {0, 0, 0};
  std::uint64_t bright = 0, pixels = 0;
  for (const glm::dvec3& eye : {glm::dvec3(0.02, 1e-5, 0.01), glm::dvec3(0.3, 0.5, 0.1)}) {
    scene.camera.eye = eye;
    scene.camera.view_height = 2e-3 / glm::length(eye);  // 1e-3 around the contact
    const Frame frame = test::traced(scene, square_camera(scene));
    for (const glm::vec3& c : frame.color) bright += !(c.x < 1e3f);
    pixels += frame.pixels();
  }
  HardCase("SEC-4").none("pixels at the contact of a glass ball that show light from below the floor", bright,
                         pixels);
}

TEST_CASE("SEC-6: origins and colours of all rays of a scene scale exactly") {
  Scene scene = empty_scene();
  scene.background = {0.1, 0.2, 0.3};
  scene.materials[0].reflect = glm::dvec3(0.3);
  Material glass;
  glass.specular = glm::dvec3(0.5);
  glass.refract = glm::dvec3(0.75);
  glass.reflect = glm::dvec3(0.125);
  glass.ior = 1.5;
  const std::uint32_t clear = add_material(scene, glass);
  add_sphere(scene, {{-0.7, 0.5, 0.2}, 0.5, clear}, {});
  add_mesh(scene, make_torus(0.75, 0.25, 16, 8), {}, {});
  add_plane(scene, {{0, -0.4, 0}, {0, 1, 0}, 0}, {});
  scene.lights.push_back(lamp({2, 5, 3}, 1));
  scene.lights[0].attenuation = {1, 0.01, 0.002};
  scene.trace.secondary_attenuation = {1, 0.05, 0.01};
  scene.camera.eye = {0.5, 1.5, 3};
  scene.camera.look_at = {0, 0, 0};
  const int edge = std::min(tier_edge(), 128);
  const Camera camera = square_camera(scene, edge);
  const auto prepared = raytrace::prepare(scene);
  std::uint64_t changed = 0, trees = 0;
  for (const int k : {-20, -10, 10, 20}) {
    const Scene other = scaled(scene, k);
    const auto other_prepared = raytrace::prepare(other);
    const Camera other_camera = make_camera(other.camera, edge, edge, 1);
    for (int Y = 0; Y < edge; ++Y)
      for (int X = 0; X < edge; ++X, ++trees)
        changed += !same_rays(raytrace::explain(*prepared, camera, X, Y),
                              raytrace::explain(*other_prepared, other_camera, X, Y), std::exp2(k));
  }
  HardCase("SEC-6").none("trees of rays that a scale from 2^-20 to 2^20 changes in any bit", changed, trees);
}
