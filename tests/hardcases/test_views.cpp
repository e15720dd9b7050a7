// SPDX-License-Identifier: MIT
// Cameras in difficult places: looking along up (CAM-1), fields of view near 0 and 180 degrees (CAM-2), eyes inside
// and on things (CAM-4), and scenes far from the origin (CAM-5). The rays themselves: tests/scene/test_camera.cpp.
#include <numbers>

#include "common/scene/build.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/scene/toml_text.h"
#include "tests/support/exact_picture.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Pictures by both renderers, without shadows and secondary rays: how many differ from each other in any bit, and how
// many values are not finite.
struct Views {
  std::uint64_t pictures = 0, disagreeing = 0, faults = 0, pixels = 0;

  Frame judge(const Scene& scene, int width = 48, int height = 36) {
    const Camera camera = make_camera(scene.camera, width, height, 1);
    const Frame flat = rastered(local_only(scene), camera);
    ++pictures;
    pixels += flat.pixels();
    disagreeing += !differences(flat, traced(local_only(scene), camera)).empty();
    for (const glm::vec3& c : traced(scene, camera).color) faults += !is_finite(c);
    for (const glm::vec3& c : flat.color) faults += !is_finite(c);
    return flat;
  }
  void report(const std::string& id, const std::string& what) const {
    const HardCase hard(id);
    hard.none(what + ": values that are not finite", faults, pixels);
    hard.none(what + ": pictures on which z-buffer and tracer differ in any bit", disagreeing, pictures);
  }
};

// A sphere, a box and a floor under one light.
Scene still_life() {
  return parse_scene(
      "ambient = 0.2\n"
      "camera = { eye = [0, 6, 0], look_at = [0, 0, 0], view_height = 1 }\n"
      "light = [{ position = [2, 5, 3], intensity = 1 }]\n"
      "material.m = { ambient = 0.5, diffuse = 0.5, specular = 0.5, shininess = 20, reflect = 0.25 }\n"
      "sphere = [{ center = [-1, 1, 0], radius = 1, material = 'm' }]\n"
      "plane = [{ point = [0, 0, 0], normal = [0, 1, 0], material = 'm' }]\n"
      "mesh = [{ shape = 'box', size = [1, 1, 1], transform = { translate = [1, 0.5, 0] }, material = 'm' "
      "}]\n",
      "still_life.toml");
}

}  // namespace

TEST_CASE("CAM-1: a camera that looks along up, or almost") {
  Views views;
  Scene scene = still_life();
  for (const glm::dvec3& up : {glm::dvec3(0, 1, 0), glm::dvec3(1e-8, 1, 0), glm::dvec3(0, 1, 1e-6),
                               glm::dvec3(1e-4, 1, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, -1e-300, 0)}) {
    scene.camera.up = up;
    views.judge(scene);
  }
  for (const double distance : {1e-30, 1e14}) {
    scene.camera.look_at = scene.camera.eye - glm::dvec3(0, distance, 0);
    if (scene.camera.look_at == scene.camera.eye) scene.camera = {{0, 0, 0}, {0, -distance, 0}, {0, 1, 0}, 1};
    views.judge(scene);
  }
  views.report("CAM-1", "looking down with up along the view");
  HardCase("CAM-1").holds("an eye at its target is refused", [] {
    const std::string text = "camera = { eye = [1, 2, 3], look_at = [1, 2, 3], view_height = 1 }\n";
    return error_of(text).find("a point other than the eye") != std::string::npos;
  }());
}

// ---- CAM-2 ----

