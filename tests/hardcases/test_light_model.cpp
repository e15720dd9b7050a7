// SPDX-License-Identifier: MIT
// The local light model in whole pictures: vertex normals of any length (PHO-4), two-sided faces (PHO-5), and colours
// that are huge or not allowed (PHO-7). The terms themselves: tests/model/test_phong.cpp.
#include <cmath>

#include "common/picture/srgb.h"
#include "tests/agreement/pictures.h"
#include "tests/hardcases/result.h"
#include "tests/scene/toml_text.h"
#include "tests/support/approx.h"
#include "tests/support/lit.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Both pictures of a scene without shadows and secondary rays; they must be the same bytes.
struct LocalPictures {
  explicit LocalPictures(const Scene& scene, int width = 64, int height = 48)
      : camera(make_camera(scene.camera, width, height, 1)),
        flat(rastered(local_only(scene), camera)),
        deep(traced(local_only(scene), camera)) {}

  bool agree() const { return differences(flat, deep).empty(); }

  Camera camera;
  Frame flat, deep;
};

std::uint64_t non_finite(const Frame& frame) {
  std::uint64_t bad = 0;
  for (const glm::vec3& c : frame.color)
    bad += !(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z));
  for (const glm::vec3& n : frame.normal)
    bad += !(std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z));
  return bad;
}

double greatest_difference(const Frame& a, const Frame& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.color.size(); ++i)
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(double{a.color[i][c]} - double{b.color[i][c]}));
  return worst;
}

// ---- PHO-4 ----

// A bumpy ball with the normals of a sphere, the one of vertex v times scale(v).
template <class Scale>
PolygonMesh ball_with_normals(const Scale& scale) {
  PolygonMesh mesh = star_sphere(14, 20, 0.3, 7);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.normals.push_back(scale(v) * glm::normalize(mesh.positions[v]));
  for (PolygonMesh::Corner& corner : mesh.corners) corner.normal = corner.position;
  return mesh;
}

constexpr double kShininess = 10;

Scene lit(const PolygonMesh& mesh) {
  Material material;
  material.diffuse = {0.5, 0.25, 0.125};
  material.specular = glm::dvec3(0.5);
  material.shininess = kShininess;
  return test::lit(mesh, material, {0.3, 0.7, 4});
}

}  // namespace

