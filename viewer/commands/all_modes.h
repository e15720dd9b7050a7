// SPDX-License-Identifier: MIT
// Everything that a comparison knows, as pictures for slides.
#pragma once

#include <string>

#include "viewer/commands/renderers.h"

namespace sidelight {

// Writes into `folder`, which is made, as 8-bit PNG:
//   raster_LAYER.png, raytrace_LAYER.png    each layer that the frame's renderer makes (layer_picture.h)
//   ledger_1_raster.png, ledger_2_minus_shadow.png, ledger_3_plus_reflection.png, ledger_4_plus_refraction.png
//                                           the left picture becoming the right one (ledger_sums in compare.h)
//   signed_difference.png                   where the right picture is brighter or darker (signed_difference.h)
// Both frames with all layers of their renderers. Throws OutputError.
void write_all_modes(const Job& job, const std::string& folder, const Frame& rastered, const Frame& traced);

}  // namespace sidelight