namespace {

// A triangle that is seen about as large as the picture, before ground that reaches behind the eye. The integers of the
// oracle have room for the 53 bits of a field of view and little more: coordinates are multiples of 2^-10 or, for the
// narrowest view and without the ground, of 1.
Scene for_any_field(double view_height) {
  const bool narrow = view_height < 1e-5;
  const auto coarse = [&](const glm::dvec3& v) {
    const double step = narrow ? 1 : 0x1p-10;
    return step * glm::dvec3(std::round(v.x / step), std::round(v.y / step), std::round(v.z / step));
  };
  const double distance = narrow ? 0x1p20 : std::max(1.0, std::exp2(std::round(std::log2(1 / view_height))));
  const double size = std::min(view_height * distance, 1000.0);
  const glm::dvec3 ahead{0, 0, -distance};
  Scene scene = scene_of_triangle(coarse(ahead + size * glm::dvec3(-0.4, -0.35, 0)),
                                  coarse(ahead + size * glm::dvec3(0.45, -0.2, 0)),
                                  coarse(ahead + size * glm::dvec3(0.1, 0.4, -0.01)));
  if (!narrow)
    add_mesh(scene, mesh_of({{-512, -1, 512}, {512, -1, 512}, {0, -1, -1023}}, {{0, 1, 2}}), {}, {});
  scene.camera.view_height = view_height;
  return scene;
}

}  // namespace

TEST_CASE("CAM-2: fields of view near 0 and 180 degrees") {
  const HardCase hard("CAM-2");
  std::uint64_t wrong = 0, asked = 0;
  for (const auto& [fov, accepted] : {std::pair{"0", false},
                                      {"1e-4", true},
                                      {"1e-2", true},
                                      {"1", true},
                                      {"170", true},
                                      {"179", true},
                                      {"179.9", true},
                                      {"179.99", true},
                                      {"180", false},
                                      {"181", false},
                                      {"-60", false},
                                      {"nan", false}}) {
    const std::string text =
        std::string("camera = { eye = [0, 0, 1], look_at = [0, 0, 0], vertical_fov = ") + fov + " }\n";
    ++asked;
    wrong += (error_of(text) == "no error") != accepted;
  }
  hard.none("angles wrongly accepted or refused", wrong, asked);

  // tan(x), x = fov/2, to 17 digits. Relative to its value, a rounding of x costs x (1 + tan² x)/tan x; x and the tangent
  // itself are off by 3 u and 1 u.
  const auto height = [](const char* fov) {
    return parse_scene(
               std::string("camera = { eye = [0, 0, 1], look_at = [0, 0, 0], vertical_fov = ") + fov + " }\n",
               "x")
        .camera.view_height;
  };
  double worst = 0;
  for (const auto& [fov, tangent] : {std::pair{"1e-4", 8.7266462599738631e-7},
                                     {"170", 11.430052302761343},
                                     {"179.9", 1145.9152993734230},
                                     {"179.99", 11459.155873527643}}) {
    const double x = std::stod(fov) * std::numbers::pi / 360;
    const double bound = (3 * x * (1 + tangent * tangent) / tangent + 2) * 0x1p-53;
    worst = std::max(worst, std::abs(height(fov) / (2 * tangent) - 1) / bound);
  }
  hard.at_most("relative error of the view height, in units of its bound", worst, 1);

  // Edges exact means far within 1/128 pixel.
  std::uint64_t unlike = 0, samples = 0, covered = 0;
  for (const char* fov : {"1e-4", "1e-2", "1", "90", "170", "179", "179.9", "179.99"}) {
    const Scene scene = local_only(for_any_field(height(fov)));
    const Camera camera = make_camera(scene.camera, 160, 120, 1);
    const ExactPicture exact(scene, camera);
    const Frame flat = rastered(scene, camera);
    unlike += exact.mismatches(flat) + exact.mismatches(traced(scene, camera));
    samples += 2 * flat.pixels();
    const std::uint64_t before = covered;
    for (const std::uint32_t id : flat.object_id) covered += id != 0;
    CAPTURE(fov);
    CHECK(covered > before);
  }
  hard.none("samples of either renderer unlike 128-bit integers, 1e-4 to 179.99 degrees", unlike, samples);
}

// ---- CAM-4 ----

