// SPDX-License-Identifier: MIT
#include "viewer/bench/hard_cases.h"

#include <fmt/format.h>

namespace sidelight {

HardCases::HardCases(std::atomic<bool>* cancel) {
  for (HardScene& hard : hard_scenes()) {
    hard.scene.width = kHardWidth;
    hard.scene.height = kHardHeight;
    cases_.push_back(std::make_unique<Case>(std::move(hard.name), std::move(hard.scene), cancel));
  }
}

std::string HardCases::failures(const Setting& setting) {
  Setting eye_rays = setting;
  eye_rays.n = 1;
  eye_rays.depth = 1;
  std::string out;
  for (const std::unique_ptr<Case>& each : cases_) {
    const Frame frame = each->stage.render(eye_rays, true);
    const std::uint64_t wrong = each->judge.compare(eye_rays, frame).mismatches;
    if (wrong > 0)
      out += fmt::format("{} {} {}", out.empty() ? "hard cases:" : ",", each->name, wrong);
  }
  return out;
}

}  // namespace sidelight
