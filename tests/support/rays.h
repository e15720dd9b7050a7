// SPDX-License-Identifier: MIT
// Directions that tests draw beside a normal, and where the rays that leave a hit start.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "common/model/place.h"
#include "tests/support/random.h"

namespace sidelight::test {

// Unit, at a right angle to v.
inline glm::dvec3 across(const glm::dvec3& v, Random& random) {
  return glm::normalize(glm::cross(v, random.direction()));
}

// Unit, on the side of `normal`: half of them with its cosine evenly spread over the magnitudes from 1e-6 to 1.
inline glm::dvec3 outward(const glm::dvec3& normal, Random& random) {
  const bool grazing = random.uniform() < 0.5;
  const double cosine = grazing ? random.log_uniform(1e-6, 1) : random.uniform(1e-6, 1);
  return glm::normalize(cosine * normal + std::sqrt(1 - cosine * cosine) * across(normal, random));
}

// By brute force.
inline glm::dvec3 start_of_leaving(const Scene& scene, const Ray& ray, const Hit& hit, const Place& place,
                                   VisibilityCounts& counts) {
  std::vector<std::uint32_t> near;
  for (std::uint32_t primitive = 0; primitive < scene.primitive_object.size(); ++primitive)
    if (stands_near(scene, primitive, ray, hit, place, counts)) near.push_back(primitive);
  return leaving_point(scene, ray, hit, place, near, counts);
}

}  // namespace sidelight::test
