// SPDX-License-Identifier: MIT
#include "raytrace/shadow_packets.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/math/norms.h"
#include "raytrace/secondary.h"

namespace sidelight::raytrace {
namespace {

// Places are sorted where groups as they come have more than this times the area of all.
constexpr float kApart = 1.5f;

// What a group may do before its rays leave the packet: rays too far apart have little in common. In steps of
// RayPacket::budget, of points that the eye sees and of all others.
constexpr int kGroupWork = 64, kSecondaryGroupWork = 24;

// Every second bit of eight.
std::int32_t spread(std::int32_t x) {
  x = (x | x << 4) & 0x0f0f;
  x = (x | x << 2) & 0x3333;
  return (x | x << 1) & 0x5555;
}

// The first of sixteen in this order, by halves: something that is done to many at once, as std::min() is not.
template <class Before, class T>
T of_group(const T* x, const Before& before) {
  static_assert(RayPacket::kGroup == 16);
  const auto pick = [&](T a, T b) { return before(b, a) ? b : a; };
  std::array<T, 8> left;
  for (std::size_t i = 0; i < 8; ++i) left[i] = pick(x[i], x[i + 8]);
  for (std::size_t i = 0; i < 4; ++i) left[i] = pick(left[i], left[i + 4]);
  return pick(pick(left[0], left[2]), pick(left[1], left[3]));
}

}  // namespace

void ShadowPackets::Extent::grow(const Extent& other) {
  low_u = std::min(low_u, other.low_u);
  high_u = std::max(high_u, other.high_u);
  low_v = std::min(low_v, other.low_v);
  high_v = std::max(high_v, other.high_v);
  least_per_depth = std::min(least_per_depth, other.least_per_depth);
}

ShadowPackets::ShadowPackets(const Prepared& prepared, Isa isa) : prepared_(prepared), isa_(isa) {
  packet_.any_hit = true;
  packet_.length = 1 + 2 * CubeFace::kWide;  // |axis| + |u U| + |v V|
  packet_.ask = ask;
  packet_.context = this;
}

void ShadowPackets::trace(const Light& light, const ShadowQueries& queries, std::vector<std::uint8_t>& dark,
                          VisibilityCounts& counts) {
  light_ = &light;
  queries_ = &queries;
  dark.assign(queries.size(), 0);
  if (light.directional) {
    for (std::size_t i = 0; i < queries.size(); ++i)
      if (queries.asks[i] != 0) leave(i);
    trace_left(dark, counts);
    return;
  }
  packet_.origin = light.position;
  packet_.reach = prepared_.reach_from(light.position);
  const auto asks = std::find_if(queries.asks.begin(), queries.asks.end(), [](auto ask) { return ask != 0; });
  if (asks == queries.asks.end()) return;
  // Most often one face will do, though some of the places lie beyond its edges.
  face_ = face_towards(queries.from(static_cast<std::size_t>(asks - queries.asks.begin())), light.position);
  if (find_places(isa_, queries, face_, true, places_)) {
    trace_face(dark, counts);
  } else {
    for (int face = 0; face < 6; ++face) {
      face_ = {face / 2, face % 2 == 0 ? 1.0 : -1.0, light.position};
      find_places(isa_, queries, face_, false, places_);
      trace_face(dark, counts);
    }
    for (std::size_t i = 0; i < queries.size(); ++i)
      if (queries.asks[i] != 0 && max_norm(queries.from(i) - light.position) < CubeFace::kLeastDepth)
        leave(i);
  }
  trace_left(dark, counts);
}

// Of up to sixteen places from this one on.
ShadowPackets::Extent ShadowPackets::group_at(std::size_t first) const {
  const float *u = &places_.u[first], *v = &places_.v[first], *per_depth = &places_.per_depth[first];
  if (first + RayPacket::kGroup <= places_.size())
    return {of_group(u, std::less()), of_group(u, std::greater()), of_group(v, std::less()),
            of_group(v, std::greater()), of_group(per_depth, std::less())};
  Extent group;
  for (std::size_t i = 0; first + i < places_.size(); ++i)
    group.grow(Extent{u[i], u[i], v[i], v[i], per_depth[i]});
  return group;
}

// The groups of the places as they stand, and their area.
float ShadowPackets::find_groups() {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  groups_.resize((places_.size() + kGroup - 1) / kGroup);
  Extent whole;
  float filled = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Extent group = group_at(g * kGroup);
    groups_[g] = group;
    whole.grow(group);
    filled += group.area();
  }
  whole_ = whole;
  return filled;
}

// By Morton code, in cells of about four; in a cell they stay in order.
void ShadowPackets::sort_places() {
  int bits = 2;
  while (bits < 6 && places_.size() > std::size_t{4} << 2 * bits) ++bits;
  const float scale = static_cast<float>((1 << bits) - 1) / std::max(whole_.width(), 0x1p-100f);
  const auto cell_of = [scale](float place, float low) {
    return static_cast<std::int32_t>(scale * (place - low));
  };
  keys_.resize(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i)
    keys_[i] = spread(cell_of(places_.u[i], whole_.low_u)) | spread(cell_of(places_.v[i], whole_.low_v)) << 1;
  std::array<std::uint32_t, (1 << 12) + 1> start;
  std::fill_n(start.begin(), (std::size_t{1} << 2 * bits) + 1, 0u);
  for (const std::int32_t key : keys_) ++start[static_cast<std::size_t>(key) + 1];
  for (std::size_t cell = 1; cell <= std::size_t{1} << 2 * bits; ++cell) start[cell] += start[cell - 1];
  sorted_.resize(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::size_t to = start[static_cast<std::size_t>(keys_[i])]++;
    sorted_.u[to] = places_.u[i];
    sorted_.v[to] = places_.v[i];
    sorted_.per_depth[to] = places_.per_depth[i];
    sorted_.number[to] = places_.number[i];
    sorted_.own[to] = places_.own[i];
  }
  std::swap(places_, sorted_);
}

