// SPDX-License-Identifier: MIT
// Writes a scene for POV-Ray 3.7, so that an independent renderer can judge our pictures: rendered with the options in
// the file's head, +Q3 is what the z-buffer shows and +Q9 what the ray tracer shows. What that language cannot say is
// listed by pov_limits; the writer then says the nearest it can.
//
// After the POV-Ray 3.7 reference (sections "Finish", "Interior", "Light Sources", "Light Groups") and, where that is
// silent, experiments with Debian's povray 3.7.0.10; tests/judges repeats them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/scene.h"

namespace sidelight {

// POV-Ray ends a path after this many rays at the latest.
inline constexpr int kPovMostLevels = 256;

// Options of the povray program for a picture of the scene's size, in linear 16 bits a channel, one sample in the
// middle of each pixel. Without input, output and quality.
std::vector<std::string> pov_options(const Scene& scene);

// A thing in the scene that POV-Ray renders differently.
struct PovLimit {
  std::string text;                    // one line: what and where it is, and what POV-Ray does instead
  std::vector<std::uint32_t> objects;  // whose refraction it is; empty where it concerns no object
};

// Empty: both mean the same picture, but for the classes of pixels that tests/judges/judge.h explains.
std::vector<PovLimit> pov_limits(const Scene& scene);

// Hands the text to `append` piece by piece, a large mesh in many. Names and titles appear in comments only, on one
// line and without control characters.
void write_pov(const Scene& scene, const std::function<void(std::string_view)>& append);

}  // namespace sidelight
