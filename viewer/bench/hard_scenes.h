// SPDX-License-Identifier: MIT
// Small scenes on which the nearest surface is hard to tell: what a bench asks every configuration beside the user's
// scene, and where both renderers must agree to the last bit. Always the same ones, made in memory.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace sidelight {

struct HardScene {
  std::string name;
  Scene scene;
};
std::vector<HardScene> hard_scenes();

// One grey material with a highlight, a lamp beside the eye, and nothing to see yet.
Scene lit_scene(const glm::dvec3& eye, const glm::dvec3& look_at);

}  // namespace sidelight
