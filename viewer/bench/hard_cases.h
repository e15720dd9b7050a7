// SPDX-License-Identifier: MIT
// Whether a setting shows the right surfaces where that is hard: the faults that its picture of the user's scene may
// happen to hide.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "viewer/bench/hard_scenes.h"
#include "viewer/bench/visible.h"

namespace sidelight {

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