// Packet by packet, as the groups come: those that lie apart go down the tree apart.
void ShadowPackets::trace_face(std::vector<std::uint8_t>& dark, VisibilityCounts& counts) {
  constexpr std::size_t kGroups = RayPacket::kGroups;
  if (places_.size() == 0) return;
  if (find_groups() > kApart * whole_.area()) {
    sort_places();
    find_groups();
  }
  const int axis = face_.axis;
  packet_.U = packet_.V = glm::dvec3(0);
  packet_.U[(axis + 1) % 3] = 1;
  packet_.V[(axis + 2) % 3] = 1;
  for (std::size_t first = 0; first < groups_.size(); first += kGroups)
    trace_groups(first, std::min(first + kGroups, groups_.size()), dark, counts);
}

void ShadowPackets::trace_groups(std::size_t first, std::size_t last, std::vector<std::uint8_t>& dark,
                                 VisibilityCounts& counts) {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  Extent extent;
  for (std::size_t g = first; g < last; ++g) extent.grow(groups_[g]);
  const float middle_u = 0.5f * (extent.low_u + extent.high_u),
              middle_v = 0.5f * (extent.low_v + extent.high_v);
  const std::size_t from = first * kGroup, size = std::min(places_.size(), last * kGroup) - from;
  packet_.size = static_cast<int>(size);
  for (std::size_t i = 0; i < size; ++i) packet_.u[i] = places_.u[from + i] - middle_u;
  for (std::size_t i = 0; i < size; ++i) packet_.v[i] = places_.v[from + i] - middle_v;
  std::copy_n(&places_.per_depth[from], size, packet_.w.begin());
  std::copy_n(&places_.own[from], size, packet_.own.begin());
  number_ = std::span(&places_.number[from], size);
  packet_.W = (face_.middle_u + static_cast<double>(middle_u)) * packet_.U +
              (face_.middle_v + static_cast<double>(middle_v)) * packet_.V;
  packet_.W[face_.axis] = face_.sign;
  packet_.distance = (1 + 0x1p-22) * packet_.length / static_cast<double>(extent.least_per_depth);
  // Places are rounded in double, at most kWide, and to float, from the face's middle and from the packet's.
  packet_.place_error =
      0x1p-49 * CubeFace::kWide + 0x1p-23 * static_cast<double>(whole_.farthest() + extent.width());
  // Rounding keeps the order, so that a group's least is that of its rays.
  packet_.extent_u = std::max(extent.high_u - middle_u, middle_u - extent.low_u);
  packet_.extent_v = std::max(extent.high_v - middle_v, middle_v - extent.low_v);
  for (std::size_t g = first; g < last; ++g) {
    packet_.group_u[0][g - first] = groups_[g].low_u - middle_u;
    packet_.group_u[1][g - first] = groups_[g].high_u - middle_u;
    packet_.group_v[0][g - first] = groups_[g].low_v - middle_v;
    packet_.group_v[1][g - first] = groups_[g].high_v - middle_v;
    packet_.least_w[g - first] = groups_[g].least_per_depth;
  }
  start(packet_);
  packet_.budget.fill(queries_->seen_by_eye ? kGroupWork : kSecondaryGroupWork);
  kernels_for(isa_).trace_packet(prepared_, packet_, counts);
  // (Bytes may be part of anything: told apart, nothing is read again after each.)
  std::uint8_t* const dark_of = dark.data();
  const std::int32_t* const number = number_.data();
  for (std::size_t i = 0; i < size; ++i)
    dark_of[static_cast<std::size_t>(number[i])] = packet_.primitive[i] >= 0;
  for (std::size_t g = 0; g < last - first; ++g) {
    if (packet_.budget[g] >= 0) continue;
    for (std::size_t i = g * kGroup; i < std::min(size, (g + 1) * kGroup); ++i)
      if (packet_.primitive[i] < 0) leave(static_cast<std::size_t>(number_[i]));
  }
}

// A ray that goes without a packet.
void ShadowPackets::leave(std::size_t number) {
  left_.push_back(static_cast<std::uint32_t>(number));
  questions_.push_back({ray_to_light(queries_->from(number), *light_)});
}

void ShadowPackets::trace_left(std::vector<std::uint8_t>& dark, VisibilityCounts& counts) {
  find_blocked(prepared_, questions_, light_->directional ? nullptr : &light_->position, counts, isa_);
  for (std::size_t i = 0; i < left_.size(); ++i) dark[left_[i]] = questions_[i].blocked;
  left_.clear();
  questions_.clear();
}

void ShadowPackets::ask(RayPacket& packet, std::size_t ray, std::uint32_t primitive,
                        VisibilityCounts& counts) {
  const ShadowPackets& self = *static_cast<const ShadowPackets*>(packet.context);
  // As blocker() does; what casts no shadow is not asked about.
  const Scene& scene = self.prepared_.scene;
  const Ray exact =
      ray_to_light(self.queries_->from(static_cast<std::size_t>(self.number_[ray])), *self.light_);
  const Hit hit = intersect(scene, primitive, exact, kRayStart, counts);
  if (!hit.found() || !before_light(scene, hit, exact, self.light_->position, counts)) return;
  packet.primitive[ray] = static_cast<std::int32_t>(primitive);
  packet.w[ray] = kInfinity;
}

}  // namespace sidelight::raytrace
