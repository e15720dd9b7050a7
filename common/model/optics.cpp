// SPDX-License-Identifier: MIT
#include "common/model/optics.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace sidelight {

glm::dvec3 reflect_direction(const glm::dvec3& d, const glm::dvec3& n, const glm::dvec3& nv) {
  glm::dvec3 r = d - 2 * glm::dot(d, n) * n;
  const double above = glm::dot(r, nv);
  if (above < 0) r -= 2 * above * nv;
  return glm::normalize(r);
}

std::optional<glm::dvec3> refract_direction(const glm::dvec3& d, const glm::dvec3& n, const glm::dvec3& nv,
                                            double eta) {
  if (eta == 1) return d;
  const glm::dvec3 normal = glm::dot(d, n) < 0 ? n : nv;
  const double cos_i = -glm::dot(d, normal);
  // sin² i from the tangential part itself: 1 - cos² i has lost its digits near normal incidence.
  const glm::dvec3 tangential = d + cos_i * normal;
  const double radicand = 1 - eta * eta * glm::dot(tangential, tangential);
  if (radicand < 0) return std::nullopt;
  glm::dvec3 t = eta * tangential - std::sqrt(radicand) * normal;
  const double above = glm::dot(t, nv);
  if (above > 0) t -= 2 * above * nv;
  return glm::normalize(t);
}

}  // namespace sidelight
