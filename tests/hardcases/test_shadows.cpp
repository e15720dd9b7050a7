// SPDX-License-Identifier: MIT
// Hard cases of shadows and lights, in pictures: a light on a surface (SHA-1), inside a closed body (SHA-2), behind a
// surface (SHA-4), scenes far from the origin (SHA-7) and a light far away (SHA-8).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "common/scene/shapes.h"
#include "raytrace/prepared.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/support/worst.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// ---- SHA-1 ----

// A ball that nothing stands before, lit by a light that lies on something else.
struct LitBall {
  Scene scene;
  Sphere ball;
  std::uint32_t primitive = 0;
};

// N.L I kd f(d) of the ball's point in each pixel, worked out here in double, against the picture; where N.L is next to
// 0 the two may disagree on its sign, but not on its size.
void check_ball(const LitBall& lit, std::uint64_t& dark, std::uint64_t& pixels, Worst& error) {
  const Camera camera = square_camera(lit.scene);
  const Frame frame = test::traced(lit.scene, camera);
  const Light& light = lit.scene.lights[0];
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const std::size_t i = frame.index(x, y);
      if (frame.sample_primitive[i] != lit.primitive) continue;
      const glm::dvec3 d = glm::normalize(camera.direction(x, y)), f = camera.eye - lit.ball.center;
      const double b = glm::dot(f, d);
      const double t = -b - std::sqrt(b * b - glm::dot(f, f) + lit.ball.radius * lit.ball.radius);
      const glm::dvec3 n = (f + t * d) / lit.ball.radius, to_light = light.position - (camera.eye + t * d);
      const double distance = glm::length(to_light), cosine = glm::dot(n, to_light) / distance;
      const double expected =
          cosine > 0 ? 0.5 * cosine / (light.attenuation.q0 + light.attenuation.q2 * distance * distance) : 0;
      ++pixels;
      dark += cosine > 1e-5 && frame.color[i].x == 0;
      error.add(std::abs(frame.color[i].x - expected));
    }
}

LitBall ball_at(const glm::dvec3& center, const glm::dvec3& light) {
  LitBall lit;
  lit.scene = empty_scene();
  lit.ball = {center, 0.75, 0};
  lit.scene.lights.push_back(lamp(light, 1));
  lit.scene.lights[0].attenuation = {1, 0, 0.25};
  lit.scene.camera.look_at = center;
  // From the light's side, above it.
  lit.scene.camera.eye = light + glm::dvec3(0.3, 2, 0.5) * glm::length(center - light);
  return lit;
}

// ---- Shadows of two balls, by distance ----

// What three_things() below has, as seen from its middle: a ball, and a faceted one between two spheres.
struct Round {
  glm::dvec3 center;
  double inner, outer;  // surely inside the body, surely outside
};
constexpr double kMargin = 1e-3;  // of sizes about 1: more than rounding at 1e7 moves anything
const Round kBall{{-1.5, 0.5, 0}, 0.5 - kMargin, 0.5 + kMargin};
const Round kFaceted{{1, 1, -0.5}, 0.98 - kMargin, 1 + kMargin};  // cos² (pi / 32) = 0.99

struct ShadowFaults {
  std::uint64_t dark = 0, lit = 0, sure = 0;
  void add(const ShadowFaults& other) {
    dark += other.dark;
    lit += other.lit;
    sure += other.sure;
  }
};
// `camera` is that of the middle; to_light(p) from a point there.
template <class ToLight>
ShadowFaults shadow_faults(const Frame& frame, const Camera& camera, const ToLight& to_light) {
  ShadowFaults faults;
  for (int y = 0; y < frame.height(); ++y)
    for (int x = 0; x < frame.width(); ++x) {
      const std::size_t i = frame.index(x, y);
      if (frame.object_id[i] == 0) continue;
      const glm::dvec3 p = camera.eye + frame.sample_depth[i] * camera.direction(x, y);
      const glm::dvec3 way = glm::normalize(to_light(p));
      if (glm::dot(glm::dvec3(frame.normal[i]), way) < kMargin) continue;  // not lit, or hardly
      bool surely_free = true, surely_blocked = false;
      for (const auto& [object, body] : {std::pair(2u, kBall), std::pair(3u, kFaceted)}) {
        if (frame.object_id[i] == object) continue;  // convex: not in its own way
        const double ahead = glm::dot(body.center - p, way);
        const double distance = glm::length(body.center - p - std::max(ahead, 0.0) * way);
        surely_free = surely_free && distance > body.outer;
        surely_blocked = surely_blocked || distance < body.inner;
      }
      const bool shadowed = frame.layer(Layer::shadow)[i].x > 0;
      faults.dark += surely_free && shadowed;
      faults.lit += surely_blocked && !shadowed;
      faults.sure += surely_free || surely_blocked;
    }
  return faults;
}

