// SPDX-License-Identifier: MIT
// What a scene uses of the model. Computed from the scene as it will be rendered (switches and overrides applied);
// `sidelight info` shows it, and the renderers do not enter what is not needed. A need never chooses a precision, a
// tolerance or a depth: with one claimed that the scene does not have, every bit of the picture stays.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "common/scene/scene.h"

namespace sidelight {

enum class Need {
  mirrors,                // a material that is used has c2 > 0
  refraction,             // a material that is used has c3 > 0
  overlapping_solids,     // two solids whose bounds meet: only then can surfaces lie together
  light_attenuation,      // a point light with other coefficients than (1, 0, 0)
  secondary_attenuation,  // the same of w(r), where there are secondary rays
  live_lights,            // a light that is not black
  spheres,
  planes,
  meshes
};
inline constexpr int kNeeds = 9;
inline constexpr std::array<std::string_view, kNeeds> kNeedNames{"mirrors",
                                                                 "refraction",
                                                                 "overlapping solids",
                                                                 "light attenuation",
                                                                 "secondary attenuation",
                                                                 "live lights",
                                                                 "spheres",
                                                                 "planes",
                                                                 "meshes"};

struct Needs {
  std::array<bool, kNeeds> has{};

  bool operator[](Need need) const { return has[static_cast<std::size_t>(need)]; }
  bool& operator[](Need need) { return has[static_cast<std::size_t>(need)]; }
  bool secondary_rays() const { return (*this)[Need::mirrors] || (*this)[Need::refraction]; }
};

Needs needs_of(const Scene& scene);

// Axis-aligned bounds of a solid, a little larger than it is: by 2^-30 of its greatest coordinate, far beyond all
// rounding. A plane's half-space is unbounded, unless its normal is an axis.
struct Bounds {
  glm::dvec3 low, high;

  bool meets(const Bounds& other) const;
};
Bounds bounds_of(const Scene& scene, const Object& object);

// Each pair of these that meet, once, by their numbers, in any order. Whether all pairs were looked at: not if `visit`
// returned false, and not where so many are beside each other that it would take more than kMostLooks, some 12 ns each.
inline constexpr std::size_t kMostLooks = std::size_t{1} << 26;
bool visit_meeting(std::span<const Bounds> bounds,
                   const std::function<bool(std::size_t, std::size_t)>& visit);

}  // namespace sidelight
