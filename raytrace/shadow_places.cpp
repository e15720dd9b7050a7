// SPDX-License-Identifier: MIT
#include "raytrace/shadow_places.h"

#include <cmath>

#include "common/math/norms.h"
#include "raytrace/kernels.h"

namespace sidelight::raytrace {
namespace {

constexpr std::size_t kWholeLanes = 16;

}  // namespace

void ShadowQueries::resize(std::size_t size) {
  const std::size_t whole = (size + kWholeLanes - 1) / kWholeLanes * kWholeLanes;
  for (std::vector<double>* axis : {&x, &y, &z}) axis->resize(whole);
  own.resize(whole, -1);
  asks.resize(whole);
}

void ShadowPlaces::resize(std::size_t size) {
  for (std::vector<float>* row : {&u, &v, &per_depth}) row->resize(size);
  number.resize(size);
  own.resize(size);
}

CubeFace face_towards(const glm::dvec3& point, const glm::dvec3& light) {
  const glm::dvec3 p = point - light;
  CubeFace face;
  face.axis = greatest_axis(std::abs(p.x), std::abs(p.y), std::abs(p.z));
  face.sign = p[face.axis] < 0 ? -1 : 1;
  face.light = light;
  const double depth = face.sign * p[face.axis];
  if (depth < CubeFace::kLeastDepth) return face;
  face.middle_u = p[(face.axis + 1) % 3] / depth;
  face.middle_v = p[(face.axis + 2) % 3] / depth;
  return face;
}

bool find_places(Isa isa, const ShadowQueries& queries, const CubeFace& face, bool all,
                 ShadowPlaces& places) {
  places.resize(queries.size() + kWholeLanes);  // room for what lanes write beyond the last place
  const std::size_t size = kernels_for(isa).find_places(queries, face, all, places);
  if (size == kNotSeen) return false;
  places.resize(size);
  return true;
}

}  // namespace sidelight::raytrace
