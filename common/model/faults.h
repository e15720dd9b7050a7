// SPDX-License-Identifier: MIT
// Faults on purpose, for teaching: what renderers commonly do in place of the exact answers of visibility.h, so that
// its price can be seen. All are off by default, and then nothing is paid for them. Whoever turns one on says so in
// every output.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace sidelight {

enum class FaultKind { shadow_offset, depth_format, snap_bits, tessellate, precision };
inline constexpr int kFaults = 5;
inline constexpr std::array<std::string_view, kFaults> kFaultNames{"shadow-offset", "depth-format",
                                                                   "snap-bits", "tessellate", "precision"};
constexpr std::string_view fault_name(FaultKind fault) {
  return kFaultNames[static_cast<std::size_t>(fault)];
}

// How a z-buffer stores what lies between the near and the far plane.
enum class DepthFormat { unorm16, unorm24, float32, reversed };
inline constexpr std::array<std::string_view, 4> kDepthFormatNames{"unorm16", "unorm24", "float", "reversed"};

struct Faults {
  // Ray tracer: shadow rays start at the surface point itself and meet nothing nearer than this, in scene units >= 0.
  std::optional<double> shadow_offset;
  // Z-buffer: depths are clipped to [near, far] (scene units along the viewing direction, 0 < near < far), stored in
  // this format and compared as stored; where they are equal, what is drawn first stays.
  std::optional<DepthFormat> depth_format;
  double near_plane = 0, far_plane = 0;
  // Z-buffer: vertices in front of the eye move to the nearest multiple of 2^-N pixels on the screen; N in [0, 16].
  std::optional<int> snap_bits;
  // Scene: spheres become meshes of N segments of longitude and N/2 of latitude; N even, in [4, 1024]. Done to the
  // scene before it is prepared (tessellate.h); renderers do not look at it.
  std::optional<int> tessellate;
  // Both: triangles are decided in float, without filter and fallback (visibility_float.h).
  bool float_precision = false;

  // Sets the planes of a depth format to what they are unless the user says otherwise: 1e-3 and 1e3 times the eye's
  // distance to what it looks at.
  void set_usual_planes(double distance);

  bool has(FaultKind fault) const;
  bool any() const;
  // The same with all other faults off, and with this one off.
  Faults only(FaultKind fault) const;
  Faults without(FaultKind fault) const;
  // What is on, with its numbers: "snap-bits 4, precision float". Empty if nothing is.
  std::string text() const;

  bool operator==(const Faults&) const = default;
};

}  // namespace sidelight
