// SPDX-License-Identifier: MIT
#include "raytrace/shadow_packets.h"

#include <algorithm>
#include <cmath>

#include "raytrace/eye_packets.h"
#include "raytrace/secondary.h"

namespace sidelight::raytrace {
namespace {

// What a packet may do before its rays go alone: rays too far apart have little in common. In steps of RayPacket::budget;
// a single ray takes about four.
constexpr int kPacketWork = 16, kRayWork = 2;

// Points nearer to the light than this have no direction from it that a double could hold.
constexpr double kLeastDepth = 1e-100;

// Every second bit of eight.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 4) & 0x0f0f;
  x = (x | x << 2) & 0x3333;
  return (x | x << 1) & 0x5555;
}

struct Extent {
  double low_u = std::numeric_limits<double>::infinity(), high_u = -low_u, low_v = low_u, high_v = -low_u;

  void grow(double u, double v) {
    low_u = std::min(low_u, u);
    high_u = std::max(high_u, u);
    low_v = std::min(low_v, v);
    high_v = std::max(high_v, v);
  }
  void grow(const Extent& other) {
    grow(other.low_u, other.low_v);
    grow(other.high_u, other.high_v);
  }
  double area() const { return (high_u - low_u) * (high_v - low_v); }
};

}  // namespace

ShadowPackets::ShadowPackets(const Prepared& prepared, Isa isa) : prepared_(prepared), isa_(isa) {
  packet_.any_hit = true;
  packet_.length = 3;  // |axis| + |u U| + |v V|, each at most 1
  packet_.all_cast = std::all_of(prepared.scene.materials.begin(), prepared.scene.materials.end(),
                                 [](const Material& material) { return material.casts_shadow; });
  packet_.ask = ask;
  packet_.context = this;
}

void ShadowPackets::trace(const Light& light, std::span<const ShadowQuery> queries,
                          std::vector<std::uint8_t>& dark, SignCounts& counts) {
  light_ = &light;
  queries_ = queries;
  dark.assign(queries.size(), 0);
  packet_.origin = light.position;
  packet_.reach = reach_of(prepared_, light.position);
  for (std::vector<Place>& face : faces_) face.clear();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const glm::dvec3 p = queries[i].from - light.position;
    const double x = std::abs(p.x), y = std::abs(p.y), z = std::abs(p.z);
    const int axis = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
    const double depth = std::abs(p[axis]), per_depth = 1 / depth;
    if (depth < kLeastDepth) {
      dark[i] = is_dark(static_cast<std::uint32_t>(i), counts);
      continue;
    }
    faces_[static_cast<std::size_t>(2 * axis + (p[axis] < 0 ? 1 : 0))].push_back(
        {per_depth * p[(axis + 1) % 3], per_depth * p[(axis + 2) % 3], depth, static_cast<std::uint32_t>(i),
         0});
  }
  for (int face = 0; face < 6; ++face) trace_face(face, dark, counts);
}

