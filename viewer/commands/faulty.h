// SPDX-License-Identifier: MIT
// What the faults of a comparison spoil: found by rendering the scene without them, and, where they are several, with each of
// them alone and without each of them: one may need another (float decides triangles, which spheres become by facets).
#pragma once

#include <cstdint>
#include <vector>

#include "viewer/commands/job.h"

namespace sidelight {

struct FaultCount {
  FaultKind fault{};
  std::uint64_t pixels = 0;         // that this fault changes, alone or among the others
  std::uint64_t other_surface = 0;  // those of them in which a sample shows another surface
};

struct Spoiled {
  std::vector<FaultCount> by_fault;
  // One a pixel of the frames: 0 where all the faults together change nothing. Empty without faults.
  std::vector<char> mask;
};

// At most this many pairs of pictures are alive at once, the job's own, the exact ones, and those with other faults.
inline constexpr int kSpoiledPairs = 3;

// `rastered` and `traced`: the job's two pictures, with all layers and samples. A pixel is changed where the primitive
// of a sample, its depth or the colour of either picture is another than without the fault, or a sample's primitive or
// depth another in one picture than in the other. Not what differs by definition: with tessellated spheres objects are
// compared, as primitives have other numbers; in float precision depths are not compared, since every one of a triangle
// is rounded.
Spoiled find_spoiled(const Job& job, const Frame& rastered, const Frame& traced);

}  // namespace sidelight
