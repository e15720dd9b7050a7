// SPDX-License-Identifier: MIT
// The scenes of the tracers' race: shadows, mirrors and glass, to a depth of 5 rays. Meshes, spheres and point lights
// without attenuation; no infinite planes, which Embree does not know.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/scenes.h"

namespace sidelight::bench {

struct TraceEntry : Entry {
  double eye_least =
      0;  // bar of eye rays against Embree's packets; the others hold for every scene (trace_bench.cpp)
  bool in_mean = true;  // whether the geometric mean of whole frames takes it in
  std::optional<glm::dvec3> inside =
      {};  // a place from which every ray must meet the first object, a closed mesh
};

// `mesh`, the path of an OBJ file, takes the place of both made meshes. Throws InputError.
std::vector<TraceEntry> trace_entries(const std::optional<std::string>& mesh);

}  // namespace sidelight::bench
