// SPDX-License-Identifier: MIT
// Packets: up to 1024 rays with a common origin, whose directions are d = W + u U + v V. Relative to the origin a
// triangle is three affine edge functions of (u, v) and 1/t is a fourth (common/model/ray_sheet.h), so that 16 rays are
// tested in a few operations, in float. Eye rays are such packets, and so are shadow rays seen from a point light.
//
// Every verdict is certified by a bound; where a bound does not decide, the caller's `ask` decides exactly, by the
// functions of visibility.h on the ray itself. So what comes out does not depend on lanes, order or packing.
#pragma once

#include <array>
#include <cstdint>

#include "common/model/ray_sheet.h"
#include "raytrace/prepared.h"

namespace sidelight::raytrace {

struct RayPacket {
  static constexpr int kGroup = 16, kGroups = 64, kCapacity = kGroup * kGroups;
  template <class T>
  using PerRay = std::array<T, static_cast<std::size_t>(kCapacity)>;
  template <class T>
  using PerGroup = std::array<T, static_cast<std::size_t>(kGroups)>;

  // The rays. Of shadow rays the origin is the light, and they go from there to the surfaces.
  int size = 0;
  glm::dvec3 origin{0}, W{0}, U{0}, V{0};
  double length = 0;       // at least |x| + |y| + |z| of any d, and of every partial sum on the way to it
  double distance = 0;     // of shadow rays: at least the distance from the origin of any surface that asks
  double place_error = 0;  // u and v may be off by this
  double near_error = 0;   // what is nearer to a ray than this times its distance is doubtful as well
  double reach = 0;        // greatest coordinate of all that can be met, and of the origin
  bool lattice = false;    // whether all u and v are whole numbers
  alignas(64) PerRay<float> u, v;
  alignas(64) PerRay<float> w;  // what counts is nearer than 1/w; 0: anything. Then of what is kept
  // What is kept: the nearest, or of shadow rays some blocker; -1: none.
  alignas(64) PerRay<std::int32_t> primitive;
  alignas(64) PerRay<std::int32_t> own;  // of shadow rays: the flat surface that asks, or -1
  bool any_hit = false;                  // shadow rays: the first one will do
  // Work left of each group of shadow rays (packet_walk.h): where it falls below 0 they are left as they are by then.
  alignas(64) PerGroup<std::int32_t> budget;
  // Whether anything at all was doubtful. If not, nothing but what is kept comes near to where the ray ends.
  PerRay<std::uint8_t> asked{};

  // What bounds the rays: the greatest |u| and |v|, the least and the greatest of each group, and its least w.
  float extent_u = 0, extent_v = 0;
  alignas(64) std::array<PerGroup<float>, 2> group_u, group_v;
  alignas(64) PerGroup<float> least_w;

  // Derived.
  int groups = 0;
  alignas(64) PerRay<float> square;  // where there are spheres: (d / length)²

  // Decides about a ray and a primitive, and changes w and primitive accordingly.
  void (*ask)(RayPacket& packet, std::size_t ray, std::uint32_t primitive,
              VisibilityCounts& counts) = nullptr;
  void* context = nullptr;
};

// To be called once the rays and what bounds them are given: nothing is kept yet, and entries beyond `size`, up to whole
// groups, become rays that ask for nothing. Kernels::trace_packet comes next.
void start(RayPacket& packet);

}  // namespace sidelight::raytrace
