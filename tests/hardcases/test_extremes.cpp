// SPDX-License-Identifier: MIT
// Denormals (INP-2) and counts (INP-3). Numbers that are not finite, field by field: tests/scene/test_toml_errors.cpp.
#include <immintrin.h>

#include <ctime>
#include <fstream>

#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"
#include "tests/scene/toml_text.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// Processor time, least of five: others may use the machine.
template <class Work>
double seconds(const Work& work) {
  double least = INFINITY;
  for (int run = 0; run < 5; ++run) {
    timespec before, after;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
    work();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
    least = std::min(least, static_cast<double>(after.tv_sec - before.tv_sec) +
                                1e-9 * static_cast<double>(after.tv_nsec - before.tv_nsec));
  }
  return least;
}

// A room of mirrors, in which light loses all but `weight` at each of 150 bounces.
Scene mirror_room(double weight) {
  Scene scene;
  Material mirror;
  mirror.ambient = glm::dvec3(0.5);
  mirror.reflect = glm::dvec3(weight);
  add_material(scene, mirror);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 point(0), normal(0);
      point[axis] = 2 * side;
      normal[axis] = -side;
      add_plane(scene, {point, normal, 0}, {});
    }
  scene.ambient = glm::dvec3(1);
  scene.trace.depth = 150;
  scene.camera.eye = {0.3, 0.1, 0.7};
  return scene;
}

// Flush-to-zero and denormals-are-zero, for as long as it lives.
struct FlushingDenormals {
  unsigned before = _mm_getcsr();
  FlushingDenormals() { _mm_setcsr(before | 0x8040u); }
  ~FlushingDenormals() { _mm_setcsr(before); }
};

// The most memory this process held since forget_peak().
void forget_peak() { std::ofstream("/proc/self/clear_refs") << 5; }
std::uint64_t peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string key, value; status >> key;)
    if (key == "VmHWM:" && status >> value) return std::stoull(value) * 1024;
  FAIL("no VmHWM in /proc/self/status");
  return 0;
}

}  // namespace

TEST_CASE("INP-2: denormals neither slow a picture down nor change it") {
  const HardCase hard("INP-2");
  // 2^-125 is below the least length: nothing of that size gets in.
  hard.holds("a sphere of radius 2^-125 is refused",
             error_of("[[sphere]]\ncenter = [0, 0, 0]\nradius = 2.35e-38\n"
                      "material = 'm'" +
                      kCamera + kMaterial) != "no error");
  // 0.5^150 = 7e-46 is below the least float: the last bounces add denormals, then nothing.
  const Scene fading = mirror_room(0.5), bright = mirror_room(0.999);
  const Camera camera = make_camera(fading.camera, 40, 30, 1);
  RenderOptions options;
  options.threads = 1;
  const auto of = [&](const Scene& scene) {
    return seconds([&] { raytrace::render(*raytrace::prepare(scene), camera, options); });
  };
  REQUIRE(traced(fading, camera).stats.rays.reflection == traced(bright, camera).stats.rays.reflection);
  if (tier() != "sanitized")
    hard.at_most("processor time of reflections that fade to 1e-45, against bright ones",
                 of(fading) / of(bright), 2);

  const Scene scene = everything();
  const Frame flat = rastered(scene, relation_camera(scene)), deep = traced(scene, relation_camera(scene));
  const FlushingDenormals flushing;
  hard.holds("flushing denormals changes no bit",
             differences(rastered(scene, relation_camera(scene)), flat).empty() &&
                 differences(traced(scene, relation_camera(scene)), deep).empty());
}

TEST_CASE("INP-3: no objects, no lights, no faces, and indices and depths beyond all bounds") {
  const HardCase hard("INP-3");
  // An empty scene is its background, in both renderers and every pixel.
  const Scene nothing = parse_scene("background = [0.25, 0.5, 0.75]\n" + kCamera, "empty.toml");
  std::uint64_t wrong = 0, pixels = 0;
  for (const Frame& frame :
       {rastered(nothing, relation_camera(nothing)), traced(nothing, relation_camera(nothing))})
    for (const glm::vec3& c : frame.color) {
      ++pixels;
      wrong += c != glm::vec3(0.25f, 0.5f, 0.75f);
    }
  hard.none("pixels of an empty scene other than its background", wrong, pixels);

  Scene unlit = everything();
  unlit.lights.clear();
  std::uint64_t lit = 0;
  for (const Frame& frame : {rastered(unlit, relation_camera(unlit)), traced(unlit, relation_camera(unlit))})
    for (const Layer layer : {Layer::diffuse, Layer::specular})
      for (const glm::vec3& c : frame.layer(layer)) lit += c != glm::vec3(0);
  hard.none("pixels lit without a light", lit, 4 * 67 * 49);

  std::uint64_t accepted = 0, asked = 0;
  const std::string triangle =
      "[[mesh]]\nmaterial = 'm'\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nfaces = [[0, 1, ";
  for (const char* mesh :
       {"vertices = [], faces = []", "vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces = []"}) {
    ++asked;
    accepted += error_of("mesh = [{ " + std::string(mesh) + ", material = 'm' }]" + kCamera + kMaterial) ==
                "no error";
  }
  for (const char* index : {"3", "-1", "2147483648", "4294967296", "4294967298", "9223372036854775807"}) {
    ++asked;
    accepted += error_of(triangle + index + "]]" + kCamera + kMaterial) == "no error";
  }
  for (const char* depth : {"-1", "0", "1001", "1000000000", "4294967297"}) {
    ++asked;
    accepted += error_of("trace.depth = " + std::string(depth) + kCamera + kMaterial) == "no error";
  }
  for (const char* size : {"[0, 1]", "[65536, 1]", "[1, 4294967297]", "[-1, 1]"}) {
    ++asked;
    accepted += error_of("picture.size = " + std::string(size) + kCamera + kMaterial) == "no error";
  }
  hard.none("meshes of nothing, indices, depths and sizes out of bounds that are accepted", accepted, asked);
}

TEST_CASE("INP-3: many spheres and many lights") {
  const std::uint64_t spheres = std::min<std::uint64_t>(tier_count("rays_per_case"), 1'000'000);
  forget_peak();
  const std::uint64_t before = peak_bytes();
  Scene scene = empty_scene();
  Random random(33);
  for (std::uint64_t i = 0; i < spheres; ++i) add_sphere(scene, {random.in_box(10), 0.02, 0}, {});
  for (std::uint64_t i = 0; i < spheres / 10; ++i) {
    Light light;
    light.position = random.in_box(20);
    light.intensity = glm::dvec3(1e-3);
    scene.lights.push_back(light);
  }
  scene.camera.eye = {0, 0, 25};
  scene.camera.view_height = 0.2;
  // All lights at each of the few pixels; their shadow rays are what takes the time.
  const Camera camera = make_camera(scene.camera, 16, 12, 1);
  scene = local_only(std::move(scene));
  const Frame flat = rastered(scene, camera), deep = traced(scene, camera);
  const HardCase hard("INP-3");
  hard.holds("many spheres and lights: z-buffer and tracer agree in every bit",
             differences(flat, deep).empty());
  const std::uint64_t bytes = spheres * (sizeof(Sphere) + sizeof(Object) + sizeof(std::uint32_t)) +
                              scene.lights.size() * sizeof(Light) + 2 * frame_bytes(16, 12, 1, {});
  if (tier() != "sanitized")
    hard.at_most("memory, in parts of scene and frames",
                 static_cast<double>(peak_bytes() - before) / static_cast<double>(bytes), 3);
}
