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

// The smaller (greater) of two; as std::min() has it, but something that is done to many at once.
struct Less {
  template <class T>
  T operator()(T a, T b) const {
    return b < a ? b : a;
  }
};
struct More {
  template <class T>
  T operator()(T a, T b) const {
    return a < b ? b : a;
  }
};

// The least (greatest) of sixteen, by halves.
template <class Pick, class T>
T of_group(const T* x, const Pick& pick) {
  static_assert(RayPacket::kGroup == 16);
  std::array<T, 8> left;
  for (std::size_t i = 0; i < 8; ++i) left[i] = pick(x[i], x[i + 8]);
  for (std::size_t i = 0; i < 4; ++i) left[i] = pick(left[i], left[i + 4]);
  return pick(pick(left[0], left[2]), pick(left[1], left[3]));
}

}  // namespace

void ShadowPackets::Places::resize(std::size_t size) {
  u.resize(size);
  v.resize(size);
  per_depth.resize(size);
  number.resize(size);
  own.resize(size);
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
  if (find_places(first, true)) {
    trace_face(first, dark, counts);
  } else {
    for (int face = 0; face < 6; ++face) {
      find_places(face, false);
      trace_face(face, dark, counts);
    }
    for (std::size_t i = 0; i < asking.size(); ++i)
      if (max_norm(query(i).from - light.position) < kLeastDepth) leave(i);
  }
  trace_left(dark, counts);
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
    places_.u[size] = u;
    places_.v[size] = v;
    places_.per_depth[size] = static_cast<float>(per_depth);
    places_.number[size] = static_cast<std::uint32_t>(i);
    places_.own[size] = static_cast<std::int32_t>(asked.own);
    fit &= depth >= kLeastDepth && std::abs(u) <= kWide && std::abs(v) <= kWide;
    size += all || (face_of(p) == face && depth >= kLeastDepth);
  }
  places_.resize(size);
  return fit;
}

// Of up to sixteen places from this one on.
ShadowPackets::Extent ShadowPackets::group_at(std::size_t first) const {
  const double *u = &places_.u[first], *v = &places_.v[first];
  const float* per_depth = &places_.per_depth[first];
  if (first + RayPacket::kGroup <= places_.size())
    return {of_group(u, Less()), of_group(u, More()), of_group(v, Less()), of_group(v, More()),
            of_group(per_depth, Less())};
  Extent group;
  for (std::size_t i = 0; first + i < places_.size(); ++i)
    group.grow(Extent{u[i], u[i], v[i], v[i], per_depth[i]});
  return group;
}

// The groups of the places as they stand, and their area.
double ShadowPackets::find_groups() {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  groups_.clear();
  whole_ = Extent();
  double filled = 0;
  for (std::size_t at = 0; at < places_.size(); at += kGroup) {
    groups_.push_back(group_at(at));
    whole_.grow(groups_.back());
    filled += groups_.back().area();
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
    keys_[i] = spread(static_cast<std::uint32_t>(scale * (places_.u[i] - whole_.low_u))) |
               spread(static_cast<std::uint32_t>(scale * (places_.v[i] - whole_.low_v))) << 1;
    ++start[keys_[i] + 1];
  }
  for (std::size_t cell = 1; cell <= std::size_t{1} << 2 * bits; ++cell) start[cell] += start[cell - 1];
  sorted_.resize(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::size_t to = start[keys_[i]]++;
    sorted_.u[to] = places_.u[i];
    sorted_.v[to] = places_.v[i];
    sorted_.per_depth[to] = places_.per_depth[i];
    sorted_.number[to] = places_.number[i];
    sorted_.own[to] = places_.own[i];
  }
  std::swap(places_, sorted_);
}

// Packet by packet, as the groups come: those that lie apart go down the tree apart.
void ShadowPackets::trace_face(int face, std::vector<std::uint8_t>& dark, SignCounts& counts) {
  constexpr std::size_t kGroups = RayPacket::kGroups;
  if (places_.size() == 0) return;
  if (find_groups() > kApart * whole_.area()) {
    sort_places();
    find_groups();
  }
  const int axis = face / 2;
  glm::dvec3 middle(0);
  middle[axis] = face % 2 == 0 ? 1 : -1;
  packet_.U = packet_.V = glm::dvec3(0);
  packet_.U[(axis + 1) % 3] = 1;
  packet_.V[(axis + 2) % 3] = 1;
  for (std::size_t first = 0; first < groups_.size(); first += kGroups) {
    packet_.W = middle;
    trace_groups(first, std::min(first + kGroups, groups_.size()), dark, counts);
  }
}

void ShadowPackets::trace_groups(std::size_t first, std::size_t last, std::vector<std::uint8_t>& dark,
                                 SignCounts& counts) {
  constexpr std::size_t kGroup = RayPacket::kGroup;
  Extent extent;
  for (std::size_t g = first; g < last; ++g) extent.grow(groups_[g]);
  const double middle_u = 0.5 * (extent.low_u + extent.high_u),
               middle_v = 0.5 * (extent.low_v + extent.high_v);
  const std::size_t from = first * kGroup, size = std::min(places_.size(), last * kGroup) - from;
  packet_.size = static_cast<int>(size);
  for (std::size_t i = 0; i < size; ++i) packet_.u[i] = static_cast<float>(places_.u[from + i] - middle_u);
  for (std::size_t i = 0; i < size; ++i) packet_.v[i] = static_cast<float>(places_.v[from + i] - middle_v);
  std::copy_n(&places_.per_depth[from], size, packet_.w.begin());
  std::copy_n(&places_.own[from], size, packet_.own.begin());
  number_ = std::span(&places_.number[from], size);
  packet_.W += middle_u * packet_.U + middle_v * packet_.V;
  packet_.distance = (1 + 0x1p-22) * packet_.length / static_cast<double>(extent.least_per_depth);
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
    packet_.least_w[g - first] = groups_[g].least_per_depth;
  }
  start(packet_);
  packet_.budget.fill(kGroupWork);
  trace_packet(isa_, prepared_, packet_, counts);
  for (std::size_t i = 0; i < size; ++i) {
    dark[number_[i]] = packet_.primitive[i] >= 0;
    if (packet_.primitive[i] < 0 && packet_.budget[i / kGroup] < 0) leave(number_[i]);
  }
}

// A ray that goes without a packet.
void ShadowPackets::leave(std::size_t number) {
  left_.push_back(static_cast<std::uint32_t>(number));
  questions_.push_back({ray_to_light(query(number).from, *light_)});
}

void ShadowPackets::trace_left(std::vector<std::uint8_t>& dark, SignCounts& counts) {
  find_blocked(prepared_, questions_, light_->position, counts, isa_);
  for (std::size_t i = 0; i < left_.size(); ++i) dark[left_[i]] = questions_[i].blocked;
  left_.clear();
  questions_.clear();
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