TEST_CASE("PHO-4: vertex normals of any length, opposite, zero and missing") {
  const HardCase hard("PHO-4");
  const LocalPictures plain(lit(ball_with_normals([](std::size_t) { return 1.0; })));
  std::uint64_t pictures = 0, unlike = 0, disagreeing = 0, faults = 0;
  const auto judge = [&](const LocalPictures& pictures_of_one) {
    ++pictures;
    disagreeing += !pictures_of_one.agree();
    faults += non_finite(pictures_of_one.flat) + non_finite(pictures_of_one.deep);
  };
  judge(plain);

  // A power of two loses no bit, whether all vertices have the same one or each its own.
  for (int k = -60; k <= 60; k += 15) {
    const LocalPictures same(lit(ball_with_normals([&](std::size_t) { return std::ldexp(1.0, k); })));
    const LocalPictures own(lit(ball_with_normals(
        [&](std::size_t v) { return std::ldexp(1.0, static_cast<int>(v * 37 % 121) - 60 + k % 2); })));
    unlike += !differences(same.flat, plain.flat).empty() + !differences(own.flat, plain.flat).empty();
    judge(same);
    judge(own);
  }
  hard.none("pictures changed by normals times 2^k, k from -60 to 60", unlike, 18);

  // Other factors cost each unit normal a rounding in double, which may turn one in float: N off by 2^-24 a component.
  // The kernel's own error for N so far off is (24 s + 24) 2^-24 (tests/model/test_phong.cpp), once for each picture.
  const LocalPictures thrice(lit(ball_with_normals([](std::size_t) { return 3.0; })));
  const LocalPictures mixed(
      lit(ball_with_normals([](std::size_t v) { return 0.1 + static_cast<double>(v % 7) * 12.3; })));
  judge(thrice);
  judge(mixed);
  const double worst =
      std::max(greatest_difference(thrice.flat, plain.flat), greatest_difference(mixed.flat, plain.flat));
  hard.at_most("colours changed by normals of other lengths, in units of (48 s + 48) 2^-24",
               worst / ((48 * kShininess + 48) * 0x1p-24), 1);

  // Zero normals: the geometric one, as if there were none.
  const LocalPictures flat_faces(lit(star_sphere(14, 20, 0.3, 7)));
  const LocalPictures zero(lit(ball_with_normals([](std::size_t) { return 0.0; })));
  judge(flat_faces);
  judge(zero);
  hard.holds("a mesh of zero normals looks as one without normals, in every bit",
             differences(zero.flat, flat_faces.flat).empty() && flat_faces.flat.color != plain.flat.color);

  // Neighbours with opposite normals, whose sum is 0 somewhere between them, and zeros among others.
  judge(LocalPictures(lit(ball_with_normals([](std::size_t v) { return v % 2 ? -1.0 : 1.0; }))));
  judge(LocalPictures(lit(ball_with_normals([](std::size_t v) { return v % 3 ? 0.0 : 1.0; }))));
  Scene quad = lit(mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
  quad.normals = {{0, 0, 1},
                  {0, 0, -1}};  // opposite across the quad: 0 on the line x = 0, where a column of rays runs
  quad.triangles[0].normal = {0, 1, 1};
  quad.triangles[1].normal = {0, 1, 0};
  quad.camera.eye = {0, 0, 4};
  judge(LocalPictures(quad, 65, 49));
  hard.none("values that are not finite", faults, pictures * plain.flat.pixels());
  hard.none("scenes on which z-buffer and tracer differ in any bit", disagreeing, pictures);
}

// ---- PHO-5 ----

namespace {

// A triangle in the plane z = 0, or that plane, seen from z = 4 or -4, lit along the z axis from the front or the back.
struct TwoSided {
  double eye_side = 1, light_side = 1;
  bool flipped = false, mirrored = false, plane = false;

  Scene scene() const {
    Scene scene;
    Material material;
    material.ambient = glm::dvec3(0.125);
    material.diffuse = glm::dvec3(0.5);
    add_material(scene, material);
    Transform transform;
    if (mirrored) transform.linear = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1);
    const Face face = flipped ? Face{0, 2, 1} : Face{0, 1, 2};
    if (plane)
      add_plane(scene, {{0, 0, 0}, {0, 0, flipped ? -1 : 1}, 0}, {});
    else
      add_mesh(scene, mesh_of({{-3, -2.5, 0}, {3, -2, 0}, {0.25, 3, 0}}, {face}), transform, {});
    Light light;
    light.directional = true;
    light.direction = {0, 0, -light_side};
    light.intensity = glm::dvec3(1);
    scene.lights = {light};
    scene.ambient = glm::dvec3(1);
    scene.camera.eye = {0, 0, 4 * eye_side};
    return scene;
  }
};

}  // namespace

// The table: the side seen turns the normal, and light from the other side does not count. N.L is 1 or -1 here, so a
// pixel of the triangle or plane is exactly ka Ia + kd = 0.625 where eye and light are on one side, else ka Ia = 0.125.
TEST_CASE("PHO-5: a face has two sides, lit as it is seen") {
  const HardCase hard("PHO-5");
  std::uint64_t wrong = 0, looked_at = 0, disagreeing = 0, scenes = 0, moved = 0;
  for (const double eye : {1.0, -1.0})
    for (const double light : {1.0, -1.0})
      for (const auto& [mirrored, plane] : {std::pair(false, false), {true, false}, {false, true}}) {
        const LocalPictures one(TwoSided{eye, light, false, mirrored, plane}.scene());
        const LocalPictures flipped(TwoSided{eye, light, true, mirrored, plane}.scene());
        const float expected = eye == light ? 0.625f : 0.125f;
        for (const LocalPictures* each : {&one, &flipped}) {
          ++scenes;
          disagreeing += !each->agree();
          for (std::size_t i = 0; i < each->flat.pixels(); ++i) {
            if (each->flat.object_id[i] == 0) continue;
            ++looked_at;
            wrong += each->flat.color[i] != glm::vec3(expected);
          }
        }
        moved += one.flat.object_id != flipped.flat.object_id ||
                 one.flat.sample_depth != flipped.flat.sample_depth;
      }
  hard.none("pixels unlike the table of sides", wrong, looked_at);
  hard.none("scenes on which z-buffer and tracer differ in any bit", disagreeing, scenes);
  hard.none("pictures whose ids or depths change with the order of vertices", moved, scenes / 2);
}

