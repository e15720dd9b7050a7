// SPDX-License-Identifier: MIT
// What rays meet of the balls that they start at: in lanes that of intersect(), bit for bit, on every instruction set.
#include <doctest/doctest.h>

#include <memory>

#include "raytrace/kernels.h"
#include "tests/support/rays.h"
#include "tests/support/scenes.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::BallBatch;

namespace {

// A ray from on or about a ball, inward, outward or along it; some touch it, pass its centre or are not finite.
void draw(BallBatch& batch, std::size_t i, Random& random) {
  const glm::dvec3 outward = random.uniform() < 0.2 ? glm::dvec3(0, 1, 0) : random.direction();
  const glm::dvec3 center = random.uniform() < 0.2 ? glm::dvec3(0) : 4.0 * random.in_box(1);
  const double radius = random.uniform() < 0.2 ? 1 : random.log_uniform(1e-6, 1e3);
  const double kind = random.uniform();
  const double off = kind < 0.3 ? 0 : kind < 0.6 ? random.uniform(-1e-15, 1e-15) : random.uniform(-0.5, 0.5);
  glm::dvec3 direction = random.direction();
  if (random.uniform() < 0.2) direction = across(outward, random);
  if (random.uniform() < 0.1) direction = -outward;
  if (random.uniform() < 0.02) direction.y = std::nan("");
  put(batch.center, i, center);
  batch.radius[i] = radius;
  put(batch.origin, i, center + radius * (1 + off) * outward);
  put(batch.direction, i, random.log_uniform(1e-3, 1e3) * direction);
  batch.passes[i] = random.uniform() < 0.5;
}

Hit expected(const BallBatch& batch, std::size_t i) {
  Scene scene = empty_scene();
  add_sphere(scene, {get(batch.center, i), batch.radius[i], 0}, {});
  const Ray ray{get(batch.origin, i), get(batch.direction, i)};
  VisibilityCounts counts;
  const Hit first = intersect(scene, 0, ray, kRayStart, counts);
  return batch.passes[i] != 0 && first.found() ? intersect(scene, 0, ray, first, counts) : first;
}

}  // namespace

TEST_CASE("balls in lanes: where single rays meet them") {
  const auto batch = std::make_unique<BallBatch>();
  for (const Isa isa : kIsas) {
    if (!machine_has(isa)) continue;
    Random random(98);
    std::uint64_t differing = 0, found = 0, asked = 0;
    for (std::uint64_t left = 1 + tier_count("rays_per_case") / 1000; left > 0; --left) {
      batch->size = 1 + random.below(BallBatch::kCapacity);
      for (std::size_t i = 0; i < batch->size; ++i) draw(*batch, i, random);
      raytrace::kernels_for(isa).own_hits(*batch);
      for (std::size_t i = 0; i < batch->size; ++i) {
        const Hit hit = expected(*batch, i);
        differing += batch->t[i] != hit.t;  // infinite where there is none
        found += hit.found();
        ++asked;
      }
    }
    CHECK(differing == 0);
    CHECK(found > asked / 5);
    CHECK(found < asked);
  }
}