// By Morton code, in two passes of a radix sort.
void ShadowPackets::sort_face() {
  Extent extent;
  for (const Place& place : sorted_) extent.grow(place.u, place.v);
  const double width = std::max({extent.high_u - extent.low_u, extent.high_v - extent.low_v, 0x1p-100});
  const double scale = 255 / width;
  for (Place& place : sorted_)
    place.key = spread(static_cast<std::uint32_t>(scale * (place.u - extent.low_u))) |
                spread(static_cast<std::uint32_t>(scale * (place.v - extent.low_v))) << 1;
  other_.resize(sorted_.size());
  for (const int shift : {0, 8}) {
    std::array<std::uint32_t, 257> start{};
    for (const Place& place : sorted_) ++start[(place.key >> shift & 255) + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    for (const Place& place : sorted_) other_[start[place.key >> shift & 255]++] = place;
    sorted_.swap(other_);
  }
}

// Cut where what lies between the groups would be much more than the groups.
void ShadowPackets::trace_face(int face, std::vector<std::uint8_t>& dark, SignCounts& counts) {
  constexpr std::size_t kGroup = RayPacket::kGroup, kCapacity = RayPacket::kCapacity;
  constexpr double kEmpty = 3;
  sorted_.swap(faces_[static_cast<std::size_t>(face)]);
  if (sorted_.empty()) return;
  sort_face();
  std::size_t first = 0;
  Extent whole;
  double filled = 0;
  for (std::size_t at = 0; at < sorted_.size(); at += kGroup) {
    Extent group, more = whole;
    for (std::size_t i = at; i < std::min(at + kGroup, sorted_.size()); ++i)
      group.grow(sorted_[i].u, sorted_[i].v);
    more.grow(group);
    if (at > first && (at - first == kCapacity || more.area() > kEmpty * (filled + group.area()))) {
      trace_places(face, first, at, dark, counts);
      first = at;
      more = group;
      filled = 0;
    }
    whole = more;
    filled += group.area();
  }
  trace_places(face, first, sorted_.size(), dark, counts);
}

void ShadowPackets::trace_places(int face, std::size_t first, std::size_t last,
                                 std::vector<std::uint8_t>& dark, SignCounts& counts) {
  Extent extent;
  double farthest = 0;
  for (std::size_t i = first; i < last; ++i) {
    extent.grow(sorted_[i].u, sorted_[i].v);
    farthest = std::max(farthest, sorted_[i].depth);
  }
  const double middle_u = 0.5 * (extent.low_u + extent.high_u),
               middle_v = 0.5 * (extent.low_v + extent.high_v);
  packet_.size = static_cast<int>(last - first);
  for (std::size_t i = 0; i < last - first; ++i) {
    const Place& place = sorted_[first + i];
    packet_.u[i] = static_cast<float>(place.u - middle_u);
    packet_.v[i] = static_cast<float>(place.v - middle_v);
    packet_.w[i] = static_cast<float>(1 / place.depth);
    packet_.own[i] = static_cast<std::int32_t>(queries_[place.query].own);
    query_[i] = place.query;
  }
  const int axis = face / 2;
  packet_.W = packet_.U = packet_.V = glm::dvec3(0);
  packet_.W[axis] = face % 2 == 0 ? 1 : -1;
  packet_.U[(axis + 1) % 3] = 1;
  packet_.V[(axis + 2) % 3] = 1;
  packet_.W += middle_u * packet_.U + middle_v * packet_.V;
  packet_.distance = 3 * farthest;
  // Places are rounded in double, at most 1, and in float.
  packet_.place_error =
      0x1p-50 + 0x1p-23 * std::max(extent.high_u - extent.low_u, extent.high_v - extent.low_v);
  finish_places(packet_);
  start(packet_);
  packet_.budget = kPacketWork + kRayWork * packet_.size;
  trace_packet(isa_, prepared_, packet_, counts);
  const bool all = packet_.budget >= 0;
  for (std::size_t i = 0; i < last - first; ++i)
    dark[query_[i]] = packet_.primitive[i] >= 0 || (!all && is_dark(query_[i], counts));
}

// Alone.
bool ShadowPackets::is_dark(std::uint32_t query, SignCounts& counts) const {
  return blocker(prepared_, ray_to_light(queries_[query].from, *light_), &light_->position, counts, kRayStart,
                 Precision::exact, isa_)
      .found();
}

void ShadowPackets::ask(RayPacket& packet, std::size_t ray, std::uint32_t primitive, SignCounts& counts) {
  const ShadowPackets& self = *static_cast<const ShadowPackets*>(packet.context);
  // As blocker() does; what casts no shadow is not asked about.
  const Scene& scene = self.prepared_.scene;
  const Ray exact = ray_to_light(self.queries_[self.query_[ray]].from, *self.light_);
  const Hit hit = intersect(scene, primitive, exact, kRayStart, counts);
  if (!hit.found() || !before_light(scene, hit, exact, self.light_->position, counts)) return;
  packet.primitive[ray] = static_cast<std::int32_t>(primitive);
  packet.w[ray] = std::numeric_limits<float>::infinity();
}

}  // namespace sidelight::raytrace
