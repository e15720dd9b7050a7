// SPDX-License-Identifier: MIT
// The errors of one setting's picture, kept apart by what they come from:
//   arithmetic  the picture against the same samples of the same model in double
//   model       that against the same samples of the full model in double
//   sampling    that against the reference image
// All three as RMSE add up to at least the RMSE against the reference image, which is the sum of the three differences.
#pragma once

#include <map>
#include <span>

#include "viewer/bench/reference.h"
#include "viewer/bench/visible.h"

namespace sidelight {

class PictureJudge {
 public:
  // `reference_n`: of the reference image, which has no sampling error that could be told.
  PictureJudge(Stage& stage, Reference& reference, int reference_n)
      : stage_(stage), reference_(reference), reference_n_(reference_n) {}

  // Fills the point's errors, counts and gates, and its pictures. Renders the setting once (so that it is warm), and
  // whatever of its truths is not known yet.
  void judge(const Setting& setting, BenchPoint& point);

 private:
  std::span<const glm::vec3> truth_of(const Model& model, int n);

  Stage& stage_;
  Reference& reference_;
  int reference_n_;
  VisibleJudge visible_{stage_};
  std::map<std::pair<Model, int>, KeptArray<glm::vec3>> truths_;
};

}  // namespace sidelight
