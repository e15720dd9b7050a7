// SPDX-License-Identifier: MIT
// Light on something, and light through something.
#pragma once

#include "tests/support/scenes.h"

namespace sidelight::test {

// A mesh of one material, a lamp at (2, 3, 4), seen from `eye` in the direction of the origin.
inline Scene lit(const PolygonMesh& mesh, const Material& material, const glm::dvec3& eye) {
  Scene scene;
  add_material(scene, material);
  add_mesh(scene, mesh, {}, {});
  scene.lights = {lamp({2, 3, 4}, 1)};
  scene.camera.eye = eye;
  scene.camera.look_at = {0, 0, 0};
  return scene;
}

// Nothing but refraction, of this index.
inline Material clear(double ior, double refract = 1) {
  Material material;
  material.local = glm::dvec3(0);
  material.refract = glm::dvec3(refract);
  material.ior = ior;
  material.casts_shadow = false;
  return material;
}

}  // namespace sidelight::test