// The eye is a hair off the plane of the triangle, so that the sign of d.N is below its rounding; both find the side by
// the exact sign. A plane is seen so too.
TEST_CASE("PHO-5: seen nearly edge-on, z-buffer and tracer see the same side") {
  Random random(51);
  std::uint64_t disagreeing = 0, covered = 0, pictures = 0;
  for (std::uint64_t left = 8 + tier_count("rays_per_case") / 4096; left > 0; --left) {
    Scene scene = lit(mesh_of({random.in_box(1), random.in_box(1), random.in_box(1)}, {{0, 1, 2}}));
    const glm::dvec3 normal = glm::normalize(
        glm::cross(scene.positions[1] - scene.positions[0], scene.positions[2] - scene.positions[0]));
    const glm::dvec3 inside = (scene.positions[0] + scene.positions[1] + scene.positions[2]) / 3.0;
    const glm::dvec3 along = glm::normalize(scene.positions[0] - inside);
    scene.camera.eye = inside + random.uniform(1, 3) * along + random.log_uniform(1e-17, 1e-3) * normal;
    scene.camera.look_at = inside;
    scene.camera.view_height = random.log_uniform(1e-3, 1);
    add_plane(scene, {scene.camera.eye + 1e-16 * normal, random.uniform() < 0.5 ? normal : -normal, 0}, {});
    const LocalPictures both(scene, 24, 33);
    ++pictures;
    disagreeing += !both.agree();
    for (const std::uint32_t id : both.flat.object_id) covered += id != 0;
  }
  const HardCase hard("PHO-5");
  hard.none("nearly edge-on views on which z-buffer and tracer differ in any bit", disagreeing, pictures);
  hard.at_least("pixels covered in them", static_cast<double>(covered), 100);
}

// ---- PHO-7 ----

namespace {

// A wall that fills the picture's right half, seen and lit from straight ahead: its colour is kd I.
std::string wall(const std::string& diffuse, const std::string& intensity) {
  return "background = 0\n"
         "camera = { eye = [0, 0, 2], look_at = [0, 0, 0], view_height = 1 }\n"
         "light = [{ direction = [0, 0, -1], intensity = " +
         intensity +
         " }]\n"
         "material.m = { diffuse = " +
         diffuse +
         " }\n"
         "mesh = [{ vertices = [[0, -9, 0], [9, -9, 0], [9, 9, 0], [0, 9, 0]], faces = [[0, 1, 2, 3]], "
         "material = 'm' }]\n";
}

}  // namespace

TEST_CASE("PHO-7: colours are refused, or kept as they are up to the one clamp") {
  const HardCase hard("PHO-7");
  std::uint64_t accepted = 0, asked = 0;
  for (const char* bad : {"-1", "-1e-300", "nan", "inf", "1.1e30", "[0, -1, 0]", "[0, 0, nan]"})
    for (const bool material : {true, false}) {
      ++asked;
      accepted += error_of(material ? wall(bad, "1") : wall("1", bad)) == "no error";
    }
  hard.none("colours that are negative, not finite or beyond 1e30 and yet accepted", accepted, asked);

  // Products of two such values up to 1e36 are floats.
  std::uint64_t faults = 0, pixels = 0, wrong = 0;
  for (const char* diffuse : {"0", "1", "1e18"})
    for (const char* intensity : {"0", "1", "1e18"}) {
      const Scene scene = parse_scene(wall(diffuse, intensity), "wall.toml");
      const LocalPictures both(scene, 8, 6);
      faults += non_finite(both.flat) + non_finite(both.deep);
      pixels += both.flat.pixels();
      const float expected = std::stof(diffuse) * std::stof(intensity);
      wrong += both.flat.color[7] != glm::vec3(expected) || both.deep.color[7] != glm::vec3(expected);
    }
  hard.none("pixels that are not finite, factors up to 1e18", faults, pixels);
  hard.none("float colours other than the product of their factors", wrong, 9);
  hard.holds("8 bits of 1e30 are 255", encode_srgb8(1e30f) == 255);

  // A pixel half covered by a wall of colour 4: the mean is 2 and is then clamped. Clamping the samples would give 1/2.
  const Scene scene = parse_scene(wall("1", "4"), "wall.toml");
  const Camera camera = make_camera(scene.camera, 5, 3, 2);
  std::uint64_t early = 0;
  for (const Frame& frame : {rastered(scene, camera), traced(scene, camera)}) {
    const Image8 image = to_image8(frame.color, 5, 3);
    early += frame.color[7] != glm::vec3(2) || image.rgb[3 * 7] != 255 || image.rgb[3 * 6] != 0;
  }
  hard.none("pictures clamped before the mean", early, 2);
}