TEST_CASE("CAM-4: an eye inside, on and at things") {
  const HardCase hard("CAM-4");
  Views views;
  Scene scene = still_life();
  const auto look = [&](const glm::dvec3& eye, const glm::dvec3& at) {
    scene.camera.eye = eye;
    scene.camera.look_at = at;
    return views.judge(scene, 49, 37);
  };

  // Inside the opaque sphere and box: their inner side everywhere.
  std::uint64_t others = 0, pixels = 0;
  for (const std::uint32_t id : look({-1, 1, 0}, {-1, 1.5, 1}).object_id) others += id != 1, ++pixels;
  for (const std::uint32_t id : look({1, 0.5, 0}, {1.25, 0.75, 1}).object_id) others += id != 3, ++pixels;
  hard.none("pixels that do not see the inner side from inside", others, pixels);

  // On the box's front face, looking along it: that face is not met, and what lies below the horizon is the floor or
  // the box's other faces; on the floor: no pixel shows the floor.
  look({1, 0.5, 0.5}, {1, 0.5, 5});  // outwards
  std::uint64_t own = 0, seen = 0;
  for (const std::uint32_t id :
       look({1.25, 0.75, 0.5}, {1, 0.5, 0}).primitive_id) {  // inwards, from that face
    const std::uint32_t first = scene.objects[2].first_primitive;
    const bool of_box = id >= first + 1 && id <= first + 12;
    const Triangle* t = of_box ? &scene.triangles[id - 1 - first] : nullptr;
    own += t && scene.positions[t->vertex[0]].z == 0.5 && scene.positions[t->vertex[1]].z == 0.5 &&
           scene.positions[t->vertex[2]].z == 0.5;
    ++seen;
  }
  for (const std::uint32_t id : look({3, 0, 3}, {3, 0.1, 0}).object_id) own += id == 2, ++seen;
  hard.none("pixels that show the face on which the eye lies", own, seen);

  look(scene.positions[0], {0, 0.3, 0});  // a vertex of the box
  look({0, 1, 0}, {-1, 1, 0});            // on the sphere, which touches nothing
  look({0, 1, 0}, {5, 1, 0});
  look(scene.lights[0].position, {0, 0, 0});
  views.report("CAM-4", "inside, on a face, at a vertex, at the light");
}

// ---- CAM-5 ----

// Everything lies on a grid of 2^-20, so that moving it by T, a whole number up to 1e7, moves no bit of a difference:
// the T = 0 picture is the answer, in every id and every depth.
TEST_CASE("CAM-5: a scene far from the origin, the camera with it") {
  const auto picture_at = [](double offset) {
    Scene scene = empty_scene();
    PolygonMesh ball = star_sphere(24, 32, 0.4, 5);
    for (glm::dvec3& p : ball.positions) p = snapped(p);
    Transform away;
    away.translate = glm::dvec3(offset, -offset, offset);
    add_mesh(scene, ball, away, {});
    add_sphere(scene, {glm::dvec3(1.25, 0.5, -0.75) + away.translate, 0.625, 0}, {});
    add_plane(scene, {glm::dvec3(0, -1.5, 0) + away.translate, {0, 1, 0}, 0}, {});
    scene.camera.eye = snapped(glm::dvec3(0.7, 0.9, 3.3)) + away.translate;
    scene.camera.look_at = away.translate;
    const int edge = tier() == "sanitized" ? 64 : 256;
    const Camera camera = square_camera(scene, edge);
    return std::pair(rastered(scene, camera), traced(scene, camera));
  };
  const auto [flat, deep] = picture_at(0);
  std::uint64_t ids = 0, pixels = 0, sphere_or_plane = 0;
  for (const std::uint32_t id : flat.object_id) sphere_or_plane += id > 1;
  REQUIRE(sphere_or_plane > 0);
  std::uint64_t depths = 0;
  for (const double offset : {1.0, 100.0, 1e4, 1e6, 1e7}) {
    const auto [far_flat, far_deep] = picture_at(offset);
    for (const auto& [far, near] : {std::pair(&far_flat, &flat), std::pair(&far_deep, &deep)})
      for (std::size_t i = 0; i < near->pixels(); ++i) {
        ++pixels;
        ids += near->sample_primitive[i] != far->sample_primitive[i];
        depths += near->sample_depth[i] != far->sample_depth[i];
      }
  }
  const HardCase hard("CAM-5");
  hard.none("samples with another surface than at T = 0, T up to 1e7", ids, pixels);
  hard.none("samples with another depth than at T = 0, in any bit", depths, pixels);
}