// Floor, ball and faceted ball, lit from 80 degrees off the floor's normal.
Scene three_things(const glm::dvec3& at) {
  Scene scene = empty_scene();
  const double angle = 80 * std::numbers::pi / 180;
  scene.lights.push_back(lamp(at + 20.0 * glm::dvec3(std::sin(angle), std::cos(angle), 0), 1));
  scene.camera.eye = at + glm::dvec3(0, 4, 7);
  scene.camera.look_at = at;
  add_plane(scene, {at, {0, 1, 0}, 0}, {});
  add_sphere(scene, {at + glm::dvec3(-1.5, 0.5, 0), 0.5, 0}, {});
  PolygonMesh faceted = star_sphere(32, 32, 0, 1);
  for (glm::dvec3& p : faceted.positions) p += at + glm::dvec3(1, 1, -0.5);
  add_mesh(scene, faceted, {}, {});
  return scene;
}

}  // namespace

TEST_CASE("SHA-1: what a light on a surface shines on is lit, and the surface is not") {
  std::uint64_t dark = 0, pixels = 0;
  Worst error;
  // On a plane; on the diagonal of a quad; on a vertex of four triangles; on the corner of a box.
  const glm::dvec3 above(1.5, 1, 0);
  LitBall on_plane = ball_at(above, {0, 0, 0});
  add_plane(on_plane.scene, {{0, 0, 0}, {0, 1, 0}, 0}, {});
  LitBall on_edge = ball_at(above, {0, 0, 0});
  add_mesh(on_edge.scene, mesh_of({{-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}}, {{0, 1, 2}, {0, 2, 3}}),
           {}, {});
  LitBall on_vertex = ball_at(above, {0, 0, 0});
  add_mesh(on_vertex.scene,
           mesh_of({{0, 0, 0}, {-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}},
                   {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}),
           {}, {});
  LitBall on_corner = ball_at({1.5, 1.5, 1.5}, {0.5, 0.5, 0.5});
  add_mesh(on_corner.scene, make_box({1, 1, 1}), {}, {});
  for (LitBall* lit : {&on_plane, &on_edge, &on_vertex, &on_corner}) {
    lit->primitive = static_cast<std::uint32_t>(lit->scene.primitive_object.size());
    add_sphere(lit->scene, lit->ball, {});
    check_ball(*lit, dark, pixels, error);
  }
  const HardCase on_surface("SHA-1");
  on_surface.none("false shadows of a light on a plane, an edge, a vertex, a corner", dark, pixels);
  on_surface.at_most("error of a colour", error, 1e-5);

  // The floor itself: N.L is 0 on all of it.
  std::uint64_t lit_floor = 0, floor = 0;
  for (const LitBall* lit : {&on_plane, &on_edge, &on_vertex}) {
    const Frame frame = test::traced(lit->scene, square_camera(lit->scene));
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
      if (frame.sample_primitive[i] == kNone || frame.sample_primitive[i] == lit->primitive) continue;
      ++floor;
      lit_floor += frame.color[i] != glm::vec3(0);
    }
  }
  on_surface.none("pixels of the light's own surface that it lights", lit_floor, floor);
}

// From a point beyond an edge the way to the light leads through that edge, to rounding.
TEST_CASE("SHA-2: no light leaves a closed body") {
  std::uint64_t lit = 0, rays = 0, lit_pixels = 0, pixels = 0;
  Random random(61);
  VisibilityCounts counts;
  struct Body {
    double scale, offset;
  };
  for (const Body& body : {Body{1, 0}, Body{1e3, 1e5}})
    for (const bool at_wall : {false, true}) {
      PolygonMesh star = star_sphere(32, 32, 0.3, 11);
      // Next to the inside of the wall: a thousandth before the middle of a face.
      const PolygonMesh::Face& face = star.faces[500];
      glm::dvec3 light(0);
      for (std::uint32_t k = 0; at_wall && k < 3; ++k)
        light += star.positions[star.corners[face.first + k].position] * (0.999 / 3);
      light = body.scale * light + body.offset;
      for (glm::dvec3& p : star.positions) p = body.scale * p + body.offset;
      Scene scene = scene_of(star);
      const raytrace::Prepared prepared(scene);
      for (std::uint64_t left = 1 + tier_count("rays_per_gate") / 4; left > 0; --left, ++rays) {
        const auto& v =
            scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))].vertex;
        const glm::dvec3 a = scene.positions[v[0]], b = scene.positions[v[1]];
        const glm::dvec3 on_edge = a + (left % 4 == 0 ? 0 : random.uniform()) * (b - a);
        // The body lies within 1.3 of its centre: this is outside.
        const glm::dvec3 out = glm::normalize(on_edge - light);
        const glm::dvec3 point = light + body.scale * random.uniform(3, 30) * out;
        lit += !raytrace::blocker(prepared, make_ray(point, light - point), &light, counts).found();
      }
      // The same light in a picture: all that is outside is black.
      const glm::dvec3 center(body.offset);
      const auto around = [&](double x, double y, double z) {
        return center + body.scale * glm::dvec3(x, y, z);
      };
      add_plane(scene, {around(0, -1.5, 0), {0, 1, 0}, 0}, {});
      for (const glm::dvec3& at : {around(2, 0, 0), around(-1.5, 0.5, 1.5), around(0, 1, -2.5)})
        add_sphere(scene, {at, 0.5 * body.scale, 0}, {});
      scene.lights.push_back(lamp(light, 1));
      scene.camera.eye = around(1, 4, 8);
      scene.camera.look_at = center;
      const Frame frame = test::traced(scene, square_camera(scene));
      for (const glm::vec3& c : frame.color) lit_pixels += c != glm::vec3(0);
      pixels += frame.pixels();
      // It is the body that keeps it dark.
      const Frame flat = test::rastered(scene, square_camera(scene));
      CHECK(std::any_of(flat.color.begin(), flat.color.end(), [](const glm::vec3& c) { return c.x > 0; }));
    }
  const HardCase inside("SHA-2");
  inside.none("shadow rays through edges and vertices of a closed body that reach the light in it", lit,
              rays);
  inside.none("pixels outside that are lit", lit_pixels, pixels);
}

