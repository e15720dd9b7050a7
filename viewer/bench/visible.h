// SPDX-License-Identifier: MIT
// What a setting's picture shows at every sample against what the other renderer, exact, shows there: the two share no
// loop.
#pragma once

#include <map>
#include <vector>

#include "viewer/bench/stage.h"

namespace sidelight {

struct VisibleError {
  std::uint64_t mismatches = 0;  // samples that show another surface
  double depth_error = 0;        // relative, the greatest where both show the same
  std::vector<char> covered;     // one a pixel: something is seen in either
};

class VisibleJudge {
 public:
  explicit VisibleJudge(Stage& stage) : stage_(stage) {}

  // `frame` is the setting's, with its samples kept. Facets are numbered otherwise than what they stand for, so with them
  // objects are compared, else primitives.
  VisibleError compare(const Setting& setting, const Frame& frame);

 private:
  struct Samples {
    KeptArray<std::uint32_t> primitive;
    KeptArray<double> depth;
  };
  const Samples& exact(bool raster, int n);

  Stage& stage_;
  std::map<std::pair<bool, int>, Samples> exact_;
};

}  // namespace sidelight
