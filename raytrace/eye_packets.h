// SPDX-License-Identifier: MIT
// What the eye sees: the rays of the samples' lattice as packets of 32 x 32 (packets.h). The primitives are those of
// nearest(), every one.
#pragma once

#include <vector>

#include "common/scene/camera.h"
#include "raytrace/packets.h"

namespace sidelight::raytrace {

class EyePackets {
 public:
  EyePackets(const Prepared& prepared, const Camera& camera, Isa isa);

  // Of the samples [X0, X0 + columns) x [Y0, Y0 + rows), in this class's order(): the primitive that nearest() finds,
  // its depth left out; and whether nothing else stands near to where the ray meets it (place.h, stands_near()), for
  // certain, as long as that is within 16 reach().
  void trace(int X0, int Y0, int columns, int rows, std::vector<Hit>& hits, std::vector<std::uint8_t>& alone,
             VisibilityCounts& counts);
  // The order of the packets' rays, neighbours together, of that many samples: their numbers, counted row by row.
  // So many of a row follow each other where `columns` is a multiple of them.
  static constexpr int kRun = 4;
  static std::vector<std::uint32_t> order(int columns, int rows);
  double reach() const { return packet_.reach; }
  double ray_length() const { return packet_.length; }  // at least |d| of any ray

 private:
  struct Sample {
    std::uint8_t column = 0, row = 0;
  };

  void load(int X0, int Y0, int columns, int rows);
  void place(int columns, int rows);
  static void ask(RayPacket& packet, std::size_t ray, std::uint32_t primitive, VisibilityCounts& counts);

  const Prepared& prepared_;
  const Camera& camera_;
  Isa isa_;
  RayPacket packet_;
  // Of the packet: its first sample, its size, and its rays' samples from the first on.
  int X0_ = 0, Y0_ = 0, columns_ = 0, rows_ = 0;
  RayPacket::PerRay<Sample> sample_;
};

}  // namespace sidelight::raytrace
