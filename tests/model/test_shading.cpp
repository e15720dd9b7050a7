// SPDX-License-Identifier: MIT
// shade() is one kernel for every instruction set: the same bytes, whatever the batch holds, and the local
// model as light_term has it, summed in the order that shading.h documents.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/model/shading.h"
#include "common/scene/build.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

Vec3<float> to_float(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
glm::dvec3 colour(Random& random) { return glm::dvec3(0.5) + random.in_box(0.5); }

// Point and directional lights with all kinds of attenuation, one of them dark.
Scene scene_with_lights(Random& random) {
  Scene scene;
  scene.ambient = colour(random);
  for (int i = 0; i < 5; ++i) {
    Light light;
    light.directional = i % 3 == 2;
    light.position = random.in_box(3);
    light.direction = random.direction();
    light.intensity = i == 4 ? glm::dvec3(0) : 10.0 * colour(random);
    light.attenuation = {random.uniform(0.1, 1), i % 2 * random.uniform(), i % 2 * random.uniform()};
    scene.lights.push_back(light);
  }
  return scene;
}

// With twenty materials, one in eight without an exponent.
ShadingTables tables_of(const Scene& scene, Random& random) {
  ShadingTables tables = make_shading_tables(scene, needs_of(scene));
  for (int i = 0; i < 20; ++i) {
    ShadingMaterial material{};
    material.ambient = to_float(colour(random));
    material.diffuse = to_float(colour(random));
    material.specular = to_float(i % 5 == 4 ? glm::dvec3(0) : colour(random));
    material.local = to_float(colour(random));
    material.shininess = i % 8 == 0 ? 0.0f : static_cast<float>(random.log_uniform(0.1, 1e6));
    tables.materials.push_back(material);
  }
  return tables;
}

struct Entry {
  ShadingPoint<float> point{};
  std::uint32_t material;
};

// Any point, lit or not; one in eight looks straight into the highlight, one in eight lies where a light is.
Entry any_entry(const ShadingTables& tables, Random& random) {
  Entry entry;
  ShadingPoint<float>& point = entry.point;
  point.high = to_float(random.in_box(3));
  point.low = to_float(0x1p-24 * random.in_box(1));
  const glm::dvec3 normal = random.direction();
  point.normal = to_float(normal);
  point.facing = to_float(random.uniform() < 0.5 ? normal : random.direction());
  point.to_viewer = to_float(random.direction());
  entry.material = random.below(2) == 0 ? 3 : random.below(20);  // so that some vectors have one, others many
  const ShadingMaterial& material = tables.materials[entry.material];
  point.ambient = material.ambient;
  point.diffuse = material.diffuse;
  point.specular = material.specular;
  point.shininess = material.shininess;
  const ShadingLight<float>& light = tables.lights[0];
  if (random.below(8) == 0) {
    point.high = light.high;
    point.low = light.low;
  }
  if (random.below(8) == 0) {
    const glm::dvec3 away = glm::dvec3(light.high.x, light.high.y, light.high.z) -
                            glm::dvec3(point.high.x, point.high.y, point.high.z);
    if (glm::dot(away, away) > 0) point.normal = point.to_viewer = to_float(glm::normalize(away));
  }
  return entry;
}

void add(ShadingBatch& batch, const Entry& entry) {
  batch.set(static_cast<std::size_t>(batch.size++), entry.point, entry.material);
}

std::uint64_t differing_entries(const ShadingBatch& a, const ShadingBatch& b) {
  const auto differs = [](const ShadingBatch::Rgb& x, const ShadingBatch::Rgb& y, std::size_t i) {
    std::uint64_t count = 0;
    for (std::size_t c = 0; c < 3; ++c)
      count += !std::isfinite(x[c][i]) ||
               std::bit_cast<std::uint32_t>(x[c][i]) != std::bit_cast<std::uint32_t>(y[c][i]);
    return count;
  };
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.size); ++i)
    count += differs(a.unshadowed, b.unshadowed, i) + differs(a.ambient_layer, b.ambient_layer, i) +
             differs(a.diffuse_layer, b.diffuse_layer, i) + differs(a.specular_layer, b.specular_layer, i);
  return count;
}

