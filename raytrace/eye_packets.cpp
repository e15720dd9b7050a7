// SPDX-License-Identifier: MIT
#include "raytrace/eye_packets.h"

#include <algorithm>
#include <cmath>

#include "common/model/ray_sheet.h"

namespace sidelight::raytrace {
namespace {

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

constexpr int kEdge = 16, kBlock = 4;  // of a packet and of its groups, in samples

}  // namespace

double reach_of(const Prepared& prepared, const glm::dvec3& origin) {
  double reach = std::max({prepared.triangles.bvh.reach, prepared.spheres.bvh.reach, largest(origin)});
  for (const std::uint32_t plane : prepared.planes)
    reach = std::max(reach, largest(prepared.scene.planes[primitive_ref(prepared.scene, plane).index].point));
  return reach;
}

EyePackets::EyePackets(const Prepared& prepared, const Camera& camera, Isa isa)
    : prepared_(prepared), camera_(camera), isa_(isa) {
  const RaySheet sheet = lattice_sheet(camera);
  packet_.origin = sheet.origin;
  packet_.U = sheet.U;
  packet_.V = sheet.V;
  packet_.length = sheet.size.x + sheet.size.y + sheet.size.z;
  packet_.reach = reach_of(prepared, camera.eye);
  // place.h: what is near lies within 10 (step + 32 u reach) of the place, up to 16 reach away: below 2^-40 reach.
  packet_.near_error = 0x1p-39;
  packet_.lattice = true;
  packet_.ask = ask;
  packet_.context = this;
}

void EyePackets::trace(int X0, int Y0, int columns, int rows, std::vector<Hit>& hits,
                       std::vector<std::uint8_t>& alone, SignCounts& counts) {
  const auto stride = static_cast<std::size_t>(columns);
  hits.resize(stride * static_cast<std::size_t>(rows));
  alone.resize(hits.size());
  for (int y = 0; y < rows; y += kEdge)
    for (int x = 0; x < columns; x += kEdge) {
      load(X0 + x, Y0 + y, X0 + std::min(x + kEdge, columns), Y0 + std::min(y + kEdge, rows),
           static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x), stride);
      trace_packet(isa_, prepared_, packet_, counts);
      for (std::size_t i = 0; i < static_cast<std::size_t>(packet_.size); ++i) {
        hits[sample_[i].index] = Hit();
        hits[sample_[i].index].primitive = static_cast<std::uint32_t>(packet_.primitive[i]);
        alone[sample_[i].index] = !packet_.asked[i];
      }
    }
}

// Block by block, so that a group's rays are close to each other.
void EyePackets::load(int X0, int Y0, int X1, int Y1, std::size_t first, std::size_t stride) {
  const int middle_X = X0 + kEdge / 2, middle_Y = Y0 + kEdge / 2;
  std::size_t i = 0;
  for (int y = Y0; y < Y1; y += kBlock)
    for (int x = X0; x < X1; x += kBlock)
      for (int Y = y; Y < std::min(y + kBlock, Y1); ++Y)
        for (int X = x; X < std::min(x + kBlock, X1); ++X, ++i) {
          packet_.u[i] = static_cast<float>(X - middle_X);
          packet_.v[i] = static_cast<float>(Y - middle_Y);
          sample_[i] = {X, Y,
                        first + static_cast<std::size_t>(Y - Y0) * stride + static_cast<std::size_t>(X - X0)};
        }
  packet_.size = static_cast<int>(i);
  packet_.w.fill(0);
  packet_.W = camera_.direction(middle_X, middle_Y);
  finish_places(packet_);
  start(packet_);
}

// As nearest(): before what is kept, by depth and number.
void EyePackets::ask(RayPacket& packet, std::size_t ray, std::uint32_t primitive, SignCounts& counts) {
  const EyePackets& self = *static_cast<const EyePackets*>(packet.context);
  const Scene& scene = self.prepared_.scene;
  const Ray exact{packet.origin, self.camera_.direction(self.sample_[ray].X, self.sample_[ray].Y)};
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