TEST_CASE("SHA-4: a light behind the surface adds nothing and costs no ray") {
  std::uint64_t changed = 0, shadow_rays = 0, pictures = 0;
  for (const double shininess : {0.0, 1.0, 50.0})
    for (const double side : {1.0, -1.0}) {  // of the eye
      Scene dark = empty_scene();
      dark.ambient = glm::dvec3(0.2);
      dark.materials[0].ambient = dark.materials[0].specular = glm::dvec3(0.5);
      dark.materials[0].shininess = shininess;
      add_plane(dark, {{0, 0, 0}, {0, 1, 0}, 0}, {});
      dark.camera.eye = {0, 2 * side, 4};
      dark.camera.look_at = {0, 0, 0};
      const Camera camera = make_camera(dark.camera, 48, 32, 1);
      std::vector<Light> lights{lamp({0, -side, 0}, 1), lamp({1, 0, -1}, 1)};
      for (const double cosine : {-1.0, -1e-3, -1e-8, -0.0, 0.0})
        lights.push_back(sun({std::sqrt(1 - cosine * cosine), side * cosine, 0}, 1));
      for (const Light& light : lights) {
        Scene behind = dark;
        behind.lights.push_back(light);
        const Frame deep = test::traced(behind, camera);
        changed += test::differences(deep, test::traced(dark, camera)) != "";
        changed += test::differences(test::rastered(behind, camera), test::rastered(dark, camera)) != "";
        shadow_rays += deep.stats.rays.shadow;
        pictures += 2;
      }
    }
  const HardCase behind("SHA-4");
  behind.none("pictures that a light behind the surface changes in any bit", changed, pictures);
  behind.none("shadow rays to it", shadow_rays, pictures);
}

TEST_CASE("SHA-7: no false shadow from 1e-3 to 1e7 from the origin") {
  const Scene here = three_things({0, 0, 0});
  const int edge = std::min(tier_edge(), 512);  // twelve pictures, and 512 is enough to see acne
  ShadowFaults all;
  for (double offset = 0; offset < 2e7; offset = offset == 0 ? 1e-3 : 10 * offset) {
    const Scene there = three_things(glm::dvec3(offset));
    all.add(shadow_faults(test::traced(there, square_camera(there, edge)), square_camera(here, edge),
                          [&](const glm::dvec3& p) { return here.lights[0].position - p; }));
  }
  const HardCase far("SHA-7");
  far.none("pixels in a false shadow", all.dark, all.sure);
  far.none("pixels that miss their shadow", all.lit, all.sure);
}

// The light's direction varies by 1e-6 over a scene of size 10, and so does the square of its distance.
TEST_CASE("SHA-8: a light of 1e14 at 1e7 is the sun") {
  const glm::dvec3 towards = glm::normalize(glm::dvec3(1, 1, -1));
  const auto lit_by = [](const Light& light) {
    Scene scene = three_things({0, 0, 0});
    scene.lights = {light};
    return scene;
  };
  const Scene sunny = lit_by(sun(towards, 1.0 / 3));
  const Camera camera = square_camera(sunny);
  const Frame right = test::traced(sunny, camera);
  ShadowFaults all;
  Worst error;
  std::uint64_t not_finite = 0;
  // 3e14 = |(1e7, 1e7, -1e7)|²; and the farthest that a scene may have it, 1e15 along each axis.
  for (const double reach : {1e7, 1e15}) {
    Light far = lamp(reach * glm::dvec3(1, 1, -1), reach * reach);
    far.attenuation = {0, 0, 1};
    const Frame frame = test::traced(lit_by(far), camera);
    not_finite += !first_non_finite(frame).empty();
    all.add(shadow_faults(frame, camera, [&](const glm::dvec3&) { return towards; }));
    for (std::size_t i = 0; i < frame.pixels(); ++i)
      if (right.color[i].x > 1e-2f && frame.color[i].x > 0)
        error.add(std::abs(double{frame.color[i].x} / double{right.color[i].x} - 1));
  }
  const HardCase far("SHA-8");
  far.at_most("relative error of a colour against a directional light", error, 1e-4);
  far.none("pixels in a false shadow", all.dark, all.sure);
  far.none("pixels that miss their shadow", all.lit, all.sure);
  far.none("pictures with a number that is not finite", not_finite, 2);
}
