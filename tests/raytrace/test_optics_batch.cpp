// SPDX-License-Identifier: MIT
// Directions in lanes are those of optics.h, bit for bit, on every instruction set.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <memory>

#include "common/model/optics.h"
#include "raytrace/kernels.h"
#include "tests/support/rays.h"
#include "tests/tier.h"

using namespace sidelight;
using namespace sidelight::test;
using raytrace::OpticsBatch;

namespace {

// A ray, and a shading normal that may lean away from Nv so far that directions have to be folded.
void draw(OpticsBatch& batch, std::size_t i, Random& random) {
  const glm::dvec3 facing = random.direction();
  glm::dvec3 direction = random.direction();
  if (random.uniform() < 0.2) direction = random.uniform() < 0.5 ? facing : across(facing, random);
  if (glm::dot(direction, facing) > 0) direction = -direction;
  if (random.uniform() < 0.1) direction = {0, 0, random.uniform() < 0.5 ? 1 : -1};
  const glm::dvec3 normal =
      random.uniform() < 0.3 ? facing : glm::normalize(facing + random.uniform(0, 2) * random.direction());
  put(batch.direction, i, random.log_uniform(1e-3, 1e3) * direction);
  put(batch.normal, i, normal);
  put(batch.facing, i, facing);
  const double kind = random.uniform();
  batch.eta[i] = kind < 0.2 ? OpticsBatch::kNoRefraction : kind < 0.3 ? 1 : random.log_uniform(0.25, 4);
}

void check(const OpticsBatch& batch, std::size_t i) {
  const glm::dvec3 d = glm::normalize(get(batch.direction, i)), n = get(batch.normal, i),
                   nv = get(batch.facing, i);
  const auto taken_in = [](const glm::dvec3& v) { return make_ray(glm::dvec3(0), v).direction; };
  CHECK(get(batch.mirrored, i) == taken_in(reflect_direction(d, n, nv)));
  if (batch.eta[i] == OpticsBatch::kNoRefraction) return;
  const auto refracted = refract_direction(d, n, nv, batch.eta[i]);
  CHECK((batch.total[i] != 0) == !refracted);
  if (refracted) CHECK(get(batch.refracted, i) == taken_in(*refracted));
}

}  // namespace

TEST_CASE("optics in lanes: the directions of single rays") {
  const auto batch = std::make_unique<OpticsBatch>();
  for (const Isa isa : kIsas) {
    if (!machine_has(isa)) continue;
    Random random(99);
    for (std::uint64_t left = 1 + tier_count("rays_per_case") / 1000; left > 0; --left) {
      batch->size = 1 + random.below(OpticsBatch::kCapacity);
      for (std::size_t i = 0; i < batch->size; ++i) draw(*batch, i, random);
      raytrace::kernels_for(isa).directions(*batch);
      for (std::size_t i = 0; i < batch->size; ++i) check(*batch, i);
    }
  }
}
