// SPDX-License-Identifier: MIT
#include "raytrace/shadow_packets.h"

#include <algorithm>
#include <cmath>

#include "common/math/max_norm.h"
#include "raytrace/secondary.h"

namespace sidelight::raytrace {
namespace {

// Places are sorted where groups as they come have more than this times the area of all.
constexpr double kApart = 1.5;

// What a group may do before its rays go alone: rays too far apart have little in common. In steps of RayPacket::budget,
// that is about as much as they would do alone.
constexpr int kGroupWork = 64;

// Points nearer to the light than this have no direction from it that a double could hold.
constexpr double kLeastDepth = 1e-100;

// How far beyond its edges a face is used where that spares a second one.
constexpr double kWide = 2;

// Every second bit of eight.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 4) & 0x0f0f;
  x = (x | x << 2) & 0x3333;
  return (x | x << 1) & 0x5555;
}

// Of the cube around the light: +x, -x, +y, ...
int face_of(const glm::dvec3& p) {
  const double x = std::abs(p.x), y = std::abs(p.y), z = std::abs(p.z);
  const int axis = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
  return 2 * axis + (p[axis] < 0 ? 1 : 0);
}

}  // namespace

void ShadowPackets::Extent::grow(const Place& place) {
  grow(Extent{place.u, place.u, place.v, place.v, place.per_depth});
}

void ShadowPackets::Extent::grow(const Extent& other) {
  low_u = std::min(low_u, other.low_u);
  high_u = std::max(high_u, other.high_u);
  low_v = std::min(low_v, other.low_v);
  high_v = std::max(high_v, other.high_v);
  least_per_depth = std::min(least_per_depth, other.least_per_depth);
}

ShadowPackets::ShadowPackets(const Prepared& prepared, Isa isa) : prepared_(prepared), isa_(isa) {
  packet_.any_hit = true;
  packet_.length = 1 + 2 * kWide;  // |axis| + |u U| + |v V|
  packet_.all_cast = std::all_of(prepared.scene.materials.begin(), prepared.scene.materials.end(),
                                 [](const Material& material) { return material.casts_shadow; });
  packet_.ask = ask;
  packet_.context = this;
}

void ShadowPackets::trace(const Light& light, std::span<const ShadowQuery> queries,
                          std::span<const std::uint32_t> asking, std::vector<std::uint8_t>& dark,
                          SignCounts& counts) {
  light_ = &light;
  queries_ = queries;
  asking_ = asking;
  dark.assign(asking.size(), 0);
  packet_.origin = light.position;
  packet_.reach = prepared_.reach_from(light.position);
  if (asking.empty()) return;
  // Most often one face will do, though some of the places lie beyond its edges.
  const int first = face_of(query(0).from - light.position);
  if (find_places(first, true)) return trace_face(first, dark, counts);
  for (int face = 0; face < 6; ++face) {
    find_places(face, false);
    trace_face(face, dark, counts);
  }
  for (std::size_t i = 0; i < asking.size(); ++i)
    if (max_norm(query(i).from - light.position) < kLeastDepth) dark[i] = is_dark(i, counts);
}

// Of all queries, false if some cannot be seen through this face; or of those whose face it is.
bool ShadowPackets::find_places(int face, bool all) {
  switch (face / 2) {
    case 0:
      return find_places_along<0>(face, all);
    case 1:
      return find_places_along<1>(face, all);
    default:
      return find_places_along<2>(face, all);
  }
}

template <int kAxis>
bool ShadowPackets::find_places_along(int face, bool all) {
  const double sign = face % 2 == 0 ? 1 : -1;
  places_.resize(asking_.size());
  std::size_t size = 0;
  bool fit = true;
  for (std::size_t i = 0; i < asking_.size(); ++i) {
    const ShadowQuery& asked = query(i);
    const glm::dvec3 p = asked.from - light_->position;
    const double depth = sign * p[kAxis], per_depth = 1 / depth;
    const double u = per_depth * p[(kAxis + 1) % 3], v = per_depth * p[(kAxis + 2) % 3];
    places_[size] = {u, v, per_depth, static_cast<std::uint32_t>(i), asked.own};
    fit &= depth >= kLeastDepth && std::abs(u) <= kWide && std::abs(v) <= kWide;
    size += all || (face_of(p) == face && depth >= kLeastDepth);
  }
  places_.resize(size);
  return fit;
}

// The groups of the places as they stand, and their area.
double ShadowPackets::find_groups() {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  groups_.clear();
  whole_ = Extent();
  double filled = 0;
  for (std::size_t at = 0; at < places_.size(); at += kGroup) {
    Extent group;
    for (std::size_t i = at; i < std::min(at + kGroup, places_.size()); ++i) group.grow(places_[i]);
    groups_.push_back(group);
    whole_.grow(group);
    filled += group.area();
  }
  return filled;
}

