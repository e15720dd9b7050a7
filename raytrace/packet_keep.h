// SPDX-License-Identifier: MIT
// What the rays of a packet (packets.h) keep of the primitives they are asked about, group by group. See packet_kernel.h.
#pragma once

#include <bit>

#include "common/math/lane_ops.h"
#include "common/math/vec.h"
#include "raytrace/packets.h"

namespace sidelight::raytrace {

// Groups of a packet, as bits.
using Groups = std::uint64_t;
static_assert(RayPacket::kGroups <= 64);

// All that hold rays; p has some.
inline Groups all_groups(const RayPacket& p) { return ~Groups{0} >> (64 - p.groups); }

// Those of them of which ask(g), which tells bits of some side by side from g on, says so.
template <class F, class Ask>
Groups some_of(Groups groups, const Ask& ask) {
  constexpr Groups kSideBySide = (Groups{1} << kLanes<F>)-1;
  // Of few questions none is left out: that costs less than a branch that is taken as it comes.
  constexpr bool kFew = RayPacket::kGroups <= 4 * kLanes<F>;
  Groups out = 0;
#pragma GCC unroll 4
  for (std::size_t g = 0; g < RayPacket::kGroups; g += kLanes<F>)
    if (kFew || (groups >> g & kSideBySide) != 0) out |= Groups{ask(g)} << g;
  return out & groups;
}

template <class F>
void ask_lanes(RayPacket& p, std::size_t first, std::uint32_t bits, std::uint32_t primitive,
               VisibilityCounts& counts) {
  for (; bits != 0; bits &= bits - 1) {
    const std::size_t ray = first + static_cast<std::size_t>(std::countr_zero(bits));
    p.asked[ray] = 1;
    p.ask(p, ray, primitive, counts);
  }
}

// Rays of a packet that the primitive itself asks for, as bits.
template <class F>
std::uint32_t own_bits(const RayPacket& p, std::size_t first, std::uint32_t primitive) {
  using I = Ints<F>;
  return mask_bits<I>(load<I>(&p.own[first]) == I(static_cast<std::int32_t>(primitive)));
}

// Keeps the primitive where it is surely met and surely nearer than what is kept; asks where that is doubtful. `w_error`
// is infinite where nothing is known of its side and depth; then nothing is met for sure. Whether anything may have
// changed.
template <class F>
bool keep_nearer(RayPacket& p, std::size_t first, std::uint32_t primitive, const Mask<F>& met,
                 const Mask<F>& may, const F& w, const F& w_error, VisibilityCounts& counts) {
  using I = Ints<F>;
  const F held = load<F>(&p.w[first]);
  const Mask<F> nearer = met && w * F(kFloatDepthError) > w_error && w > held * F(kSurely);
  const Mask<F> farther = (w + w_error) * F(kSurely) < held;
  const Mask<F> open = may && held < F(kInfinity);
  std::uint32_t asked = mask_bits<F>(open && !(nearer || farther));
  // The light lies clearly before the surface that asks, which then is not in its way.
  if (p.any_hit && asked != 0) asked &= ~(mask_bits<F>(met) & own_bits<F>(p, first, primitive));
  if (any<F>(nearer)) {
    store(select<F>(nearer, p.any_hit ? F(kInfinity) : w, held), &p.w[first]);
    const F id = from_bits<F>(I(static_cast<std::int32_t>(primitive)));
    store(to_bits<F>(select<F>(nearer, id, from_bits<F>(load<I>(&p.primitive[first])))), &p.primitive[first]);
  } else if (asked == 0) {
    return false;
  }
  if (asked != 0) ask_lanes<F>(p, first, asked, primitive, counts);
  return true;
}

template <class F>
float least_of_group(const RayPacket& p, std::size_t group) {
  const float* w = &p.w[group * RayPacket::kGroup];
  F low = load<F>(w);
  for (int lane = kLanes<F>; lane < RayPacket::kGroup; lane += kLanes<F>)
    low = lane_min<F>(low, load<F>(w + lane));
  return least(low);
}

// After something was kept in these groups.
template <class F>
void update_least(RayPacket& p, Groups groups) {
  for (; groups != 0; groups &= groups - 1) {
    const auto g = static_cast<std::size_t>(std::countr_zero(groups));
    p.least_w[g] = least_of_group<F>(p, g);
  }
}

// What is still to be visited: a node or a leaf, and the groups that may meet something there.
struct PacketEntry {
  float depth;
  std::uint32_t first, count;
  Groups groups;
};

inline bool casts_none(const Prepared& prepared, const RayPacket& p, std::uint32_t primitive) {
  return p.any_hit && !prepared.all_cast_shadows && !casts_shadow(prepared.scene, primitive);
}

// ---- The items of a leaf, or of two, side by side, and groups of rays ----

constexpr std::size_t kLeavesTogether = 2, kMaxItems = kLeavesTogether * Bvh::kMaxLeaf;
using PerItem = std::array<float, kMaxItems>;

// Sets what hides a primitive from rays where it casts no shadow and is asked for one.
inline void hide_what_casts_none(const Prepared& prepared, const RayPacket& p,
                                 const std::uint32_t* primitives, std::uint32_t count, float* row,
                                 float hidden) {
  if (!p.any_hit || prepared.all_cast_shadows) return;
  for (std::uint32_t i = 0; i < count; ++i)
    if (casts_none(prepared, p, primitives[i])) row[i] = hidden;
}

// An item, and rays from this one on: i * kCapacity + ray.
using Pairs = std::array<std::int32_t, kMaxItems * RayPacket::kCapacity + RayPacket::kGroups>;
struct ItemAndRay {
  std::size_t i, ray;
};
inline ItemAndRay item_and_ray(std::int32_t pair) {
  const auto number = static_cast<std::size_t>(pair), capacity = std::size_t{RayPacket::kCapacity};
  return {number / capacity, number % capacity};
}

// Adds group g with each item, from `lane` on, that it may meet. Returns how many.
template <class B>
std::size_t add_pairs(const Mask<B>& met, std::size_t lane, std::size_t g, std::int32_t* pairs) {
  using I = Ints<B>;
  const I items = generate<I>([](int k) { return k * RayPacket::kCapacity; });
  const std::size_t first = lane * RayPacket::kCapacity + g * RayPacket::kGroup;
  return store_some<B>(met, items + I(static_cast<std::int32_t>(first)), pairs);
}

}  // namespace sidelight::raytrace
