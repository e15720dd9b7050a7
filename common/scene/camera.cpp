// SPDX-License-Identifier: MIT
#include "common/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/float_state.h"
#include "common/math/norms.h"

namespace sidelight {
namespace {

// Unit length for any finite non-zero vector: scaled by its largest component first, so that no square overflows.
glm::dvec3 unit(const glm::dvec3& v) {
  const glm::dvec3 scaled = v / max_norm(v);
  return scaled / std::sqrt(glm::dot(scaled, scaled));
}

// Components this small move no sample; zero keeps products of three exact (model/exact.h).
glm::dvec3 without_dust(glm::dvec3 v) {
  for (int i = 0; i < 3; ++i)
    if (std::abs(v[i]) < 1e-100) v[i] = 0;
  return v;
}

// The coordinate axis least aligned with `forward`, the later one on a tie.
glm::dvec3 substitute_up(const glm::dvec3& forward) {
  int axis = 2;
  for (const int i : {1, 0})
    if (std::abs(forward[i]) < std::abs(forward[axis])) axis = i;
  glm::dvec3 up(0);
  up[axis] = 1;
  return up;
}

}  // namespace

Camera make_camera(const CameraSettings& settings, int width, int height, int n) {
  const StandardFloatState nearest_and_denormals;
  const glm::dvec3 forward = unit(settings.look_at - settings.eye);

  // Nearer to parallel than this, rounding alone would choose the picture's roll.
  constexpr double kParallel = 1e-14;
  const bool has_up = max_norm(settings.up) > 0;
  glm::dvec3 across = has_up ? glm::cross(forward, unit(settings.up)) : glm::dvec3(0);
  if (max_norm(across) < kParallel) across = glm::cross(forward, substitute_up(forward));
  // Orthogonal to forward again: where up is nearly parallel, the cross product alone is not.
  across = unit(across);
  const glm::dvec3 right = unit(across - glm::dot(across, forward) * forward);
  const glm::dvec3 up = unit(glm::cross(right, forward));  // of length 1 but for the rounding of both

  Camera camera;
  camera.eye = settings.eye;
  camera.right = without_dust(settings.view_height * right);
  camera.up = without_dust(settings.view_height * up);
  camera.forward = without_dust(forward);
  camera.width = width;
  camera.height = height;
  camera.n = n;
  return camera;
}

int samples_per_edge(int spp) {
  for (int n = 1; n <= spp / n; ++n)
    if (n * n == spp) return n;
  return 0;
}

}  // namespace sidelight
