// SPDX-License-Identifier: MIT
// Metamorphic relations of light: lights that are halved, scaled or dark, and what a scene does not need (MET-6 to 8, 16;
// INP-5).
#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"
#include "tests/support/approx.h"
#include "tests/support/scenes.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

// The scene with each opaque object twice, the second ones last. (A sheet that lets light through is shaded on the way,
// and two of them are.)
Scene with_duplicates(const Scene& scene) {
  std::vector<std::size_t> order, again;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    order.push_back(i);
    const Material& material = scene.materials[primitive_material(scene, scene.objects[i].first_primitive)];
    if (material.refract == glm::dvec3(0)) again.push_back(i);
  }
  order.insert(order.end(), again.begin(), again.end());
  return rebuilt(scene, order, unchanged);
}

// A light that shines nowhere, a material on nothing, a shadowless speck that no ray meets (inside the opaque copper of
// a wall's far side: behind the plane z = -6, which all rays stop at), and one behind the camera that no ray reaches.
void add_dark_light(Scene& scene) {
  Light dark;
  dark.position = {0.3, 2.2, 1.4};
  scene.lights.push_back(dark);
}
void add_unused_material(Scene& scene) {
  Material unused;
  unused.name = "unused";
  unused.reflect = unused.refract = glm::dvec3(0.5);
  unused.ior = 2.4;
  add_material(scene, unused);
}
void add_hidden_objects(Scene& scene) {
  Material red;
  red.name = "hidden";
  red.diffuse = {1, 0, 0};
  const std::uint32_t hidden = add_material(scene, red);
  add_sphere(scene, {{0, 1, -9}, 0.5, hidden}, {});         // behind the wall
  add_sphere(scene, {{-1.2, 4.6, 2.0}, 0.35, hidden}, {});  // inside the opaque shade
  PolygonMesh box = star_sphere(6, 8, 0.1, 3);
  for (glm::dvec3& p : box.positions) p = glm::dvec3(2, 1, -12) + 0.5 * p;
  for (PolygonMesh::Face& face : box.faces) face.material = hidden;
  add_mesh(scene, box, {}, {});
}

std::uint64_t work(const Scene& scene) {
  const RenderStats stats = traced(scene, relation_camera(scene)).stats;
  return stats.rays.total();
}

}  // namespace

TEST_CASE("MET-6: duplicates, hidden objects and dark lights change no bit") {
  const Scene scene = everything();
  const HardCase hard("MET-6");
  hard.holds("every opaque object twice: the same bytes", same_bytes(scene, with_duplicates(scene)));
  Scene hidden = scene, dark = scene;
  add_hidden_objects(hidden);
  hard.holds("objects inside an opaque one and behind a wall: the same bytes", same_bytes(scene, hidden));
  Scene behind = local_only(scene);
  const Scene local = behind;
  add_sphere(behind, {{0.4, 2.3, 12}, 2, 0}, {});
  hard.holds("an object behind the camera, no rays but the eye's: the same bytes", same_bytes(local, behind));
  add_dark_light(dark);
  hard.holds("a light of intensity 0: the same bytes", same_bytes(scene, dark));
}

// Sums: T/2 + T/2 is T exactly, but with a light before them the partial sums round differently, once for each ray of a
// path and each of the lights; weights are at most 1, and sums of positive terms do not amplify.
TEST_CASE("MET-7: two lights of half the intensity are one") {
  Scene scene = everything();
  scene.lights.resize(1);
  Scene halves = scene;
  halves.lights[0].intensity *= 0.5;
  halves.lights.push_back(halves.lights[0]);
  HardCase("MET-7").at_most("one light: difference of colours, in units of eps",
                            likeness(scene, halves).color / kFloatEps, 4);

  // Behind another light.
  Scene both = everything();
  Scene split = both;
  split.lights[1].intensity *= 0.5;
  split.lights.push_back(split.lights[1]);
  HardCase("MET-7").at_most("after another light: difference of colours, in units of eps",
                            likeness(both, split).color / kFloatEps, 4);
}

// A highlight's last trace may be a denormal, which has fewer bits to scale: what is below 2^-100 is left out.
TEST_CASE("MET-8: intensities times a power of two") {
  const auto scaled = [](const Frame& frame, float by) {
    Frame out = frame;
    const auto scale = [&](KeptArray<glm::vec3>& colors) {
      for (glm::vec3& color : colors)
        for (int c = 0; c < 3; ++c) color[c] = by * (std::abs(color[c]) < 0x1p-100f / by ? 0 : color[c]);
    };
    scale(out.color);
    for (auto& layer : out.rgb) scale(layer);
    return out;
  };
  const Scene scene = everything();
  std::uint64_t unlike = 0, pictures = 0;
  for (const int k : {-10, 3, 10}) {
    const double by = std::exp2(k);
    Scene brighter = scene;
    brighter.background *= by;
    brighter.ambient *= by;
    for (Light& light : brighter.lights) light.intensity *= by;
    const Camera camera = relation_camera(scene);
    for (const auto& [before, after] : {std::pair(rastered(scene, camera), rastered(brighter, camera)),
                                        std::pair(traced(scene, camera), traced(brighter, camera))}) {
      ++pictures;
      unlike += !differences(scaled(after, 1), scaled(before, static_cast<float>(by))).empty();
    }
  }
  HardCase("MET-8").none("pictures that do not scale in every bit, 2^-10 to 2^10", unlike, pictures);
}

// ---- MET-16, INP-5 ----

TEST_CASE("MET-16: what a scene does not use changes no bit") {
  const HardCase hard("MET-16");
  // A scene without mirrors and glass, with those features on and off.
  Scene plain = everything();
  for (Material& material : plain.materials) material.reflect = material.refract = glm::dvec3(0);
  std::vector<std::size_t> order(plain.objects.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  plain = rebuilt(plain, order, unchanged);
  std::uint64_t unlike = 0, switches = 0;
  const auto compare_with = [&](const Scene& other) {
    ++switches;
    unlike += !same_bytes(plain, other);
  };
  Scene other = plain;
  other.trace.reflection = false;
  compare_with(other);
  other.trace.refraction = false;
  compare_with(other);
  other.trace.secondary_attenuation = {1, 5, 3};
  compare_with(other);
  other.trace.depth = 1;
  compare_with(other);
  other = plain;
  add_unused_material(other);
  compare_with(other);
  // No lights: nothing to shadow.
  Scene unlit = plain;
  unlit.lights.clear();
  Scene no_shadows = unlit;
  no_shadows.trace.shadows = false;
  ++switches;
  unlike += !same_bytes(unlit, no_shadows);
  // All alone, an object of index n that does not refract.
  other = plain;
  for (Material& material : other.materials) material.ior = 3;
  compare_with(rebuilt(other, order, unchanged));
  hard.none("features that the scene does not use and that change a bit", unlike, switches);
}

TEST_CASE("INP-5: what a scene does not need costs no bit and no work") {
  const HardCase hard("INP-5");
  const Scene scene = everything();
  Scene more = scene;
  add_unused_material(more);
  add_dark_light(more);
  add_hidden_objects(more);
  more.lights.insert(more.lights.begin() + 1, more.lights.back());  // a dark one in between
  hard.holds("unused materials, dark lights and hidden objects: the same bytes", same_bytes(scene, more));
  // Time is not measured on a shared machine; rays are what it goes to.
  hard.at_most("rays sent, against those without",
               static_cast<double>(work(more)) / static_cast<double>(work(scene)), 1.05);
}
