// SPDX-License-Identifier: MIT
#include "viewer/commands/fault_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "common/error.h"
#include "common/scene/limits.h"
#include "viewer/commands/decimal.h"

namespace sidelight {
namespace {

bool makes(std::string_view renderer, FaultKind fault) {
  if (fault == FaultKind::tessellate) return true;  // which is done to the scene
  if (fault == FaultKind::shadow_offset) return renderer == "raytrace";
  return renderer == "raster" || (renderer == "raytrace" && fault == FaultKind::precision);
}

}  // namespace

void add_fault_flags(CLI::App& verb, FaultFlags& flags) {
  const std::vector<std::string> formats(kDepthFormatNames.begin(), kDepthFormatNames.end());
  const auto add = [&](const char* name, auto& value, const char* type, const std::string& help) {
    return verb.add_option(name, value, help)->type_name(type)->group("Faults on purpose, for teaching");
  };
  add("--shadow-offset", flags.shadow_offset, "EPS",
      "shadow rays start on the surface, meet nothing nearer: acne, leaks");
  add("--depth-format", flags.depth_format, "NAME",
      fmt::format("depth is stored as {}: z-fighting", fmt::join(formats, ", ")))
      ->check(CLI::IsMember(formats).description(""));
  add("--near", flags.near_plane, "Z", "its near plane; 1e-3 times the eye's distance to look_at");
  add("--far", flags.far_plane, "Z", "its far plane; 1e3 times that distance");
  add("--snap-bits", flags.snap_bits, "N", "vertices are rounded to 1/2^N pixel, N from 0 to 16: cracks")
      ->transform(decimal)
      ->check(CLI::Range(0, 16).description(""));
  add("--tessellate", flags.tessellate, "N",
      "spheres are N segments around, N/2 from pole to pole; N even, 4 to 1024")
      ->transform(decimal)
      ->check(CLI::Range(4, 1024).description(""));
  add("--precision", flags.precision, "float", "triangles are decided in float, with nothing behind it")
      ->check(CLI::IsMember({"float"}).description(""));
}

Faults parse_faults(const FaultFlags& flags, const CameraSettings& camera) {
  Faults faults;
  faults.shadow_offset = flags.shadow_offset;
  if (faults.shadow_offset && !(0 <= *faults.shadow_offset && *faults.shadow_offset <= kLargest))
    throw UsageError(
        fmt::format("--shadow-offset wants a length from 0 to 1e15; got {}", *faults.shadow_offset));
  if (flags.depth_format.empty() && (flags.near_plane || flags.far_plane))
    throw UsageError("--near and --far want a --depth-format");
  if (!flags.depth_format.empty()) {
    const auto at = std::find(kDepthFormatNames.begin(), kDepthFormatNames.end(), flags.depth_format);
    faults.depth_format = static_cast<DepthFormat>(at - kDepthFormatNames.begin());
    faults.set_usual_planes(glm::distance(camera.eye, camera.look_at));
    faults.near_plane = flags.near_plane.value_or(faults.near_plane);
    faults.far_plane = flags.far_plane.value_or(faults.far_plane);
    const double near = faults.near_plane, far = faults.far_plane;
    if (!(0 < near && near < far && far <= kLargest))
      throw UsageError(fmt::format("--near and --far want 0 < near < far <= 1e15; got {} and {}", near, far));
  }
  faults.snap_bits = flags.snap_bits;
  faults.tessellate = flags.tessellate;
  if (faults.tessellate && *faults.tessellate % 2 != 0)
    throw UsageError(fmt::format("--tessellate wants an even number; got {}", *faults.tessellate));
  faults.float_precision = !flags.precision.empty();
  return faults;
}

void check_makes_faults(std::string_view renderer, const Faults& faults) {
  for (int i = 0; i < kFaults; ++i) {
    const auto fault = static_cast<FaultKind>(i);
    if (faults.has(fault) && !makes(renderer, fault))
      throw UsageError(
          fmt::format("--{}: the renderer '{}' does not make this fault", fault_name(fault), renderer));
  }
}

std::string fault_arguments(const Faults& faults) {
  std::string out;
  if (faults.shadow_offset) out += fmt::format(" --shadow-offset {}", *faults.shadow_offset);
  if (faults.depth_format)
    out += fmt::format(" --depth-format {} --near {} --far {}",
                       kDepthFormatNames[static_cast<std::size_t>(*faults.depth_format)], faults.near_plane,
                       faults.far_plane);
  if (faults.snap_bits) out += fmt::format(" --snap-bits {}", *faults.snap_bits);
  if (faults.tessellate) out += fmt::format(" --tessellate {}", *faults.tessellate);
  if (faults.float_precision) out += " --precision float";
  return out;
}

}  // namespace sidelight
