// SPDX-License-Identifier: MIT
#include "raytrace/eye_packets.h"

#include <algorithm>
#include <cmath>

#include "common/model/ray_sheet.h"
#include "raytrace/kernels.h"

namespace sidelight::raytrace {
namespace {

constexpr int kColumns = 32, kRows = 32;  // of a packet, in samples
constexpr int kBlock = EyePackets::kRun;  // of its groups, along both edges
static_assert(kColumns * kRows == RayPacket::kCapacity && kBlock * kBlock == RayPacket::kGroup &&
              kColumns % kBlock == 0);

// visit(column, row) of a packet's samples, block by block, so that a group's rays are close to each other.
template <class Visit>
void for_each_sample(int columns, int rows, const Visit& visit) {
  for (int y = 0; y < rows; y += kBlock)
    for (int x = 0; x < columns; x += kBlock)
      for (int row = y; row < std::min(y + kBlock, rows); ++row)
        for (int column = x; column < std::min(x + kBlock, columns); ++column) visit(column, row);
}

}  // namespace

EyePackets::EyePackets(const Prepared& prepared, const Camera& camera, Isa isa)
    : prepared_(prepared), camera_(camera), isa_(isa) {
  const RaySheet sheet = lattice_sheet(camera);
  packet_.origin = sheet.origin;
  packet_.U = sheet.U;
  packet_.V = sheet.V;
  packet_.length = sheet.size.x + sheet.size.y + sheet.size.z;
  packet_.reach = prepared.reach_from(camera.eye);
  // place.h: what is near lies within 10 (step + 32 u reach) of the place, up to 16 reach away: below 2^-40 reach.
  packet_.near_error = 0x1p-39;
  packet_.lattice = true;
  packet_.extent_u = kColumns / 2;
  packet_.extent_v = kRows / 2;
  packet_.ask = ask;
  packet_.context = this;
}

void EyePackets::trace(int X0, int Y0, int columns, int rows, std::vector<Hit>& hits,
                       std::vector<std::uint8_t>& alone, VisibilityCounts& counts) {
  hits.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  alone.resize(hits.size());
  std::size_t first = 0;
  for (int y = 0; y < rows; y += kRows)
    for (int x = 0; x < columns; x += kColumns) {
      load(X0 + x, Y0 + y, std::min(kColumns, columns - x), std::min(kRows, rows - y));
      kernels_for(isa_).trace_packet(prepared_, packet_, counts);
      const auto size = static_cast<std::ptrdiff_t>(packet_.size);
      std::transform(packet_.primitive.begin(), packet_.primitive.begin() + size, &hits[first],
                     [](std::int32_t primitive) {
                       return Hit{0, static_cast<std::uint32_t>(primitive)};
                     });
      std::transform(packet_.asked.begin(), packet_.asked.begin() + size, &alone[first],
                     [](std::uint8_t asked) { return static_cast<std::uint8_t>(asked ^ 1); });
      first += static_cast<std::size_t>(size);
    }
}

std::vector<std::uint32_t> EyePackets::order(int columns, int rows) {
  std::vector<std::uint32_t> order;
  for (int y = 0; y < rows; y += kRows)
    for (int x = 0; x < columns; x += kColumns)
      for_each_sample(std::min(kColumns, columns - x), std::min(kRows, rows - y), [&](int column, int row) {
        order.push_back(static_cast<std::uint32_t>((y + row) * columns + x + column));
      });
  return order;
}

void EyePackets::load(int X0, int Y0, int columns, int rows) {
  X0_ = X0;
  Y0_ = Y0;
  if (columns != columns_ || rows != rows_) place(columns, rows);
  packet_.W = camera_.direction(X0 + kColumns / 2, Y0 + kRows / 2);
  packet_.w.fill(0);
  packet_.least_w.fill(0);
  start(packet_);
}

// All packets of a size are alike.
void EyePackets::place(int columns, int rows) {
  columns_ = columns;
  rows_ = rows;
  std::size_t i = 0;
  for_each_sample(columns, rows, [&](int column, int row) {
    packet_.u[i] = static_cast<float>(column - kColumns / 2);
    packet_.v[i] = static_cast<float>(row - kRows / 2);
    sample_[i++] = {static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row)};
  });
  packet_.size = static_cast<int>(i);
  const auto bound = [&](const float* place, std::size_t first, auto& of) {
    const std::size_t last = std::min(first + RayPacket::kGroup, i);
    const auto [low, high] = std::minmax_element(place + first, place + last);
    of[0][first / RayPacket::kGroup] = *low;
    of[1][first / RayPacket::kGroup] = *high;
  };
  for (std::size_t first = 0; first < i; first += RayPacket::kGroup) {
    bound(packet_.u.data(), first, packet_.group_u);
    bound(packet_.v.data(), first, packet_.group_v);
  }
}

// As nearest(): before what is kept, by depth and number.
void EyePackets::ask(RayPacket& packet, std::size_t ray, std::uint32_t primitive, VisibilityCounts& counts) {
  const EyePackets& self = *static_cast<const EyePackets*>(packet.context);
  const Scene& scene = self.prepared_.scene;
  const Ray exact{packet.origin, self.camera_.direction(self.X0_ + self.sample_[ray].column,
                                                        self.Y0_ + self.sample_[ray].row)};
  const Hit hit = intersect(scene, primitive, exact, kRayStart, counts);
  if (!hit.found()) return;
  if (packet.primitive[ray] >= 0 &&
      !before(hit,
              intersect(scene, static_cast<std::uint32_t>(packet.primitive[ray]), exact, kRayStart, counts)))
    return;
  packet.primitive[ray] = static_cast<std::int32_t>(primitive);
  packet.w[ray] = static_cast<float>(1 / hit.t);
}

}  // namespace sidelight::raytrace
