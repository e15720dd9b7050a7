// SPDX-License-Identifier: MIT
// A ray on its way, with what the recursion needs to know about its past.
#pragma once

#include "common/model/explanation.h"
#include "raytrace/media.h"

namespace sidelight::raytrace {

struct Path {
  Ray ray;
  RayKind kind = RayKind::eye;
  Hit start = kRayStart;   // hits up to here lie behind it already
  Media media;             // where it travels
  int depth = 1;           // rays along the path, this one included
  double weight = 1;       // product of the largest channels of c2, c3 along the path
};

}  // namespace sidelight::raytrace
