// SPDX-License-Identifier: MIT
// Whether a setting shows the right surfaces where that is hard: the faults that its picture of the user's scene may
// happen to hide.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "viewer/bench/visible.h"

namespace sidelight {

// Small scenes on which the nearest surface is hard to tell, made in memory: what a bench asks every configuration beside
// the user's scene, and where both renderers must agree to the last bit.
struct HardScene {
  std::string name;
  Scene scene;
};
std::vector<HardScene> hard_scenes();

// One grey material with a highlight, a lamp beside the eye, and nothing to see yet.
Scene lit_scene(const glm::dvec3& eye, const glm::dvec3& look_at);

inline constexpr int kHardWidth = 64, kHardHeight = 48;  // of a hard scene's picture, one sample a pixel

class HardCases {
 public:
  // Interrupted is thrown when `cancel`, which may be null, is raised.
  explicit HardCases(std::atomic<bool>* cancel = nullptr);

  // The hard scenes of which the setting's eye rays show a wrong surface at some sample, in words with the number of such
  // samples: "hard cases: needles 12, room 3". Empty if there are none.
  std::string failures(const Setting& setting);

 private:
  struct Case {
    Case(std::string name_, Scene scene, std::atomic<bool>* cancel)
        : name(std::move(name_)), stage(std::move(scene), cancel), judge(stage) {}
    std::string name;
    Stage stage;
    VisibleJudge judge;
  };
  std::vector<std::unique_ptr<Case>> cases_;
};

}  // namespace sidelight