std::uint64_t entries_unlike_scalar(Isa isa) {
  Random random(7);
  const ShadingTables tables = tables_of(scene_with_lights(random), random);
  std::uint64_t differing = 0;
  ShadingBatch batch, scalar;  // reused as a renderer does: entries beyond the size hold what came before
  for (std::uint64_t rounds = 1 + tier_count("rays_per_case") / (64 * 32); rounds > 0; --rounds)
    for (int size = 1; size <= ShadingBatch::kCapacity; ++size) {
      batch.size = scalar.size = 0;
      while (batch.size < size) {
        const Entry entry = any_entry(tables, random);
        add(batch, entry);
        add(scalar, entry);
      }
      shade(isa, tables, batch);
      shade(Isa::scalar, tables, scalar);
      differing += differing_entries(batch, scalar);
    }
  return differing;
}

}  // namespace

TEST_CASE("AVX2 shades batches of all sizes to the bytes of the scalar twin") {
  if (!machine_has(Isa::avx2)) return skip_test("no AVX2");
  CHECK(entries_unlike_scalar(Isa::avx2) == 0);
}

TEST_CASE("AVX-512 shades batches of all sizes to the bytes of the scalar twin") {
  if (!machine_has(Isa::avx512)) return skip_test("no AVX-512");
  CHECK(entries_unlike_scalar(Isa::avx512) == 0);
}

TEST_CASE("a batch holds c1 times ambient light plus the light terms in the scene's order") {
  Random random(8);
  const ShadingTables tables = tables_of(scene_with_lights(random), random);
  std::uint64_t differing = 0;
  for (std::uint64_t left = 1 + tier_count("rays_per_case") / 64; left > 0; --left) {
    ShadingBatch batch, expected;
    std::array<Entry, 64> entries;
    for (Entry& entry : entries) {
      entry = any_entry(tables, random);
      add(batch, entry);
    }
    expected.size = batch.size;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const auto& [point, material] = entries[i];
      const Vec3<float> ambient = point.ambient * tables.ambient_light;
      Vec3<float> sum = ambient, diffuse{}, specular{};
      for (const ShadingLight<float>& light : tables.lights) {
        const LightTerm<float> term = light_term<float>(point, light);
        sum = sum + (term.diffuse + term.specular);
        diffuse = diffuse + term.diffuse;
        specular = specular + term.specular;
      }
      const auto put = [&](ShadingBatch::Rgb& to, const Vec3<float>& v) {
        const Vec3<float>& c1 = tables.materials[material].local;
        to[0][i] = c1.x * v.x;
        to[1][i] = c1.y * v.y;
        to[2][i] = c1.z * v.z;
      };
      put(expected.unshadowed, sum);
      put(expected.ambient_layer, ambient);
      put(expected.diffuse_layer, diffuse);
      put(expected.specular_layer, specular);
    }
    shade(Isa::scalar, tables, batch);
    differing += differing_entries(batch, expected);
  }
  CHECK(differing == 0);
}

TEST_CASE("a batch of none changes nothing") {
  Random random(9);
  const ShadingTables tables = tables_of(scene_with_lights(random), random);
  ShadingBatch batch;
  const Entry entry = any_entry(tables, random);
  add(batch, entry);
  shade(Isa::scalar, tables, batch);
  const ShadingBatch before = batch;
  batch.size = 0;
  for (const Isa isa : kIsas)
    if (machine_has(isa)) shade(isa, tables, batch);
  batch.size = 1;
  CHECK(differing_entries(batch, before) == 0);
}

