// SPDX-License-Identifier: MIT
// The section of a report on the highlights of a scene's materials: what cos^s looks like for each.
#pragma once

#include <vector>

#include "common/scene/scene.h"
#include "viewer/report/html.h"

namespace sidelight {

// Of the materials with a specular coefficient, the first kMostCurves in the order of the file; how many were left out
// is said. Empty where there is none.
Html highlights_html(const std::vector<Material>& materials);

}  // namespace sidelight