// By Morton code, of about as many cells as there are places; in a cell they stay in order.
void ShadowPackets::sort_places() {
  int bits = 2;
  while (bits < 6 && places_.size() > std::size_t{1} << 2 * bits) ++bits;
  const double width = std::max({whole_.high_u - whole_.low_u, whole_.high_v - whole_.low_v, 0x1p-100});
  const double scale = static_cast<double>((1 << bits) - 1) / width;
  std::array<std::uint32_t, (1 << 12) + 1> start;
  std::fill_n(start.begin(), (std::size_t{1} << 2 * bits) + 1, 0u);
  keys_.resize(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    keys_[i] = spread(static_cast<std::uint32_t>(scale * (places_[i].u - whole_.low_u))) |
               spread(static_cast<std::uint32_t>(scale * (places_[i].v - whole_.low_v))) << 1;
    ++start[keys_[i] + 1];
  }
  for (std::size_t cell = 1; cell <= std::size_t{1} << 2 * bits; ++cell) start[cell] += start[cell - 1];
  sorted_.resize(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) sorted_[start[keys_[i]]++] = places_[i];
  places_.swap(sorted_);
}

// Cut where what lies between the groups would be much more than the groups.
void ShadowPackets::trace_face(int face, std::vector<std::uint8_t>& dark, SignCounts& counts) {
  constexpr std::size_t kGroups = RayPacket::kGroups;
  constexpr double kEmpty = 3;
  if (places_.empty()) return;
  if (find_groups() > kApart * whole_.area()) {
    sort_places();
    find_groups();
  }
  const int axis = face / 2;
  packet_.W = packet_.U = packet_.V = glm::dvec3(0);
  packet_.W[axis] = face % 2 == 0 ? 1 : -1;
  packet_.U[(axis + 1) % 3] = 1;
  packet_.V[(axis + 2) % 3] = 1;
  const glm::dvec3 middle_of_face = packet_.W;
  const auto trace_from = [&](std::size_t first, std::size_t last, const Extent& extent) {
    packet_.W = middle_of_face;
    trace_groups(first, last, extent, dark, counts);
  };
  std::size_t first = 0;
  Extent whole;
  double filled = 0;
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    Extent more = whole;
    more.grow(groups_[at]);
    const double area = groups_[at].area();
    if (at > first && (at - first == kGroups || more.area() > kEmpty * (filled + area))) {
      trace_from(first, at, whole);
      first = at;
      more = groups_[at];
      filled = 0;
    }
    whole = more;
    filled += area;
  }
  trace_from(first, groups_.size(), whole);
}

void ShadowPackets::trace_groups(std::size_t first, std::size_t last, const Extent& extent,
                                 std::vector<std::uint8_t>& dark, SignCounts& counts) {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  const double middle_u = 0.5 * (extent.low_u + extent.high_u),
               middle_v = 0.5 * (extent.low_v + extent.high_v);
  const std::span places(&places_[first * kGroup], std::min(places_.size(), last * kGroup) - first * kGroup);
  packet_.size = static_cast<int>(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    packet_.u[i] = static_cast<float>(places[i].u - middle_u);
    packet_.v[i] = static_cast<float>(places[i].v - middle_v);
    packet_.w[i] = static_cast<float>(places[i].per_depth);
    packet_.own[i] = static_cast<std::int32_t>(places[i].own);
    number_[i] = places[i].number;
  }
  packet_.W += middle_u * packet_.U + middle_v * packet_.V;
  packet_.distance = packet_.length / extent.least_per_depth;
  // Places are rounded in double, at most kWide, and in float.
  packet_.place_error =
      0x1p-49 * kWide + 0x1p-23 * std::max(extent.high_u - extent.low_u, extent.high_v - extent.low_v);
  // Rounding keeps the order, so that a group's least is that of its rays.
  packet_.extent_u = static_cast<float>(extent.high_u - middle_u);
  packet_.extent_v = static_cast<float>(extent.high_v - middle_v);
  for (std::size_t g = first; g < last; ++g) {
    packet_.group_u[0][g - first] = static_cast<float>(groups_[g].low_u - middle_u);
    packet_.group_u[1][g - first] = static_cast<float>(groups_[g].high_u - middle_u);
    packet_.group_v[0][g - first] = static_cast<float>(groups_[g].low_v - middle_v);
    packet_.group_v[1][g - first] = static_cast<float>(groups_[g].high_v - middle_v);
    packet_.least_w[g - first] = static_cast<float>(groups_[g].least_per_depth);
  }
  start(packet_);
  packet_.budget.fill(kGroupWork);
  trace_packet(isa_, prepared_, packet_, counts);
  for (std::size_t i = 0; i < places.size(); ++i)
    dark[number_[i]] =
        packet_.primitive[i] >= 0 || (packet_.budget[i / kGroup] < 0 && is_dark(number_[i], counts));
}

// Alone.
bool ShadowPackets::is_dark(std::size_t number, SignCounts& counts) const {
  return blocker(prepared_, ray_to_light(query(number).from, *light_), &light_->position, counts, kRayStart,
                 Precision::exact, isa_)
      .found();
}

void ShadowPackets::ask(RayPacket& packet, std::size_t ray, std::uint32_t primitive, SignCounts& counts) {
  const ShadowPackets& self = *static_cast<const ShadowPackets*>(packet.context);
  // As blocker() does; what casts no shadow is not asked about.
  const Scene& scene = self.prepared_.scene;
  const Ray exact = ray_to_light(self.query(self.number_[ray]).from, *self.light_);
  const Hit hit = intersect(scene, primitive, exact, kRayStart, counts);
  if (!hit.found() || !before_light(scene, hit, exact, self.light_->position, counts)) return;
  packet.primitive[ray] = static_cast<std::int32_t>(primitive);
  packet.w[ray] = std::numeric_limits<float>::infinity();
}

}  // namespace sidelight::raytrace