TEST_CASE("shading lengths are scaled by a power of two, which light and attenuation follow") {
  // f(d) for d = 5 at scale 2^k: q0 + q1 d + q2 d² = 1 + 0.5 · 5 + 0.25 · 25, all exact.
  for (const int k : {-40, -3, 0, 7, 40}) {
    const double unit = std::exp2(k);
    Scene scene;
    Light light;
    light.position = glm::dvec3(0, 3, 4) * unit;
    light.intensity = glm::dvec3(1);
    light.attenuation = {1, 0.5 / unit, 0.25 / unit / unit};
    scene.lights.push_back(light);
    scene.camera.eye = glm::dvec3(0, 0, 8) * unit;
    const ShadingTables tables = make_shading_tables(scene, needs_of(scene));
    CHECK(tables.length_scale == std::exp2(-k - 3));
    ShadingPoint<float> point{};
    point.normal = point.facing = {0, 0, 1};
    point.diffuse = {1, 1, 1};
    // N.L = 4/5, 1/f = 9.75; four roundings of 2^-24 in L, one each in distance, f and the two products
    const double expected = 0.8 / 9.75;
    CHECK(std::abs(light_term<float>(point, tables.lights[0]).diffuse.x - expected) <=
          8 * 0x1p-24 * expected);
  }
}

TEST_CASE("the scale of lengths is that of what reaches farthest, whatever it is") {
  const auto scale_of = [](const auto& put) {
    Scene scene;
    add_material(scene, {});
    scene.camera.eye = glm::dvec3(0, 1, 0);
    put(scene);
    return make_shading_tables(scene, needs_of(scene)).length_scale;
  };
  CHECK(scale_of([](Scene&) {}) == 1);
  CHECK(scale_of([](Scene& scene) { scene.camera.eye.z = -1000; }) == 0x1p-9);
  CHECK(scale_of([](Scene& scene) { scene.positions.emplace_back(0, -1000, 0); }) == 0x1p-9);
  CHECK(scale_of([](Scene& scene) { scene.spheres.push_back({{0, -500, 0}, 500, 0}); }) == 0x1p-9);
  CHECK(scale_of([](Scene& scene) { scene.planes.push_back({{-1000, 0, 0}, {0, 1, 0}, 0}); }) == 0x1p-9);
  CHECK(scale_of([](Scene& scene) { scene.lights.push_back(lamp({0, 0, 1000}, 1)); }) == 0x1p-9);
}

// A float holds 24 bits of a coordinate, the float that is left of it 24 more. (Compiled with GCC 12's vectorizer of
// straight-line code, two of the three low parts are 0: see CMakeLists.txt.)
TEST_CASE("points and lights are split into two floats that hold 48 bits of each coordinate") {
  Random random(48);
  std::uint64_t lost = 0;
  for (int i = 0; i < 1000; ++i) {
    Scene scene;
    add_material(scene, {});
    Light light;
    light.position = random.in_box(1000);
    light.intensity = glm::dvec3(1);
    scene.lights.push_back(light);
    const ShadingTables tables = make_shading_tables(scene, needs_of(scene));
    Surface surface;
    surface.point = random.in_box(1000);
    const ShadingPoint<float> point = shading_point(tables, surface, {{0, 0, 0}, {0, 0, 1}});
    const auto check = [&](double high, double low, double whole) {
      lost += !(std::abs(high + low - tables.length_scale * whole) <=
                0x1p-48 * tables.length_scale * std::abs(whole));
    };
    check(point.high.x, point.low.x, surface.point.x);
    check(point.high.y, point.low.y, surface.point.y);
    check(point.high.z, point.low.z, surface.point.z);
    const ShadingLight<float>& lamp = tables.lights[0];
    check(lamp.high.x, lamp.low.x, light.position.x);
    check(lamp.high.y, lamp.low.y, light.position.y);
    check(lamp.high.z, lamp.low.z, light.position.z);
  }
  CHECK(lost == 0);
}
